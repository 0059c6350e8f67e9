#include "config.h"
#include "base/alloc.h"
#include "base/source.h"
#include "files.h"

#include <errno.h>
#include <pthread.h>
#include <sys/time.h>
#include <zlib.h>

/* ---- what goes in --------------------------------------------------------- */

/* A pipe that a thread fills in pieces of PIECE bytes. */
typedef struct feed {
    pthread_t thread;
    int from, to;
    const char *data;
    size_t n, piece;
} feed;

static void *feed_work(void *self)
{
    feed *f = self;
    for (size_t i = 0; i < f->n; i += f->piece) {
        size_t n = f->n - i < f->piece ? f->n - i : f->piece;
        if (write(f->to, f->data + i, n) != (ssize_t)n)
            break;
    }
    close(f->to);
    return NULL;
}

/* Standard input becomes the pipe's end; returns what to restore. */
static int feed_start(feed *f, const void *data, size_t n, size_t piece)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    f->to = ends[1], f->data = data, f->n = n, f->piece = piece;
    assert_int_equal(pthread_create(&f->thread, NULL, feed_work, f), 0);
    return files_replace(STDIN_FILENO, ends[0]);
}

static void feed_end(feed *f, int old)
{
    files_restore(STDIN_FILENO, old);
    pthread_join(f->thread, NULL);
}

static size_t gzip(unsigned char *to, size_t size, const void *data, size_t n)
{
    z_stream z = { 0 };
    assert_int_equal(deflateInit2(&z, 9, Z_DEFLATED, MAX_WBITS + 16, 9, Z_DEFAULT_STRATEGY), Z_OK);
    z.next_in = (z_const Bytef *)(uintptr_t)data;
    z.avail_in = (uInt)n;
    z.next_out = to;
    z.avail_out = (uInt)size;
    assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
    size_t used = z.total_out;
    deflateEnd(&z);
    return used;
}

/* ---- what comes out ------------------------------------------------------- */

/* Everything that S gives, read in pieces of PIECE bytes. */
static il_status read_all(il_source *s, size_t piece, char *to, size_t size, size_t *n, il_error *err)
{
    il_status st = IL_OK;
    size_t got = 1;
    for (*n = 0; st == IL_OK && got > 0;) {
        size_t most = size - *n < piece ? size - *n : piece;
        got = 0;
        st = il_source_read(s, to + *n, most, &got, err);
        *n += st == IL_OK ? got : 0;
    }
    return st;
}

static il_status read_memory(const void *data, size_t n, char *to, size_t size, size_t *got, il_error *err)
{
    il_source *s;
    assert_int_equal(il_source_from_memory(&s, data, n, "m", err), IL_OK);
    il_status st = read_all(s, 7, to, size, got, err);
    il_source_close(s);
    return st;
}

/* The lines of S, each written "NUMBER[r]:TEXT;". */
static il_status lines_of(il_source *s, size_t max_line, char *to, size_t size, il_error *err)
{
    il_lines l;
    il_lines_init(&l, s, max_line);
    const char *line;
    size_t n, used = 0;
    il_status st;
    while ((st = il_lines_next(&l, &line, &n, err)) == IL_OK && line)
        used += (size_t)snprintf(to + used, size - used, "%ld%s:%.*s;", l.line, l.had_cr ? "r" : "", (int)n, line);
    to[used] = '\0';
    if (st == IL_OK) {
        assert_int_equal(il_lines_next(&l, &line, &n, err), IL_OK); /* the end stays the end */
        assert_null(line);
    }
    il_lines_free(&l);
    il_lines_free(&l);
    return st;
}

static void assert_lines(const char *in, size_t n, const char *expected)
{
    for (size_t piece = 0; piece < 4; piece++) { /* 0: from memory */
        char out[500];
        il_source *s;
        feed f;
        int old = -1;
        il_error err = IL_ERROR_INIT;
        if (piece > 0) {
            old = feed_start(&f, in, n, piece);
            assert_int_equal(il_source_open(&s, "-", &err), IL_OK);
        } else {
            assert_int_equal(il_source_from_memory(&s, in, n, "m", &err), IL_OK);
        }
        il_status st = lines_of(s, 100, out, sizeof out, &err);
        if (piece > 0)
            feed_end(&f, old);
        assert_int_equal(st, IL_OK);
        assert_string_equal(out, expected);
        il_source_close(s);
    }
}

/* ---- files ---------------------------------------------------------------- */

static void what_cannot_be_opened_is_named_with_the_reason(void **state)
{
    char path[FILES_PATH_MAX], text[1000];
    static const struct { const char *name, *words; } c[] = {
        { "missing", "missing: cannot open: No such file or directory" }, { ".", ".: cannot read: Is a directory" } };
    for (size_t i = 0; i < 2; i++) {
        il_source *s = (il_source *)(uintptr_t)1;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_source_open(&s, files_path(path, state, c[i].name), &err), IL_E_IO);
        assert_null(s);
        il_error_message(&err, text, sizeof text);
        assert_non_null(strstr(text, c[i].words));
    }
    il_source_close(NULL);
}

static void a_closed_standard_input_is_an_error(void **state)
{
    (void)state;
    il_source *s;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDIN_FILENO, -1);
    il_status st = il_source_open(&s, "-", &err);
    files_restore(STDIN_FILENO, old);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.file, "-");
}

static void a_file_never_becomes_standard_input(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "in"), "x", 1);
    il_source *s = NULL;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDIN_FILENO, -1);
    il_status st = il_source_open(&s, path, &err);
    int taken = fcntl(STDIN_FILENO, F_GETFD);
    files_restore(STDIN_FILENO, old);
    assert_int_equal(st, IL_OK);
    assert_int_equal(taken, -1);
    il_source_close(s);
}

static void a_file_is_read_whole(void **state)
{
    char path[FILES_PATH_MAX], *data = malloc(300000), *back = malloc(400000);
    for (size_t i = 0; i < 300000; i++)
        data[i] = (char)(i * 7 % 251);
    files_write(files_path(path, state, "in"), data, 300000);
    for (size_t piece = 1; piece < 1000000; piece *= 97) {
        il_source *s;
        size_t n;
        assert_int_equal(il_source_open(&s, path, NULL), IL_OK);
        assert_string_equal(il_source_name(s), path);
        assert_int_equal(read_all(s, piece, back, 400000, &n, NULL), IL_OK);
        assert_int_equal(n, 300000);
        assert_memory_equal(back, data, n);
        il_source_close(s);
    }
    free(data);
    free(back);
}

static void a_read_error_stays(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "in"), "x", 1);
    il_source *s;
    size_t n;
    char c;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDIN_FILENO, open(path, O_WRONLY)); /* reading it is EBADF */
    il_status st = il_source_open(&s, "-", &err);
    il_status first = il_source_read(s, &c, 1, &n, &err), again = il_source_read(s, &c, 1, &n, NULL);
    files_restore(STDIN_FILENO, old);
    assert_int_equal(st, IL_OK);
    assert_int_equal(first, IL_E_IO);
    assert_int_equal(again, IL_E_IO);
    assert_string_equal(err.text, "cannot read: Bad file descriptor");
    const unsigned char *p;
    assert_int_equal(il_source_peek(s, 1, &p, &n, NULL), IL_E_IO);
    il_source_close(s);
}

static void a_non_blocking_pipe_is_waited_for(void **state)
{
    (void)state;
    feed f;
    static const char data[] = "one\ntwo\n";
    int old = feed_start(&f, data, sizeof data - 1, 1);
    fcntl(STDIN_FILENO, F_SETFL, O_NONBLOCK);
    il_source *s;
    char back[20];
    size_t n = 0;
    il_status st = il_source_open(&s, "-", NULL);
    if (st == IL_OK)
        st = read_all(s, 20, back, sizeof back, &n, NULL);
    feed_end(&f, old);
    assert_int_equal(st, IL_OK);
    assert_int_equal(n, sizeof data - 1);
    assert_memory_equal(back, data, n);
    il_source_close(s);
}

/* ---- peeking -------------------------------------------------------------- */

static void peeking_takes_nothing(void **state)
{
    (void)state;
    feed f;
    int old = feed_start(&f, "hello, world", 12, 1);
    il_source *s;
    const unsigned char *p;
    char back[20];
    size_t n, left;
    assert_int_equal(il_source_open(&s, "-", NULL), IL_OK);
    assert_int_equal(il_source_peek(s, 5, &p, &n, NULL), IL_OK);
    assert_true(n >= 5);
    assert_memory_equal(p, "hello", 5);
    assert_int_equal(il_source_read(s, back, 2, &n, NULL), IL_OK);
    assert_int_equal(n, 2);
    assert_int_equal(il_source_peek(s, 1000, &p, &n, NULL), IL_OK);
    assert_int_equal(n, 10);
    assert_memory_equal(p, "llo, world", 10);
    assert_int_equal(read_all(s, 3, back + 2, 18, &left, NULL), IL_OK);
    feed_end(&f, old);
    assert_int_equal(left, 10);
    assert_memory_equal(back, "hello, world", 12);
    assert_int_equal(il_source_peek(s, 1, &p, &n, NULL), IL_OK);
    assert_int_equal(n, 0);
    il_source_close(s);
}

static void peeking_far_stops_at_its_limit(void **state)
{
    (void)state;
    char *data = calloc(1, 200000);
    il_source *s;
    const unsigned char *p;
    size_t n;
    data[65535] = 'x';
    assert_int_equal(il_source_from_memory(&s, data, 200000, "m", NULL), IL_OK);
    assert_int_equal(il_source_peek(s, 1000000, &p, &n, NULL), IL_OK);
    assert_int_equal(n, 65536);
    assert_int_equal(p[65535], 'x');
    char *back = malloc(200001);
    assert_int_equal(read_all(s, 999, back, 200001, &n, NULL), IL_OK);
    assert_int_equal(n, 200000);
    assert_memory_equal(back, data, n);
    il_source_close(s);
    free(data);
    free(back);
}

/* ---- lines ---------------------------------------------------------------- */

static void lines_are_the_same_from_memory_and_byte_by_byte(void **state)
{
    (void)state;
    static const struct { const char *in, *out; } c[] = {
        { "", "" }, { "\n", "1:;" }, { "a", "1:a;" }, { "a\n", "1:a;" }, { "a\n\nb", "1:a;2:;3:b;" },
        { "a\r\nb\n\r\n", "1r:a;2:b;3r:;" }, { "a\rb\r\r\n", "1r:a\rb\r;" }, { "a\r", "1:a\r;" }, { "\r", "1:\r;" } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        assert_lines(c[i].in, strlen(c[i].in), c[i].out);
}

static void zero_bytes_stay_in_their_line(void **state)
{
    (void)state;
    il_source *s;
    il_lines l;
    const char *line;
    size_t n;
    assert_int_equal(il_source_from_memory(&s, "a\0b\n\0", 5, "m", NULL), IL_OK);
    il_lines_init(&l, s, 10);
    assert_int_equal(il_lines_next(&l, &line, &n, NULL), IL_OK);
    assert_int_equal(n, 3);
    assert_memory_equal(line, "a\0b", 3);
    assert_int_equal(il_lines_next(&l, &line, &n, NULL), IL_OK);
    assert_int_equal(n, 1);
    il_lines_free(&l);
    il_source_close(s);
}

static void a_line_of_the_limit_passes_and_one_more_byte_does_not(void **state)
{
    (void)state;
    static const struct { const char *in; il_status st; } c[] = {
        { "ab\n12345\n", IL_OK }, { "ab\n12345\r\n", IL_OK }, { "ab\n12345", IL_OK }, { "ab\n123456\n", IL_E_INPUT },
        { "ab\n123456", IL_E_INPUT }, { "ab\n1234\r\r\n", IL_OK }, { "ab\n12345\r", IL_E_INPUT },
        { "ab\n12345\rx\n", IL_E_INPUT }, { "ab\n1234567890", IL_E_INPUT } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_source *s;
        char out[100];
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_source_from_memory(&s, c[i].in, strlen(c[i].in), "m", &err), IL_OK);
        assert_int_equal(lines_of(s, 5, out, sizeof out, &err), c[i].st);
        if (c[i].st != IL_OK) {
            assert_string_equal(out, "1:ab;");
            assert_int_equal(err.line, 2);
            assert_string_equal(err.file, "m");
            assert_string_equal(err.text, "a line of more than 5 bytes");
        }
        il_source_close(s);
    }
}

/* Bytes in front of the limit are all that an endless line costs. */
static void an_endless_line_is_given_up_at_the_limit(void **state)
{
    (void)state;
    il_source *s;
    il_lines l;
    const char *line;
    size_t n, size = 20 << 20;
    char *data = malloc(size);
    memset(data, 'x', size);
    assert_int_equal(il_source_from_memory(&s, data, size, "m", NULL), IL_OK);
    il_lines_init(&l, s, 1000000);
    assert_int_equal(il_lines_next(&l, &line, &n, NULL), IL_E_INPUT);
    assert_null(line);
    assert_true(l.cap < 3000000);
    il_lines_free(&l);
    il_lines_init(&l, s, SIZE_MAX); /* no limit: what is left is one line */
    assert_int_equal(il_lines_next(&l, &line, &n, NULL), IL_OK);
    assert_true(n > size - 3000000);
    il_lines_free(&l);
    il_source_close(s);
    free(data);
}

static void lines_of_every_length_cross_the_buffer_unhurt(void **state)
{
    (void)state;
    size_t size = 0, cap = 1 << 20;
    char *data = malloc(cap);
    for (size_t length = 0; size + length + 2 < cap; length = (length * 5 + 3) % 2999) {
        memset(data + size, (int)('a' + length % 26), length);
        size += length;
        if (length % 3 == 0)
            data[size++] = '\r';
        data[size++] = '\n';
    }
    il_source *s;
    il_lines l;
    const char *line;
    size_t n, length = 0, at = 0;
    assert_int_equal(il_source_from_memory(&s, data, size, "m", NULL), IL_OK);
    il_lines_init(&l, s, 3000);
    while (il_lines_next(&l, &line, &n, NULL) == IL_OK && line) {
        assert_int_equal(n, length);
        assert_memory_equal(line, data + at, n);
        assert_int_equal(l.had_cr, length % 3 == 0);
        at += n + (length % 3 == 0) + 1;
        length = (length * 5 + 3) % 2999;
    }
    assert_int_equal(at, size);
    il_lines_free(&l);
    il_source_close(s);
    free(data);
}

/* ---- gzip ----------------------------------------------------------------- */

static const char poem[] = "roses are red, roses are red, violets are blue";
enum { POEM = sizeof poem - 1 };

static void gzip_is_undone_also_byte_by_byte(void **state)
{
    (void)state;
    unsigned char z[200];
    size_t zn = gzip(z, sizeof z, poem, POEM);
    for (size_t piece = 1; piece < 5; piece += 3) {
        feed f;
        char back[100];
        size_t n = 0;
        il_source *s;
        int old = feed_start(&f, z, zn, piece);
        il_status st = il_source_open(&s, "-", NULL);
        if (st == IL_OK)
            st = read_all(s, piece, back, sizeof back, &n, NULL);
        feed_end(&f, old);
        assert_int_equal(st, IL_OK);
        assert_int_equal(n, POEM);
        assert_memory_equal(back, poem, POEM);
        il_source_close(s);
    }
}

static void members_in_a_row_are_one_text(void **state)
{
    (void)state;
    unsigned char z[400];
    size_t a = gzip(z, sizeof z, poem, 10), b = gzip(z + a, sizeof z - a, poem, 0);
    size_t c = gzip(z + a + b, sizeof z - a - b, poem + 10, POEM - 10), n;
    char back[100];
    assert_int_equal(read_memory(z, a + b + c, back, sizeof back, &n, NULL), IL_OK);
    assert_int_equal(n, POEM);
    assert_memory_equal(back, poem, POEM);
}

static void zeros_behind_gzip_are_padding_and_all_else_is_an_error(void **state)
{
    (void)state;
    unsigned char z[70000] = { 0 };
    size_t zn = gzip(z, sizeof z, poem, POEM), n;
    char back[100];
    assert_int_equal(read_memory(z, zn + 1, back, sizeof back, &n, NULL), IL_OK);
    assert_int_equal(read_memory(z, sizeof z, back, sizeof back, &n, NULL), IL_OK);
    assert_int_equal(n, POEM);
    static const size_t where[] = { 0, 1, 2, 69000 };
    for (size_t i = 0; i < 4; i++) {
        il_error err = IL_ERROR_INIT;
        z[zn + where[i] % (sizeof z - zn)] = 'x';
        assert_int_equal(read_memory(z, sizeof z, back, sizeof back, &n, &err), IL_E_INPUT);
        assert_string_equal(err.text, "something that is not gzip follows the gzip stream");
        assert_int_equal(n, POEM); /* what came before was given */
        z[zn + where[i] % (sizeof z - zn)] = 0;
    }
}

static void gzip_cut_anywhere_is_an_error(void **state)
{
    (void)state;
    unsigned char z[200];
    size_t zn = gzip(z, sizeof z, poem, POEM), n;
    char back[100];
    for (size_t cut = 2; cut < zn; cut++) {
        il_error err = IL_ERROR_INIT;
        assert_int_equal(read_memory(z, cut, back, sizeof back, &n, &err), IL_E_INPUT);
        assert_string_equal(err.text, "the gzip stream is cut short");
        assert_string_equal(err.file, "m");
        assert_memory_equal(back, poem, n);
    }
    assert_int_equal(read_memory(z, 1, back, sizeof back, &n, NULL), IL_OK); /* no magic: plain */
}

static void what_came_out_before_the_damage_is_given(void **state)
{
    (void)state;
    unsigned char z[200];
    size_t zn = gzip(z, sizeof z, poem, POEM), n;
    char back[100];
    il_error err = IL_ERROR_INIT;
    z[zn - 8] ^= 1; /* the checksum */
    assert_int_equal(read_memory(z, zn, back, sizeof back, &n, &err), IL_E_INPUT);
    assert_string_equal(err.text, "the gzip stream is damaged");
    assert_int_equal(n, POEM);
    assert_memory_equal(back, poem, POEM);
}

static void no_flipped_bit_gives_other_text(void **state)
{
    (void)state;
    unsigned char z[200];
    size_t zn = gzip(z, sizeof z, poem, POEM), n, refused = 0;
    char back[5000];
    for (size_t bit = 16; bit < 8 * zn; bit++) { /* behind the magic */
        z[bit / 8] ^= (unsigned char)(1 << bit % 8);
        if (read_memory(z, zn, back, sizeof back, &n, NULL) == IL_OK) {
            assert_int_equal(n, POEM);
            assert_memory_equal(back, poem, POEM);
        } else {
            refused++;
        }
        z[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    assert_true(refused > 8 * zn - 100); /* all but times, flags and the like */
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    unsigned char z[200];
    size_t zn = gzip(z, sizeof z, poem, POEM);
    for (long k = 0;; k++) {
        il_source *s = NULL;
        il_error err = IL_ERROR_INIT;
        const unsigned char *p;
        char out[200];
        size_t n;
        il_alloc_test_fail_after(k);
        il_status st = il_source_from_memory(&s, z, zn, "m", &err);
        if (st == IL_OK)
            st = il_source_peek(s, 3, &p, &n, &err);
        if (st == IL_OK)
            st = lines_of(s, 100, out, sizeof out, &err);
        il_source_close(s);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK) {
            assert_true(k > 4);
            break;
        }
        assert_int_equal(st, IL_E_NOMEM);
        assert_int_equal(err.code, IL_E_NOMEM);
        assert_true(k < 100);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_opened_is_named_with_the_reason),
        cmocka_unit_test(a_closed_standard_input_is_an_error),
        cmocka_unit_test(a_file_never_becomes_standard_input),
        cmocka_unit_test(a_file_is_read_whole),
        cmocka_unit_test(a_read_error_stays),
        cmocka_unit_test(a_non_blocking_pipe_is_waited_for),
        cmocka_unit_test(peeking_takes_nothing),
        cmocka_unit_test(peeking_far_stops_at_its_limit),
        cmocka_unit_test(lines_are_the_same_from_memory_and_byte_by_byte),
        cmocka_unit_test(zero_bytes_stay_in_their_line),
        cmocka_unit_test(a_line_of_the_limit_passes_and_one_more_byte_does_not),
        cmocka_unit_test(an_endless_line_is_given_up_at_the_limit),
        cmocka_unit_test(lines_of_every_length_cross_the_buffer_unhurt),
        cmocka_unit_test(gzip_is_undone_also_byte_by_byte),
        cmocka_unit_test(members_in_a_row_are_one_text),
        cmocka_unit_test(zeros_behind_gzip_are_padding_and_all_else_is_an_error),
        cmocka_unit_test(gzip_cut_anywhere_is_an_error),
        cmocka_unit_test(what_came_out_before_the_damage_is_given),
        cmocka_unit_test(no_flipped_bit_gives_other_text),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, files_setup, files_teardown);
}
