#include "config.h"
#include "base/alloc.h"
#include "base/output.h"
#include "files.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>

enum { BIG = 1000000 }; /* more than any buffer */

static il_output *opened(const char *path)
{
    il_output *o;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_output_open(&o, path, &err), IL_OK);
    return o;
}

static void write_many(il_output *o, size_t n)
{
    for (size_t i = 0; i < n; i += 10)
        il_output_string(o, "123456789\n");
}

/* ---- files ---------------------------------------------------------------- */

static void a_file_appears_when_it_is_whole(void **state)
{
    char path[FILES_PATH_MAX];
    files_path(path, state, "new");
    il_output *o = opened(path);
    write_many(o, BIG);
    assert_int_equal(access(path, F_OK), -1);
    assert_int_equal(il_output_bytes(o), BIG);
    assert_false(il_output_is_terminal(o));
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    struct stat st;
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_size, BIG);
    assert_int_equal(remove(path), 0);
    assert_int_equal(files_count(state), 0);
}

static void an_empty_file_is_a_file_too(void **state)
{
    char path[FILES_PATH_MAX];
    il_output *o = opened(files_path(path, state, "empty"));
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    files_assert_content(path, "");
    remove(path);
}

static void a_discarded_output_leaves_the_old_file_and_nothing_else(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "old"), "old", 3);
    for (size_t n = 10; n <= BIG; n *= 100000) { /* before and after the temporary appears */
        il_output *o = opened(path);
        write_many(o, n);
        assert_int_equal(il_output_flush(o, NULL), IL_OK);
        il_output_discard(o);
        files_assert_content(path, "old");
        assert_int_equal(files_count(state), 1);
    }
    il_output_discard(NULL);
    remove(path);
}

static void a_full_disk_leaves_the_old_file_and_nothing_else(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "old"), "old", 3);
    struct rlimit before, less;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    less = before;
    less.rlim_cur = 100000;
    signal(SIGXFSZ, SIG_IGN);
    il_error err = IL_ERROR_INIT, early = IL_ERROR_INIT;
    il_output *o = opened(path);
    setrlimit(RLIMIT_FSIZE, &less);
    write_many(o, BIG);
    il_status at_once = il_output_status(o, &early), st = il_output_commit(o, &err);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(at_once, IL_E_IO);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.text, "cannot write: File too large");
    assert_string_equal(early.text, err.text);
    assert_string_equal(err.file, path);
    files_assert_content(path, "old");
    assert_int_equal(files_count(state), 1);
    remove(path);
}

static void a_failed_rename_is_an_error(void **state)
{
    char path[FILES_PATH_MAX];
    il_error err = IL_ERROR_INIT;
    il_output *o = opened(files_path(path, state, "name"));
    il_output_string(o, "x");
    assert_int_equal(mkdir(path, 0777), 0); /* somebody takes the name meanwhile */
    assert_int_equal(il_output_commit(o, &err), IL_E_IO);
    assert_non_null(strstr(err.text, "cannot put the finished file in place: "));
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(files_count(state), 0);
}

static void dev_full_fails_with_the_reason(void **state)
{
    (void)state;
    il_error err = IL_ERROR_INIT;
    char text[300];
    il_output *o = opened("/dev/full");
    il_output_string(o, "x");
    assert_int_equal(il_output_status(o, NULL), IL_OK); /* buffered */
    assert_int_equal(il_output_commit(o, &err), IL_E_IO);
    il_error_message(&err, text, sizeof text);
    assert_string_equal(text, "/dev/full: cannot write: No space left on device");
    struct stat st;
    assert_int_equal(stat("/dev/full", &st), 0);
    assert_true(S_ISCHR(st.st_mode)); /* nothing was renamed onto it */
}

static void places_that_cannot_be_written_are_refused_at_once(void **state)
{
    char path[FILES_PATH_MAX];
    static const char *const names[] = { "nofolder/x", ".", "slash/", "nofolder/" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        il_output *o = (il_output *)(uintptr_t)1;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_output_open(&o, files_path(path, state, names[i]), &err), IL_E_IO);
        assert_null(o);
        assert_string_equal(err.file, path);
    }
    il_output *o;
    assert_int_equal(il_output_open(&o, "", NULL), IL_E_IO);
    assert_int_equal(files_count(state), 0);
}

/* ---- two files ------------------------------------------------------------ */

static void two_files_appear_together_or_not_at_all(void **state)
{
    char main_path[FILES_PATH_MAX], beside_path[FILES_PATH_MAX];
    files_path(main_path, state, "main");
    files_path(beside_path, state, "beside");
    files_write(main_path, "old", 3);
    for (int way = 0; way < 3; way++) {
        il_output *o = opened(main_path), *beside = opened(beside_path);
        il_error err = IL_ERROR_INIT;
        il_output_string(o, "new");
        il_output_string(beside, "also");
        il_output_also(o, beside);
        if (way == 0) {
            assert_int_equal(mkdir(beside_path, 0777), 0); /* somebody takes the name */
            assert_int_equal(il_output_commit(o, &err), IL_E_IO);
            assert_string_equal(err.file, beside_path);
            assert_int_equal(rmdir(beside_path), 0);
        } else if (way == 1) {
            il_output_discard(o);
        } else {
            assert_int_equal(il_output_commit(o, &err), IL_OK);
        }
        files_assert_content(main_path, way < 2 ? "old" : "new");
        assert_int_equal(files_count(state), way < 2 ? 1 : 2);
    }
    files_assert_content(beside_path, "also");
    remove(main_path), remove(beside_path);
}

static void only_regular_files_have_a_path(void **state)
{
    char path[FILES_PATH_MAX];
    il_output *file = opened(files_path(path, state, "x")), *null = opened("/dev/null"), *memory;
    assert_int_equal(il_output_to_memory(&memory, NULL), IL_OK);
    assert_string_equal(il_output_file_path(file), path);
    assert_null(il_output_file_path(null));
    assert_null(il_output_file_path(memory));
    il_output_discard(file), il_output_discard(null), il_output_discard(memory);
}

/* ---- permissions and links ------------------------------------------------ */

static unsigned mode_of(const char *path)
{
    struct stat st;
    assert_int_equal(stat(path, &st), 0);
    return st.st_mode & 07777;
}

static void write_word(const char *path, const char *word)
{
    il_output *o = opened(path);
    il_output_string(o, word);
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    files_assert_content(path, word);
}

static void an_old_file_keeps_its_permissions(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "old"), "old", 3);
    static const unsigned modes[] = { 0600, 0664, 0751 };
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(chmod(path, modes[i]), 0);
        write_word(path, "new");
        assert_int_equal(mode_of(path), modes[i]);
    }
    remove(path);
}

static void a_new_file_obeys_the_umask(void **state)
{
    char path[FILES_PATH_MAX];
    mode_t old = umask(027);
    write_word(files_path(path, state, "new"), "x");
    umask(old);
    assert_int_equal(mode_of(path), 0640);
    remove(path);
}

/* As root nothing is write-protected: then act as somebody else for a moment, in
 * the folder itself, since that one may not come from above. */
static void a_write_protected_file_is_refused(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "protected"), "old", 3);
    assert_int_equal(chmod(path, 0444), 0);
    assert_int_equal(chmod(*state, 0777), 0);
    int here = open(".", O_RDONLY);
    assert_int_equal(chdir(*state), 0);
    bool root = geteuid() == 0;
    if (root)
        assert_int_equal(seteuid(65534), 0);
    il_output *o, *beside;
    il_error err = IL_ERROR_INIT;
    il_status st = il_output_open(&o, "protected", &err), other = il_output_open(&beside, "other", NULL);
    if (root)
        assert_int_equal(seteuid(0), 0);
    assert_int_equal(fchdir(here), 0);
    close(here);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.text, "cannot write: Permission denied");
    assert_int_equal(other, IL_OK);
    il_output_discard(beside);
    assert_int_equal(files_count(state), 1);
    remove(path);
}

static void a_link_stays_and_its_target_is_replaced(void **state)
{
    char link[FILES_PATH_MAX], between[FILES_PATH_MAX], target[FILES_PATH_MAX];
    files_path(link, state, "link");
    files_path(between, state, "between");
    files_path(target, state, "target");
    assert_int_equal(symlink("between", link), 0);   /* relative */
    assert_int_equal(symlink(target, between), 0);   /* absolute */
    write_word(link, "dangling before");
    files_assert_content(target, "dangling before");
    write_word(link, "again");
    files_assert_content(target, "again");
    struct stat st;
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(lstat(between, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(files_count(state), 3);
    remove(link), remove(between), remove(target);
}

static void a_circle_of_links_is_refused(void **state)
{
    char path[FILES_PATH_MAX];
    il_output *o;
    assert_int_equal(symlink("round", files_path(path, state, "round")), 0);
    assert_int_equal(il_output_open(&o, path, NULL), IL_E_IO);
    remove(path);
}

/* ---- standard output, FIFOs ----------------------------------------------- */

static void standard_output_gets_every_byte(void **state)
{
    char path[FILES_PATH_MAX];
    int file = open(files_path(path, state, "out"), O_WRONLY | O_CREAT, 0600);
    int old = files_replace(STDOUT_FILENO, file);
    il_output *o = NULL;
    il_status st = il_output_open(&o, "-", NULL);
    if (st == IL_OK) {
        write_many(o, 100000);
        st = il_output_commit(o, NULL);
    }
    bool still_open = fcntl(STDOUT_FILENO, F_GETFD) >= 0;
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_OK);
    assert_true(still_open);
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    assert_int_equal(s.st_size, 100000);
    remove(path);
}

static void a_closed_standard_output_is_an_error(void **state)
{
    (void)state;
    il_output *o;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDOUT_FILENO, -1);
    il_status st = il_output_open(&o, "-", &err);
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.file, "standard output");
}

static void a_read_only_standard_output_is_an_error(void **state)
{
    (void)state;
    il_output *o;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDOUT_FILENO, open("/dev/null", O_RDONLY));
    il_status st = il_output_open(&o, "-", &err);
    if (st == IL_OK) {
        il_output_char(o, 'x');
        st = il_output_commit(o, &err);
    }
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_E_IO);
}

static void a_reader_that_went_away_is_an_error(void **state)
{
    (void)state;
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    close(ends[0]);
    signal(SIGPIPE, SIG_IGN);
    il_output *o;
    il_error err = IL_ERROR_INIT;
    int old = files_replace(STDOUT_FILENO, ends[1]);
    il_status st = il_output_open(&o, "-", &err);
    if (st == IL_OK) {
        il_output_char(o, 'x');
        st = il_output_flush(o, &err);
        il_output_discard(o);
    }
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.text, "cannot write: Broken pipe");
}

static void a_file_never_becomes_standard_output(void **state)
{
    char path[FILES_PATH_MAX];
    il_output *o;
    int old = files_replace(STDOUT_FILENO, -1);
    il_status st = il_output_open(&o, files_path(path, state, "out"), NULL);
    int taken = 0;
    if (st == IL_OK) {
        il_output_string(o, "x");
        il_output_flush(o, NULL);
        taken = fcntl(STDOUT_FILENO, F_GETFD);
        st = il_output_commit(o, NULL);
    }
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_OK);
    assert_int_equal(taken, -1);
    files_assert_content(path, "x");
    remove(path);
}

static void the_file_behind_dev_stdout_is_not_replaced(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "out"), "before ", 7);
    int old = files_replace(STDOUT_FILENO, open(path, O_WRONLY | O_APPEND));
    il_output *o;
    il_status st = il_output_open(&o, "/dev/stdout", NULL);
    if (st == IL_OK) {
        il_output_string(o, "after");
        st = il_output_commit(o, NULL);
    }
    files_restore(STDOUT_FILENO, old);
    assert_int_equal(st, IL_OK);
    files_assert_content(path, "before after");
    remove(path);
}

typedef struct reader {
    const char *path;
    size_t n;
} reader;

static void *read_fifo(void *self)
{
    reader *r = self;
    char block[777];
    int fd = open(r->path, O_RDONLY);
    for (ssize_t got; fd >= 0 && (got = read(fd, block, sizeof block)) > 0;)
        r->n += (size_t)got;
    close(fd);
    return NULL;
}

static void a_fifo_is_written_in_place(void **state)
{
    char path[FILES_PATH_MAX];
    assert_int_equal(mkfifo(files_path(path, state, "fifo"), 0600), 0);
    reader r = { path, 0 };
    pthread_t t;
    assert_int_equal(pthread_create(&t, NULL, read_fifo, &r), 0);
    il_output *o = opened(path);
    write_many(o, BIG);
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    pthread_join(t, NULL);
    assert_int_equal(r.n, BIG);
    struct stat st;
    assert_int_equal(stat(path, &st), 0);
    assert_true(S_ISFIFO(st.st_mode));
    remove(path);
}

static void a_non_blocking_pipe_is_waited_for(void **state)
{
    char path[FILES_PATH_MAX], *block = calloc(1, BIG);
    assert_int_equal(mkfifo(files_path(path, state, "fifo"), 0600), 0);
    reader r = { path, 0 };
    pthread_t t;
    assert_int_equal(pthread_create(&t, NULL, read_fifo, &r), 0);
    int fd = open(path, O_WRONLY);
    fcntl(fd, F_SETFL, O_NONBLOCK);
    int old = files_replace(STDOUT_FILENO, fd);
    il_output *o = NULL;
    il_status st = il_output_open(&o, "-", NULL);
    if (st == IL_OK) {
        il_output_write(o, block, BIG); /* at once: no pipe takes it in one piece */
        st = il_output_commit(o, NULL);
    }
    files_restore(STDOUT_FILENO, old);
    free(block);
    pthread_join(t, NULL);
    assert_int_equal(st, IL_OK);
    assert_int_equal(r.n, BIG);
    remove(path);
}

/* ---- what is written ------------------------------------------------------ */

static void bytes_and_numbers_have_one_form(void **state)
{
    (void)state;
    il_output *o;
    assert_int_equal(il_output_to_memory(&o, NULL), IL_OK);
    il_output_integer(o, 0);
    il_output_char(o, ' ');
    il_output_integer(o, INT64_MIN);
    il_output_char(o, ' ');
    il_output_integer(o, INT64_MAX);
    il_output_char(o, ' ');
    il_output_number(o, -0.0);
    il_output_string(o, " ");
    il_output_number(o, 0.1);
    il_output_u32le(o, 0x01020384);
    il_output_f32le(o, -1.5f);
    il_output_f64le(o, -2.5);
    il_output_write(o, NULL, 0);
    static const char expected[] = "0 -9223372036854775808 9223372036854775807 0 0.1"
                                   "\x84\x03\x02\x01" "\0\0\xc0\xbf" "\0\0\0\0\0\0\x04\xc0";
    size_t n;
    const unsigned char *data = il_output_memory(o, &n);
    assert_int_equal(n, sizeof expected - 1);
    assert_memory_equal(data, expected, n);
    assert_int_equal(il_output_bytes(o), n);
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
}

static void blocks_of_any_size_come_out_in_order(void **state)
{
    char path[FILES_PATH_MAX], *data = malloc(BIG);
    for (size_t i = 0; i < BIG; i++)
        data[i] = (char)(i * 31 % 253);
    il_output *o = opened(files_path(path, state, "out"));
    for (size_t i = 0, k = 1; i < BIG; i += k, k = k * 3 % 200003) {
        k = k < BIG - i ? k : BIG - i;
        il_output_write(o, data + i, k);
    }
    assert_int_equal(il_output_commit(o, NULL), IL_OK);
    size_t n;
    char *back = files_read(path, &n);
    assert_int_equal(n, BIG);
    assert_memory_equal(back, data, BIG);
    free(back);
    free(data);
    remove(path);
}

/* ---- spools --------------------------------------------------------------- */

/* Byte I of the spools below. */
static char letter(size_t i)
{
    return (char)('a' + i % 23);
}

static il_output *spool_of(size_t n)
{
    il_output *s;
    assert_int_equal(il_output_spool(&s, NULL), IL_OK);
    for (size_t i = 0; i < n; i++)
        il_output_char(s, letter(i));
    assert_int_equal(il_output_bytes(s), n);
    return s;
}

static void assert_letters(il_output *spool, size_t from, size_t to)
{
    il_output *o;
    size_t n;
    assert_int_equal(il_output_to_memory(&o, NULL), IL_OK);
    assert_int_equal(il_output_append_spool(o, spool, NULL), IL_OK);
    const unsigned char *data = il_output_memory(o, &n);
    assert_int_equal(n, to);
    for (size_t i = 0; i < n; i++)
        if (data[i] != (unsigned char)letter(i))
            fail_msg("byte %zu", i);
    il_output_discard(o);
    char some[1000];
    size_t k = to - from < sizeof some ? to - from : sizeof some;
    assert_int_equal(il_output_read_back(spool, from, some, k, NULL), IL_OK);
    for (size_t i = 0; i < k; i++)
        assert_int_equal(some[i], letter(from + i));
}

static void a_spool_gives_back_what_it_got(void **state)
{
    (void)state;
    static const size_t sizes[] = { 0, 10, IL_SPOOL_MEMORY - 1, IL_SPOOL_MEMORY, IL_SPOOL_MEMORY + 1, BIG };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        il_output *s = spool_of(sizes[i]);
        assert_letters(s, sizes[i] / 3, sizes[i]);
        for (size_t k = sizes[i]; k < sizes[i] + 1000; k++) /* it stays open */
            il_output_char(s, letter(k));
        assert_letters(s, sizes[i] > 500 ? sizes[i] - 500 : 0, sizes[i] + 1000);
        il_output_discard(s);
    }
}

static void a_rewound_spool_goes_on_from_there(void **state)
{
    (void)state;
    static const size_t keep[] = { BIG, BIG - 100, IL_SPOOL_MEMORY, 3, 0 };
    for (size_t i = 0; i < sizeof keep / sizeof *keep; i++) {
        il_output *s = spool_of(BIG);
        assert_int_equal(il_output_rewind(s, keep[i], NULL), IL_OK);
        assert_int_equal(il_output_bytes(s), keep[i]);
        assert_letters(s, 0, keep[i]);
        for (size_t k = keep[i]; k < keep[i] + BIG / 2; k++)
            il_output_char(s, letter(k));
        assert_letters(s, keep[i], keep[i] + BIG / 2);
        il_output_discard(s);
    }
}

static void a_spool_has_no_more_than_it_got(void **state)
{
    (void)state;
    char c[20];
    il_output *s = spool_of(10);
    assert_int_equal(il_output_read_back(s, 5, c, 6, NULL), IL_E_INTERNAL);
    assert_int_equal(il_output_read_back(s, UINT64_MAX, c, 2, NULL), IL_E_INTERNAL);
    assert_int_equal(il_output_rewind(s, 11, NULL), IL_E_INTERNAL);
    assert_int_equal(il_output_read_back(s, 5, c, 5, NULL), IL_OK);
    il_output_discard(s);
}

static void a_small_spool_makes_no_file(void **state)
{
    (void)state;
    setenv("TMPDIR", "/nonexistent/folder", 1);
    il_output *small = spool_of(IL_SPOOL_MEMORY - 1), *big;
    il_status fine = il_output_status(small, NULL);
    il_error err = IL_ERROR_INIT, again = IL_ERROR_INIT, copied = IL_ERROR_INIT;
    assert_int_equal(il_output_spool(&big, NULL), IL_OK);
    for (size_t i = 0; i < BIG; i++)
        il_output_char(big, 'x');
    il_status st = il_output_status(big, &err), rewound = il_output_rewind(big, 0, &again);
    il_status appended = il_output_append_spool(small, big, &copied);
    il_output_discard(small);
    il_output_discard(big);
    unsetenv("TMPDIR");
    assert_int_equal(fine, IL_OK);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.file, "/nonexistent/folder");
    assert_int_equal(rewound, IL_E_IO);  /* a failure stays */
    assert_int_equal(appended, IL_E_IO);
}

static void a_big_spool_leaves_no_name(void **state)
{
    setenv("TMPDIR", *state, 1);
    il_output *s = spool_of(BIG);
    int names = files_count(state);
    il_output_discard(s);
    unsetenv("TMPDIR");
    assert_int_equal(names, 0);
}

static void a_full_disk_under_a_spool_is_an_error(void **state)
{
    (void)state;
    struct rlimit before, less;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    less = before;
    less.rlim_cur = IL_SPOOL_MEMORY + 1000;
    signal(SIGXFSZ, SIG_IGN);
    il_output *s;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_output_spool(&s, NULL), IL_OK);
    setrlimit(RLIMIT_FSIZE, &less);
    for (size_t i = 0; i < BIG; i++)
        il_output_char(s, 'x');
    il_status st = il_output_status(s, &err);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(st, IL_E_IO);
    assert_string_equal(err.text, "cannot write: File too large");
    il_output_discard(s);
}

/* ---- memory --------------------------------------------------------------- */

static il_status write_all_kinds(const char *path, il_error *err)
{
    il_output *o = NULL, *s = NULL, *m = NULL;
    il_status st = il_output_open(&o, path, err);
    if (st == IL_OK)
        st = il_output_spool(&s, err);
    if (st == IL_OK)
        st = il_output_to_memory(&m, err);
    if (st == IL_OK) {
        write_many(s, 300000);
        write_many(m, 1000);
        st = il_output_append_spool(o, s, err);
    }
    if (st == IL_OK)
        st = il_output_status(m, err);
    if (st == IL_OK) {
        st = il_output_commit(o, err);
        o = NULL;
    }
    il_output_discard(o);
    il_output_discard(s);
    il_output_discard(m);
    return st;
}

static void every_allocation_may_fail(void **state)
{
    char path[FILES_PATH_MAX];
    files_write(files_path(path, state, "old"), "old", 3);
    long k = 0;
    for (;; k++) {
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        il_status st = write_all_kinds(path, &err);
        il_alloc_test_fail_after(-1);
        if (st == IL_OK)
            break;
        assert_int_equal(st, IL_E_NOMEM);
        assert_int_equal(err.code, IL_E_NOMEM);
        files_assert_content(path, "old");
        assert_int_equal(files_count(state), 1);
        assert_true(k < 100);
    }
    assert_true(k > 10);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_appears_when_it_is_whole),
        cmocka_unit_test(an_empty_file_is_a_file_too),
        cmocka_unit_test(a_discarded_output_leaves_the_old_file_and_nothing_else),
        cmocka_unit_test(a_full_disk_leaves_the_old_file_and_nothing_else),
        cmocka_unit_test(a_failed_rename_is_an_error),
        cmocka_unit_test(dev_full_fails_with_the_reason),
        cmocka_unit_test(places_that_cannot_be_written_are_refused_at_once),
        cmocka_unit_test(two_files_appear_together_or_not_at_all),
        cmocka_unit_test(only_regular_files_have_a_path),
        cmocka_unit_test(an_old_file_keeps_its_permissions),
        cmocka_unit_test(a_new_file_obeys_the_umask),
        cmocka_unit_test(a_write_protected_file_is_refused),
        cmocka_unit_test(a_link_stays_and_its_target_is_replaced),
        cmocka_unit_test(a_circle_of_links_is_refused),
        cmocka_unit_test(standard_output_gets_every_byte),
        cmocka_unit_test(a_closed_standard_output_is_an_error),
        cmocka_unit_test(a_read_only_standard_output_is_an_error),
        cmocka_unit_test(a_reader_that_went_away_is_an_error),
        cmocka_unit_test(a_file_never_becomes_standard_output),
        cmocka_unit_test(the_file_behind_dev_stdout_is_not_replaced),
        cmocka_unit_test(a_fifo_is_written_in_place),
        cmocka_unit_test(a_non_blocking_pipe_is_waited_for),
        cmocka_unit_test(bytes_and_numbers_have_one_form),
        cmocka_unit_test(blocks_of_any_size_come_out_in_order),
        cmocka_unit_test(a_spool_gives_back_what_it_got),
        cmocka_unit_test(a_rewound_spool_goes_on_from_there),
        cmocka_unit_test(a_spool_has_no_more_than_it_got),
        cmocka_unit_test(a_small_spool_makes_no_file),
        cmocka_unit_test(a_big_spool_leaves_no_name),
        cmocka_unit_test(a_full_disk_under_a_spool_is_an_error),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, files_setup, files_teardown);
}
