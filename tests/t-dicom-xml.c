/* DICOM as XML: how it is told from other XML, what its limits are, and texts that
 * lie across the ends of blocks.  What it means is in formats/dicom-xml. */
#include "config.h"
#include "base/alloc.h"
#include "input/dicom-values.h"
#include "input/reader.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- a sink that keeps the names and counts the points ---------------------------- */

typedef struct keeper {
    il_sink sink;
    char *name;         /* of the last stack */
    char fault[400];
    size_t n_stacks, n_points;
} keeper;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    keeper *k = (keeper *)self;
    (void)err;
    free(k->name);
    k->name = malloc(strlen(il_stack_head_name(head)) + 1);
    assert_non_null(k->name);
    strcpy(k->name, il_stack_head_name(head));
    snprintf(k->fault, sizeof k->fault, "%s", head->fault ? head->fault : "");
    k->n_stacks++;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    (void)err;
    ((keeper *)self)->n_points += il_slice_points(s);
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    (void)self, (void)p, (void)err;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

static il_status read_bytes(const char *text, size_t n, const il_read_options *o, keeper *k, il_error *err)
{
    il_source *source = NULL;
    *k = (keeper){ .sink = { on_stack, on_slice, on_pair, on_end, on_end } };
    il_status st = il_source_from_memory(&source, text, n, "s.xml", err);
    if (st == IL_OK)
        st = il_reader_dicom_xml.read(&source, 1, o, &k->sink, NULL, err);
    il_source_close(source);
    return st;
}

/* ---- texts ----------------------------------------------------------------------------- */

typedef struct text {
    char *s;
    size_t n, cap;
} text;

static void say(text *t, const char *s)
{
    size_t n = strlen(s);
    if (t->n + n + 1 > t->cap) {
        t->cap = 2 * (t->n + n + 1);
        t->s = realloc(t->s, t->cap);
        assert_non_null(t->s);
    }
    memcpy(t->s + t->n, s, n + 1);
    t->n += n;
}

static void repeat(text *t, const char *s, size_t times)
{
    for (; times > 0; times--)
        say(t, s);
}

/* A structure set of dcm2xml's form with one ROI called NAME and DATA as the only
 * contour, BEFORE in front of them. */
static text set_of(const char *before, const char *name, const char *data)
{
    text t = { NULL, 0, 0 };
    say(&t, "<data-set>");
    say(&t, before);
    say(&t, "<sequence tag=\"3006,0020\" vr=\"SQ\"><item><element tag=\"3006,0022\" vr=\"IS\">1</element>"
            "<element tag=\"3006,0026\" vr=\"LO\">");
    say(&t, name);
    say(&t, "</element></item></sequence><sequence tag=\"3006,0039\" vr=\"SQ\"><item><sequence tag=\"3006,0040\" vr=\"SQ\"><item>"
            "<element tag=\"3006,0050\" vr=\"DS\">");
    say(&t, data);
    say(&t, "</element></item></sequence><element tag=\"3006,0084\" vr=\"IS\">1</element></item></sequence></data-set>\n");
    return t;
}

static const char square[] = "0\\0\\1\\9\\0\\1\\9\\9\\1\\0\\9\\1";

static void assert_refused(const text *t, const il_read_options *o, const char *why)
{
    keeper k;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(read_bytes(t->s, t->n, o, &k, &err), IL_E_INPUT);
    if (!strstr(err.text, why))
        fail_msg("expected '%s', but got '%s'", why, err.text);
    free(k.name);
}

/* ---- the probe --------------------------------------------------------------------------- */

static void assert_reader(const char *head, const char *name)
{
    const il_reader *r = NULL;
    il_source *source = NULL;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_source_from_memory(&source, head, strlen(head), "head", &err), IL_OK);
    assert_int_equal(il_reader_detect(source, &r, &err), name ? IL_OK : IL_E_INPUT);
    assert_string_equal(r ? r->name : "none", name ? name : "none");
    il_source_close(source);
}

static void both_forms_are_told_by_their_first_bytes(void **state)
{
    (void)state;
    assert_reader("<NativeDicomModel>", "dicom-xml");
    assert_reader("\xEF\xBB\xBF<?xml version='1.0'?>\n<!-- <svg> -->\n<d:NativeDicomModel xmlns:d='x'/>", "dicom-xml");
    assert_reader("<file-format>\n<meta-header", "dicom-xml");
    assert_reader("<?xml version=\"1.0\"?><!DOCTYPE file-format [ <!ELEMENT", "dicom-xml");
    assert_reader("<data-set>", "dicom-xml");
    assert_reader("<Results><Result n='1'>\n<NativeDicomModel xml:space='preserve'>", "dicom-xml");
    assert_reader("<piece><DicomAttribute tag='30060020'>", "dicom-xml");
}

static void drawings_stay_drawings(void **state)
{
    (void)state;
    assert_reader("<svg><!-- --><metadata><NativeDicomModel/></metadata>", "svg");
    assert_reader("<svg:svg xmlns:svg='x'><data-set>", "svg");
    assert_reader("<?xml version='1.0'?><!DOCTYPE svg PUBLIC 'x'><svg>", "svg");
    assert_reader("<g id='layer0'/>", "svg");
    assert_reader("<polygon points='0,0'/>", "svg");
}

static void other_xml_is_neither(void **state)
{
    (void)state;
    assert_reader("<html><body>NativeDicomModel</body></html>", NULL);
    assert_reader("<osm/>", NULL);
    assert_reader("<", NULL);
    assert_reader("<?xml", NULL);
    assert_reader("<!DOCTYPE", NULL);
}

/* ---- limits ------------------------------------------------------------------------------- */

static void nesting_is_bounded(void **state)
{
    (void)state;
    static const size_t depths[] = { 3, 20000 };
    for (size_t i = 0; i < 2; i++) {
        il_read_options o = IL_READ_OPTIONS_INIT;
        text in = { NULL, 0, 0 }, wrapped = { NULL, 0, 0 };
        o.max_depth = i == 0 ? 2 : o.max_depth;
        repeat(&in, "<sequence tag=\"0040,a730\"><item>", depths[i]);
        text t = set_of(in.s, "A", square);
        assert_refused(&t, &o, "nested more than");
        repeat(&wrapped, "<a>", i == 0 ? 50 : depths[i]);
        assert_refused(&wrapped, &o, "elements nested more than");
        free(in.s), free(t.s), free(wrapped.s);
    }
}

static void a_value_is_bounded(void **state)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    (void)state;
    text data = { NULL, 0, 0 }, values = { NULL, 0, 0 };
    o.max_line = 3000;
    repeat(&data, "1\\", 2000);
    text t = set_of("", "A", data.s);
    assert_refused(&t, &o, "a value of more than 3000 bytes");
    say(&values, "<NativeDicomModel><DicomAttribute tag='00080005'>");
    repeat(&values, "<Value/>", 4000);
    assert_refused(&values, &o, "a value of more than 3000 bytes");
    free(data.s), free(values.s), free(t.s);
}

static void a_long_value_is_read(void **state)
{
    const il_read_options o = IL_READ_OPTIONS_INIT;
    enum { TIMES = 400000 };
    (void)state;
    keeper k;
    il_error err = IL_ERROR_INIT;
    text data = { NULL, 0, 0 };
    say(&data, "0\\0\\1");
    for (int i = 0; i < TIMES; i++)
        say(&data, i % 2 ? "\\12.25\\0.5\\1" : "\\12.5\\10.5\\1");
    text t = set_of("", "A", data.s);
    assert_int_equal(read_bytes(t.s, t.n, &o, &k, &err), IL_OK);
    assert_string_equal(k.fault, "");
    assert_int_equal(k.n_points, TIMES + 1);
    free(k.name), free(data.s), free(t.s);
}

/* ---- blocks --------------------------------------------------------------------------------- */

/* A name of characters and references, read with its every byte at the end of a
 * block of the feed. */
static void texts_do_not_depend_on_blocks(void **state)
{
    enum { BLOCK = 65536 };
    const il_read_options o = IL_READ_OPTIONS_INIT;
    static const char name[] = "\xC3\xA4&#27;&lt;\xE8\x82\x9D&#x1F4A1;\xF0\x9F\xAB\x81&amp;z";
    static const char expected[] = "\xC3\xA4\x1B<\xE8\x82\x9D\xF0\x9F\x92\xA1\xF0\x9F\xAB\x81&z";
    text filler = { NULL, 0, 0 }, whole = { NULL, 0, 0 };
    (void)state;
    text bare = set_of("", "", square);
    size_t before = (size_t)(strstr(bare.s, "vr=\"LO\">") + strlen("vr=\"LO\">") - bare.s);
    repeat(&filler, ".", 1000);
    for (size_t i = 0; i <= sizeof name; i++) {
        keeper k;
        il_error err = IL_ERROR_INIT;
        text blanks = { NULL, 0, 0 };
        whole.n = 0;
        say(&whole, filler.s);
        say(&whole, name);
        repeat(&blanks, " ", BLOCK - before - filler.n - i);
        text t = set_of(blanks.s, whole.s, square);
        assert_int_equal(read_bytes(t.s, t.n, &o, &k, &err), IL_OK);
        assert_string_equal(k.name + filler.n, expected);
        free(k.name), free(t.s), free(blanks.s);
    }
    free(bare.s), free(filler.s), free(whole.s);
}

static void several_files_are_one_set_after_the_other(void **state)
{
    const il_read_options o = IL_READ_OPTIONS_INIT;
    keeper k;
    il_error err = IL_ERROR_INIT;
    (void)state;
    text a = set_of("", "A", square), b = set_of("", "B", square);
    say(&a, b.s);
    assert_int_equal(read_bytes(a.s, a.n, &o, &k, &err), IL_OK);
    assert_int_equal(k.n_stacks, 2);
    assert_string_equal(k.name, "B");
    free(k.name), free(a.s), free(b.s);
}

static void any_failing_allocation_is_told(void **state)
{
    const il_read_options o = IL_READ_OPTIONS_INIT;
    il_status st = IL_E_NOMEM;
    (void)state;
    text t = set_of("<element tag=\"0008,0005\" vr=\"CS\">GBK</element>", "&#184;&#206; &#27;", square);
    for (long n = 0; st != IL_OK && n < 1000; n++) {
        keeper k;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(n);
        st = read_bytes(t.s, t.n, &o, &k, &err);
        il_alloc_test_fail_after(-1);
        if (st != IL_OK)
            assert_int_equal(st, IL_E_NOMEM);
        else
            assert_true(n > 10);
        free(k.name);
    }
    assert_int_equal(st, IL_OK);
    free(t.s);
}

/* ---- values ------------------------------------------------------------------------------------ */

static void add(il_dicom_values *v, const char *number, const char *s, il_error *err)
{
    assert_int_equal(il_dicom_values_begin(v, number, number ? strlen(number) : 0, err), IL_OK);
    assert_int_equal(il_dicom_values_add(v, s, strlen(s), err), IL_OK);
    il_dicom_values_end(v);
}

static void values_are_joined_by_number(void **state)
{
    il_dicom_values v;
    il_error err = IL_ERROR_INIT;
    const char *s;
    size_t n;
    (void)state;
    il_dicom_values_init(&v, 1000);
    il_dicom_values_clear(&v, false);
    assert_int_equal(il_dicom_values_join(&v, &s, &n, &err), IL_OK);
    assert_int_equal(n, 0);
    add(&v, "7", " g\n", &err);
    add(&v, "2", "b\tb", &err);
    add(&v, NULL, "c", &err);
    assert_int_equal(il_dicom_values_join(&v, &s, &n, &err), IL_OK);
    assert_memory_equal(s, "\\b b\\c\\\\g", n);
    assert_int_equal(n, 9);
    il_dicom_values_clear(&v, true);
    add(&v, "1", "\ta\tb ", &err);
    assert_int_equal(il_dicom_values_join(&v, &s, &n, &err), IL_OK);
    assert_int_equal(n, 3);
    assert_memory_equal(s, "a\tb", n);
    il_dicom_values_free(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_forms_are_told_by_their_first_bytes),
        cmocka_unit_test(drawings_stay_drawings),
        cmocka_unit_test(other_xml_is_neither),
        cmocka_unit_test(nesting_is_bounded),
        cmocka_unit_test(a_value_is_bounded),
        cmocka_unit_test(a_long_value_is_read),
        cmocka_unit_test(texts_do_not_depend_on_blocks),
        cmocka_unit_test(several_files_are_one_set_after_the_other),
        cmocka_unit_test(any_failing_allocation_is_told),
        cmocka_unit_test(values_are_joined_by_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
