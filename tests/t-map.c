/* t-map.c - what a set of map features becomes, told to it as a parser would.
 *
 * The features come in a small language of words: "crs TEXT", "degrees", "unit U", "f" (a feature
 * begins), "a NAME VALUE", "p NAME VALUE" (a place), "line", "ring", "point" (a part begins)
 * with numbers x y behind it, or "line3", "point3" with x y z. */
#include "config.h"
#include "base/number.h"
#include "input/map-set.h"
#include "output/writer.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- the parser ---------------------------------------------------------------- */

typedef struct script {
    const char *s;
    char word[300];
    bool in_feature, in_part;
} script;

/* The next word, or null: up to a blank, or in quotation marks. */
static const char *next(script *w)
{
    w->s += strspn(w->s, " \n");
    size_t n = *w->s == '\'' ? strcspn(++w->s, "'") : strcspn(w->s, " \n");
    if (n == 0 && !*w->s)
        return NULL;
    assert_true(n < sizeof w->word);
    memcpy(w->word, w->s, n);
    w->word[n] = '\0';
    w->s += n + (w->s[n] == '\'');
    return w->word;
}

static il_status end_part(script *w, il_map_set *set, il_error *err)
{
    bool was = w->in_part;
    w->in_part = false;
    return was ? il_map_end_part(set, err) : IL_OK;
}

static il_status attribute(script *w, il_map_set *set, bool place, il_error *err)
{
    char name[300];
    snprintf(name, sizeof name, "%s", next(w));
    const char *value = next(w);
    size_t n = strlen(value);
    return place ? il_map_place(set, name, value, n, err) : il_map_attribute(set, name, strlen(name), value, n, err);
}

static il_status points(script *w, il_map_set *set, size_t columns, il_error *err)
{
    double v[3] = { 0, 0, NAN };
    il_status st = IL_OK;
    for (;;) {
        script before = *w;
        for (size_t k = 0; k < columns; k++) {
            const char *word = next(w);
            if (!word || il_number_parse(word, strlen(word), &v[k]) != strlen(word)) {
                assert_int_equal(k, 0);
                *w = before;
                return st;
            }
        }
        st = st == IL_OK ? il_map_point(set, v[0], v[1], v[2], 1, err) : st;
    }
}

static il_status begin(script *w, il_map_set *set, il_map_part kind, size_t columns, il_error *err)
{
    il_status st = end_part(w, set, err);
    if (st == IL_OK)
        st = il_map_begin_part(set, kind, 1, err);
    w->in_part = st == IL_OK;
    return st == IL_OK ? points(w, set, columns, err) : st;
}

static il_status command(script *w, il_map_set *set, const char *word, il_error *err)
{
    il_unit unit;
    il_status st = IL_OK;
    if (strcmp(word, "line") == 0 || strcmp(word, "line3") == 0)
        return begin(w, set, IL_MAP_LINE, word[4] ? 3 : 2, err);
    if (strcmp(word, "ring") == 0)
        return begin(w, set, IL_MAP_RING, 2, err);
    if (strcmp(word, "point") == 0 || strcmp(word, "point3") == 0)
        return begin(w, set, IL_MAP_POINT, word[5] ? 3 : 2, err);
    if (strcmp(word, "a") == 0 || strcmp(word, "p") == 0)
        return attribute(w, set, *word == 'p', err);
    if (strcmp(word, "crs") == 0) {
        const char *text = next(w);
        return il_map_crs(set, text, strlen(text), 1, err);
    }
    if (strcmp(word, "degrees") == 0) {
        il_map_degrees(set);
    } else if (strcmp(word, "unit") == 0) {
        const char *name = next(w);
        assert_true(il_unit_parse(name, strlen(name), &unit));
        return il_map_unit(set, unit, 1, err);
    } else {
        assert_string_equal(word, "f");
        st = end_part(w, set, err);
        if (st == IL_OK && w->in_feature)
            st = il_map_end_feature(set, err);
        w->in_feature = true;
        st = st == IL_OK ? il_map_begin_feature(set, 1, err) : st;
    }
    return st;
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    char text[20000];
    size_t n = 0, got = 1;
    (void)options;
    il_status st = IL_OK;
    for (; st == IL_OK && got > 0; n += got)
        st = il_source_read(source, text + n, sizeof text - 1 - n, &got, err);
    text[n] = '\0';
    script w = { .s = text };
    for (const char *word; st == IL_OK && (word = next(&w)) != NULL;)
        st = command(&w, set, word, err);
    if (st == IL_OK)
        st = end_part(&w, set, err);
    return st == IL_OK && w.in_feature ? il_map_end_feature(set, err) : st;
}

/* ---- running it ------------------------------------------------------------------- */

static const il_read_options defaults = IL_READ_OPTIONS_INIT;
static il_report report;
static char output[20000];
static char origins[2000]; /* of the lines, as they came: " FILE:FEATURE" of each */

/* Hands on to a writer, and keeps what native text does not say. */
typedef struct witness {
    il_sink sink, *next;
    il_stack_head head;
} witness;

static il_status see_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    witness *w = (witness *)self;
    *origins = '\0';
    assert_int_equal(il_stack_head_copy(&w->head, head, err), IL_OK);
    return w->next->stack_begin(w->next, head, err);
}

static il_status see_slice(il_sink *self, il_slice *s, il_error *err)
{
    witness *w = (witness *)self;
    for (size_t i = 0; i < s->n; i++) {
        assert_true(s->ring[i].file < w->head.n_files);
        snprintf(origins + strlen(origins), sizeof origins - strlen(origins), " %s:%ld", w->head.file[s->ring[i].file],
                 s->ring[i].feature);
    }
    return w->next->slice(w->next, s, err);
}

static il_status see_stack_end(il_sink *self, il_error *err)
{
    witness *w = (witness *)self;
    return w->next->stack_end(w->next, err);
}

static il_status see_end(il_sink *self, il_error *err)
{
    witness *w = (witness *)self;
    return w->next->end(w->next, err);
}

/* The native text that FILES become (null-terminated list), without its first line and
 * its last; the error's text after a failure. */
static const char *run(const char *const *file, const il_read_options *o)
{
    il_source *source[4];
    il_output *out = NULL;
    il_sink *writer = NULL;
    il_error err = IL_ERROR_INIT;
    size_t n = 0, size;
    static const char *const names[] = { "map", "two", "three", "four" };
    il_report_free(&report);
    for (; file[n]; n++)
        assert_int_equal(il_source_from_memory(&source[n], file[n], strlen(file[n]), names[n], &err), IL_OK);
    assert_int_equal(il_output_to_memory(&out, &err), IL_OK);
    assert_int_equal(il_writer_loft.contours_new(&writer, out, &err), IL_OK);
    witness w = { .sink = { see_stack, see_slice, NULL, see_stack_end, see_end }, .next = writer };
    il_status st = il_map_read("Test", parse, source, n, o, &w.sink, &report, &err);
    il_stack_head_free(&w.head);
    const unsigned char *text = il_output_memory(out, &size);
    if (st == IL_OK)
        snprintf(output, sizeof output, "%.*s", (int)(size - strlen("isoloft 1\nend\n")), (const char *)text + strlen("isoloft 1\n"));
    else
        snprintf(output, sizeof output, "%s", err.text);
    assert_true(st == IL_OK || st == IL_E_INPUT || st == IL_E_USAGE);
    il_writer_loft.contours_free(writer);
    il_output_discard(out);
    for (size_t k = 0; k < n; k++)
        il_source_close(source[k]);
    return output;
}

static const char *read_map(const char *text, const il_read_options *o)
{
    const char *const files[] = { text, NULL };
    return run(files, o ? o : &defaults);
}

static bool noted(const char *words)
{
    for (size_t k = 0; k < report.n_notes; k++)
        if (strstr(report.note[k], words))
            return true;
    return false;
}

static void assert_noted(const char *words)
{
    if (noted(words))
        return;
    for (size_t k = 0; k < report.n_notes; k++)
        print_error("note: %s\n", report.note[k]);
    fail_msg("nothing is said of '%s'", words);
}

static void assert_contains(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in: %s", words, text);
}

/* The heights of the slices of OUTPUT, with a blank before each. */
static const char *heights(const char *text)
{
    static char list[400];
    *list = '\0';
    for (const char *p = strstr(text, "slice "); p; p = strstr(p + 1, "slice "))
        snprintf(list + strlen(list), sizeof list - strlen(list), " %.*s", (int)strcspn(p + 6, "\n"), p + 6);
    return list;
}

/* ---- heights -------------------------------------------------------------------- */

#define TWO(a, b) "f " a " line 100 0 200 0 f " b " line 100 50 200 50"

static void an_attribute_of_a_usual_name_is_the_height(void **state)
{
    static const char *const names[] = { "elev", "ELEV", "Elevation", "ele", "HEIGHT", "contour", "Level", "z", "alt", "hoogte",
        "depth_m", "contour_elevation", "Elev_Meters", "height (m)", "CONTOUR_M", "H\xC3\xB6he",
        "ContourElevation", "CONTOURELE", "PROP_VALUE" };
    (void)state;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char text[200];
        snprintf(text, sizeof text, "f a ID 1 a '%s' 10 line 100 0 200 0 f a ID 2 a '%s' 20 line 100 50 200 50", names[k], names[k]);
        if (strncmp(names[k], "depth", 5) == 0)
            assert_string_equal(heights(read_map(text, NULL)), " -20 -10");
        else if (strcmp(names[k], "PROP_VALUE") != 0)
            assert_string_equal(heights(read_map(text, NULL)), " 10 20");
    }
}

static void other_names_are_no_heights(void **state)
{
    static const char *const names[] = { "ID", "length", "shape_leng", "levels", "elev_index", "zone", "width", "elevator", "" };
    (void)state;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char text[200];
        snprintf(text, sizeof text, "f a '%s' 10 line 100 0 200 0 f a '%s' 20 line 100 50 200 50", names[k], names[k]);
        assert_contains(read_map(text, NULL), "has no heights");
    }
    assert_contains(read_map(TWO("a ID 1 a name x", "a ID 2"), NULL), "attributes: ID, name (--height NAME names one)");
    assert_contains(read_map(TWO("", ""), NULL), "no z and no attributes at all");
}

static void the_first_usual_name_that_tells_levels_apart_wins(void **state)
{
    (void)state;
    assert_string_equal(heights(read_map(TWO("a level 1 a elev 10", "a level 2 a elev 20"), NULL)), " 10 20");
    assert_string_equal(heights(read_map(TWO("a elev 0 a level 1", "a elev 0 a level 2"), NULL)), " 1 2");
    assert_string_equal(heights(read_map("f a elev 5 line3 0 0 1 90 0 1 f a elev 5 line3 0 50 2 90 50 2", NULL)), " 1 2");
    assert_string_equal(heights(read_map("f a elev 5 line3 0 0 1 90 0 1 f a elev 6 line3 0 50 2 90 50 2", NULL)), " 5 6");
    assert_noted("heights: attribute 'elev', m");
}

static void z_comes_before_the_place_of_the_format(void **state)
{
    (void)state;
    assert_string_equal(heights(read_map("f p name 7 line3 0 0 1 90 0 1 f p name 8 line3 0 50 2 90 50 2", NULL)), " 1 2");
    assert_noted("heights: z coordinates, m");
    assert_string_equal(heights(read_map("f p name 7 line3 0 0 0 90 0 0 f p name '8 m' line3 0 50 0 90 50 0", NULL)), " 7 8");
    assert_noted("heights: the text in 'name', m");
}

static void height_names_an_attribute(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.height = "Class";
    assert_string_equal(heights(read_map(TWO("a elev 1 a class 10", "a elev 2 a class 30"), &o)), " 10 30");
    assert_string_equal(heights(read_map(TWO("a class 'L-100 minor'", "a class 'L-50'"), &o)), " 50 100");
    assert_contains(read_map(TWO("a elev 1", "a elev 2"), &o), "no feature has 'Class' (--height); attributes: elev");
    o.map.height = "z";
    assert_string_equal(heights(read_map("f a elev 5 line3 0 0 1 90 0 1 f a elev 6 line3 0 50 2 90 50 2", &o)), " 1 2");
    assert_contains(read_map(TWO("a elev 1", "a elev 2"), &o), "no point has a 'z' coordinate (--height); attributes: elev");
    o.map.height = "from,to";
    assert_contains(read_map(TWO("a from 1 a to 2", "a from 2 a to 3"), &o),
                    "has no bands: no polygon has its two heights in the attributes 'from' and 'to'");
}

static void a_height_may_stand_behind_many_others(void **state)
{
    (void)state;
    char text[20000] = "";
    size_t n = 0;
    for (int f = 1; f <= 2; f++) {
        n += (size_t)snprintf(text + n, sizeof text - n, "f ");
        for (int k = 0; k < 300; k++)
            n += (size_t)snprintf(text + n, sizeof text - n, "a name%d 7 ", k);
        n += (size_t)snprintf(text + n, sizeof text - n, "a elev %d0 line 100 %d 200 %d ", f, f, f);
    }
    assert_string_equal(heights(read_map(text, NULL)), " 10 20");
    for (char *p = strstr(text, "elev"); p; p = strstr(p, "elev"))
        memcpy(p, "eleW", 4);
    assert_contains(read_map(text, NULL), " and many more (--height NAME names one)");
}

static void files_may_spell_an_attribute_differently(void **state)
{
    (void)state;
    const char *const files[] = { "f a elev 10 line 100 0 200 0", "f a ELEV 20 line 100 50 200 50", "f a Elev 30 line 9 5 2 5", NULL };
    assert_string_equal(heights(run(files, &defaults)), " 10 20 30");
    assert_int_equal(report.n_skipped, 0);
    /* In one file they are two. */
    assert_string_equal(heights(read_map(TWO("a elev 1 a ELEV 7", "a ELEV 8 a elev 2"), NULL)), " 1 2");
    const char *const both[] = { "f a elev 1 line 100 0 200 0", "f a elev 2 a ELEV 7 line 100 50 200 50", NULL };
    assert_string_equal(heights(run(both, &defaults)), " 1 2");
}

static void lines_without_a_height_are_left_out_and_counted(void **state)
{
    (void)state;
    assert_string_equal(heights(read_map(TWO("a elev 1", "a elev 2") " f a elev '' line 0 90 9 90 f line 0 91 9 91", NULL)), " 1 2");
    assert_int_equal(report.n_skipped, 2);
    assert_string_equal(report.skip[0].why, "has no height");
}

static void a_line_whose_height_varies_is_no_isoline(void **state)
{
    (void)state;
    assert_contains(read_map("f line3 0 0 1 90 0 2 f line3 0 50 2 90 50 3.5", NULL),
                    "is no isoline but a track or profile: its height varies from 1 to 2");
    assert_string_equal(heights(read_map("f line3 0 0 1 90 0 1 f line3 0 50 2 90 50 2 f line3 0 60 2 90 60 3", NULL)), " 1 2");
    assert_int_equal(report.n_skipped, 1);
    assert_string_equal(report.skip[0].why, "its height varies: it is no isoline");
}

static void one_level_is_refused_unless_a_side_is_given(void **state)
{
    (void)state;
    il_read_options o = defaults;
    assert_contains(read_map(TWO("a elev 5", "a elev 5"), NULL), "has one level only, 5 (attribute 'elev')");
    o.map.high = IL_SIDE_LEFT;
    assert_string_equal(heights(read_map(TWO("a elev 5", "a elev 5"), &o)), " 5");
}

static void a_map_without_lines_is_refused(void **state)
{
    (void)state;
    assert_contains(read_map("f a elev 5 point 1 1", NULL), "has no lines and no polygons");
    assert_contains(read_map("", NULL), "has no lines and no polygons");
    assert_contains(read_map("f a elev 5 line f line", NULL), "has no lines and no polygons");
}

/* ---- units and depths ------------------------------------------------------------- */

static void depths_count_down(void **state)
{
    (void)state;
    il_read_options o = defaults;
    assert_string_equal(heights(read_map(TWO("a depth 5", "a depth 0"), NULL)), " -5 0");
    assert_noted("positive down");
    assert_string_equal(heights(read_map(TWO("a depth -5", "a depth 0"), NULL)), " -5 0");
    assert_noted("depths are below 0");
    assert_string_equal(heights(read_map(TWO("a depth -2", "a depth 8"), NULL)), " -8 2");
    o.map.depth = IL_DEPTH_DOWN;
    assert_string_equal(heights(read_map(TWO("a elev -5", "a elev 0"), &o)), " 0 5");
    o.map.depth = IL_DEPTH_UP;
    assert_string_equal(heights(read_map(TWO("a depth 5", "a depth 0"), &o)), " 0 5");
}

static void feet_become_the_unit_of_the_stack(void **state)
{
    (void)state;
    il_read_options o = defaults;
    assert_string_equal(heights(read_map(TWO("a elev_ft 10", "a elev_ft 20"), NULL)), " 3.048 6.096");
    assert_noted("ft, converted to m");
    assert_string_equal(heights(read_map(TWO("a elev '10 ft'", "a elev '20 ft'"), NULL)), " 3.048 6.096");
    assert_string_equal(heights(read_map("unit ft " TWO("a elev_m 3.048", "a elev_m 6.096"), NULL)), " 10 20");
    o.map.has_z_unit = true;
    o.map.z_unit = IL_UNIT_FT;
    assert_string_equal(heights(read_map(TWO("a elev_m 10", "a elev_m 20"), &o)), " 3.048 6.096");
    assert_contains(read_map("crs 'PROJCS[\"x\",GEOGCS[\"y\",UNIT[\"Degree\",0.0174532925199433]],UNIT[\"Foot_US\",0.3048006096012192]]' "
                             TWO("a elev 10", "a elev 20"), NULL), "unit ft");
    assert_noted("U.S. survey feet");
}

static void heights_that_conversion_takes_beyond_the_bound_are_refused(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.has_z_unit = true;
    o.map.z_unit = IL_UNIT_KM;
    const char *text = "unit um " TWO("a elev 1", "a elev 1000000");
    assert_string_equal(read_map(text, &o), "a height reaches 1e15 when converted to um");
    assert_string_equal(heights(read_map("unit um " TWO("a elev 1", "f a name x line 0 0 9 9 f a elev 900000"), &o)), " 1e+09 9e+14");
}

static void levels_that_only_decimals_tell_apart_are_one(void **state)
{
    (void)state;
    assert_string_equal(heights(read_map(TWO("a elev 10.1", "a elev 20") " f a elev 10.100000381 line 0 90 9 90 f a "
        "elev 10.1 line 0 91 9 91",
                                         NULL)), " 10.1 20");
    assert_int_equal(report.repair[IL_REPAIR_MOVED_CONTOUR], 1);
    assert_true(fabs(report.largest_move - 3.81e-7) < 1e-12);
}

/* ---- degrees ------------------------------------------------------------------------ */

static void degrees_are_believed_where_they_can_be(void **state)
{
    (void)state;
    const char *far = "f a elev 1 line 100 0 200 0 f a elev 2 line 100 500 200 500",
        *here = "f a elev 10 line 9 50 9.1 50 f a elev 20 line 9 50.1 9.1 50.1";
    char text[400];
    assert_contains(read_map(here, NULL), "unit m\nstack \"\"\nkind terrain\ncrs \"EPSG:32632\"");
    assert_noted("no coordinate system given; numbers and relief are those of degrees");
    snprintf(text, sizeof text, "crs EPSG:4326 %s", here);
    assert_contains(read_map(text, NULL), "crs \"EPSG:32632\"");
    snprintf(text, sizeof text, "degrees %s", here);
    assert_contains(read_map(text, NULL), "crs \"EPSG:32632\"");
    snprintf(text, sizeof text, "crs EPSG:4807 %s", here);
    assert_contains(read_map(text, NULL), "crs \"EPSG:32632\"");
    assert_noted("the coordinate system 'EPSG:4807' is not known here; numbers and relief are those of degrees");
    assert_noted("the ellipsoid of 'EPSG:4807' is not known here: WGS 84 is taken");
    snprintf(text, sizeof text, "crs EPSG:4326 %s", far);
    assert_contains(read_map(text, NULL), "line\n100 0\n200 0\n");
    assert_contains(read_map("crs 'GEOGCS[\"x\",UNIT[\"grad\",0.0157079632679489]]' f a elev 1 line 9 50 9 51", NULL),
        "its angles are not degrees");
    assert_contains(read_map(text, NULL), "line\n100 0\n200 0\n");
    assert_noted("labelled as degrees (EPSG:4326), which coordinates from 100, 0 to 200, 500 can");
}

static void what_relief_denies_is_not_taken_for_degrees(void **state)
{
    (void)state;
    il_read_options o = defaults;
    const char *local = "f a elev 1 line 9 50 30 50 f a elev 2 line 9 70 30 70";
    assert_contains(read_map(local, NULL), "line\n9 50\n30 50\n");
    o.has_unit = true;
    o.unit = IL_UNIT_DEG;
    assert_contains(read_map(local, &o), "+proj=tmerc");
    o.unit = IL_UNIT_MM;
    assert_contains(read_map("f a elev 1 line 9 50 9.1 50 f a elev 2 line 9 50.1 9.1 50.1", &o), "unit mm");
    assert_contains(read_map("crs EPSG:27700 f a elev 1 line 9 50 9.1 50 f a elev 2 line 9 50.1 9.1 50.1", NULL), "line\n9 50\n9.1 50\n");
}

static void project_none_keeps_degrees(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.project = IL_PROJECT_NONE;
    assert_string_equal(read_map("crs urn:ogc:def:crs:OGC:1.3:CRS84 f a elev_ft 10 line 9 50 9.1 50 f a elev_ft 20 line 9 50.1 9.1 50.1",
        &o),
                        "unit deg\nstack \"\"\nkind terrain\ncrs \"OGC:CRS84\"\nslice 3.048\nline\n9 50\n9.1 50\n"
                        "slice 6.096\nline\n9 50.1\n9.1 50.1\n");
}

static void project_asks_for_degrees(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.project = IL_PROJECT_UTM;
    assert_contains(read_map("f a elev 1 line 0 0 999 0 f a elev 2 line 0 9 999 9", &o), "are no degrees, which --project asks for");
    assert_contains(read_map("crs EPSG:27700 " TWO("a elev 1", "a elev 2"), &o), "lengths already (EPSG:27700)");
    assert_contains(read_map("f a elev 1 line 9 50 25 50 f a elev 2 line 9 70 25 70", &o), "crs \"EPSG:32633\"");
}

static void files_of_two_systems_are_no_map(void **state)
{
    const char *const other[] = { "crs EPSG:26915 " TWO("a elev 1", "a elev 2"), "crs EPSG:26916 " TWO("a elev 1", "a elev 2"), NULL },
               *const same[] = { "crs EPSG:26915 " TWO("a elev 1", "a elev 2"), "crs urn:ogc:def:crs:EPSG::26915 f a elev 3 line 1 1 9 9",
                   NULL };
    (void)state;
    assert_string_equal(run(other, &defaults), "its coordinate system is 'EPSG:26916', and 'EPSG:26915' before it");
    assert_string_equal(heights(run(same, &defaults)), " 1 2 3");
    assert_false(noted("taken for the same"));
    const char *const words[] = { "crs 'Grid A' " TWO("a elev 1", "a elev 2"), "crs 'Grid B' f a elev 3 line 1 1 9 9", NULL };
    assert_string_equal(heights(run(words, &defaults)), " 1 2 3");
    assert_noted("its coordinate system, 'Grid B', is taken for the same as 'Grid A' before it");
}

/* The stack would say of lengths that they are degrees. */
static void a_system_that_is_denied_is_not_handed_on(void **state)
{
    (void)state;
    il_read_options o = defaults;
    read_map("crs EPSG:4326 f a elev 1 line 0 0 999 0 f a elev 2 line 0 9 999 9", NULL);
    assert_noted("labelled as degrees (EPSG:4326)");
    assert_contains(output, "unit m\n");
    assert_null(strstr(output, "crs"));
    o.has_unit = true;
    o.unit = IL_UNIT_FT;
    read_map("crs EPSG:4326 f a elev 1 line 9 50 9.1 50 f a elev 2 line 9 50.1 9.1 50.1", &o);
    assert_contains(output, "unit ft\n");
    assert_null(strstr(output, "crs"));
}

static void edges_stray_by_a_millionth_of_the_map(void **state)
{
    (void)state;
    read_map("crs EPSG:4326 f a elev 1 line 0 60 20 60 f a elev 2 line 0 60.1 20 60.1", NULL);
    assert_noted("none strays farther than 1.11"); /* 20 degrees on a parallel half as long as the equator */
}

static void files_of_two_units_are_no_map(void **state)
{
    const char *const files[] = { "unit mm " TWO("a elev 1", "a elev 2"), "unit m f a elev 3 line 1 1 9 9", NULL };
    il_read_options o = defaults;
    (void)state;
    assert_string_equal(run(files, &o), "its unit is m, and mm before it (--unit says what both are)");
    o.has_unit = true;
    o.unit = IL_UNIT_M;
    assert_string_equal(heights(run(files, &o)), " 1 2 3");
    const char *const degrees[] = { "degrees f a elev 1 line 9 50 9 51", "f a elev 2 line 9 50 10 50", NULL };
    run(degrees, &defaults);
    assert_noted("1 of 2 files say that they are in degrees; all are taken so");
}

static void longitudes_run_across_the_antimeridian(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.project = IL_PROJECT_NONE;
    const char *text = "crs EPSG:4326 f a elev 100 line 179.5 -17 180 -17 f a elev 100 line -180 -17 -179.5 -17 "
                       "f a elev 200 line 179.75 -17.5 -179.75 -17.5";
    assert_contains(read_map(text, &o), "slice 100\nline\n179.5 -17\n180 -17\nline\n180 -17\n180.5 -17\nslice "
        "200\nline\n179.75 -17.5\n180.25 -17.5\n");
    assert_contains(read_map(text, NULL), "crs \"EPSG:327");
    o.map.project = IL_PROJECT_TM;
    assert_contains(read_map(text, &o), "+lon_0=180 ");
}

static void maps_around_a_pole_are_stereographic(void **state)
{
    (void)state;
    assert_contains(read_map("crs EPSG:4326 f a elev 1 ring 0 80 90 80 180 80 -90 80 f a elev 2 ring 0 85 120 85 -120 85", NULL),
        "EPSG:5041");
    assert_contains(read_map("crs EPSG:4326 f a elev 1 line 0 -85 90 -85 f a elev 2 line 0 -86 90 -86", NULL), "EPSG:5042");
    assert_contains(read_map("crs EPSG:4326 f a elev 1 line -170 0 -90 0 0 0 90 0 170 0 f a elev 2 line -90 10 0 10", NULL),
                    "340 degrees wide, and no projection here takes more than 120");
}

/* ---- borders ------------------------------------------------------------------------ */

/* Three bands side by side on a map of 30 by 10, cut at x = 10 and 20. */
#define BANDS(low, high) \
    "f a " low " 0 a " high " 10 ring 0 0 10 0 10 10 0 10 f a " low " 10 a " high " 20 ring 10 0 20 0 20 10 10 10 " \
    "f a " low " 20 a " high " 30 ring 20 0 30 0 30 10 20 10"

static void bands_have_lines_between_them(void **state)
{
    (void)state;
    il_read_options o = defaults;
    const char *expected = "unit m\nstack \"\"\nkind terrain\nslice 10\nline\n10 10\n10 0\nslice 20\nline\n20 10\n20 0\n";
    assert_string_equal(read_map(BANDS("elev_min", "elev_max"), NULL), expected);
    assert_string_equal(read_map(BANDS("ELEVMIN", "ELEVMAX"), NULL), expected);
    assert_string_equal(read_map(BANDS("min", "max"), NULL), expected);
    assert_string_equal(read_map(BANDS("emin", "emax"), NULL), expected);
    o.map.height = "a,b";
    assert_string_equal(read_map(BANDS("a", "b"), &o), expected);
    assert_noted("isolines are the 2 edges between two of them; 8 edges on the map's frame are none");
}

static void the_outermost_bands_may_lack_an_end(void **state)
{
    (void)state;
    const char *other[] = { "a min 0 a max -20", "a max -20", "a min '' a max -20" };
    for (size_t k = 0; k < sizeof other / sizeof *other; k++) {
        char text[400];
        snprintf(text, sizeof text, "f %s ring 0 0 10 0 10 10 0 10 f a min -20 a max 10 ring 10 0 20 0 20 10 10 10 "
                 "f a min 10 %s ring 20 0 30 0 30 10 20 10", other[k], k == 0 ? "a max 0" : "");
        assert_string_equal(heights(read_map(text, NULL)), " -20 10");
        assert_int_equal(report.n_skipped, 0);
    }
}

static void an_island_of_a_band_is_a_ring(void **state)
{
    (void)state;
    assert_string_equal(
        read_map("f a min 0 a max 10 ring 0 0 30 0 30 30 0 30 ring 10 10 10 20 20 20 20 10 f a min 10 a max 20 ring 10 "
            "10 20 10 20 20 10 20 "
                 "ring 12 12 14 12 14 14 12 14 f a min 20 a max 30 ring 12 12 14 12 14 14 12 14", NULL),
        "unit m\nstack \"\"\nkind terrain\nslice 10\nring\n10 10\n20 10\n20 20\n10 20\nslice 20\nring\n12 12\n14 12\n14 14\n12 14\n");
}

static void bands_that_are_no_neighbours_meet_in_a_cliff(void **state)
{
    (void)state;
    assert_string_equal(heights(read_map(BANDS("min", "max") " f a min 0 a max 10 ring 30 0 40 0 40 10 30 10", NULL)), " 10 20");
    assert_contains(output, "slice 10\nline\n10 10\n10 0\nline\n30 0\n30 10\nslice 20\nline\n20 10\n20 0\nline\n30 0\n30 10\n");
}

static void an_edge_that_comes_often_is_met_two_and_two(void **state)
{
    (void)state;
    const char *expected = "unit m\nstack \"\"\nkind terrain\nslice 10\nline\n0 0\n10 0\nline\n0 0\n10 0\nslice 20\nline\n0 0\n10 0\n";
    assert_string_equal(
        read_map("unit m f a min 0 a max 10 ring 0 0 10 0 5 5 f a min 10 a max 20 ring 0 0 10 0 5 -5 "
                 "f a min 0 a max 10 ring 0 0 10 0 5 6 f a min 10 a max 20 ring 0 0 10 0 5 -6 "
                 "f a min 10 a max 20 ring 0 0 10 0 5 7 f a min 20 a max 30 ring 0 0 10 0 5 -7 "
                 "f a min 90 a max 99 ring 0 0 10 0 5 8", NULL), expected);
}

/* K bands apart from one another, and one below them all and one above that meet along
 * K edges: each edge is an isoline at each level. */
static void cliffs_over_very_many_levels_are_refused(void **state)
{
    (void)state;
    enum { K = 280, SIZE = 20000 };
    char text[SIZE];
    size_t n = 0;
    for (int k = 0; k < K; k++)
        n += (size_t)snprintf(text + n, SIZE - n, "f a min %d a max %d ring %d 50 %d 50 %d 51 ", k, k + 1, 3 * k, 3 * k + 1, 3 * k);
    for (int side = -1; side < 2; side += 2) {
        n += (size_t)snprintf(text + n, SIZE - n, "f a min %d a max %d ring 0 %d %d %d ", side < 0 ? -1 : K, side < 0 ? 0 : K + 1,
                              9 * side, K, 9 * side);
        for (int k = K; k >= 0; k--)
            n += (size_t)snprintf(text + n, SIZE - n, "%d %d ", k, k % 2);
    }
    assert_true(n < SIZE);
    assert_contains(read_map(text, NULL), "isolines between its bands would have more than");
}

static void bands_without_borders_are_refused(void **state)
{
    (void)state;
    assert_contains(read_map("f a min 0 a max 10 ring 0 0 9 0 9 9 f a min 10 a max 20 ring 50 0 59 0 59 9", NULL),
                    "its bands have no border with one another");
}

static void one_height_for_each_band_is_too_little(void **state)
{
    (void)state;
    assert_contains(read_map("f a elev 0 ring 0 0 9 0 9 9 0 9 ring 2 2 7 2 7 7 2 7 f a elev 10 ring 2 2 7 2 7 7 2 7 ring 4 4 5 4 5 5 4 5 "
                             "f a elev 20 ring 4 4 5 4 5 5 4 5", NULL), "both heights are needed");
}

static void polygons_of_one_height_lose_the_borders_between_them(void **state)
{
    (void)state;
    assert_contains(read_map("f a elev 1 ring 0 0 10 0 10 10 0 10 f a elev 1 ring 20 0 20 10 10 10 10 0 f a elev 2 ring 4 4 6 4 6 6",
        NULL),
                    "slice 1\n");
    assert_null(strstr(output, "ring\n0 0"));
    assert_contains(output, "slice 2\nring\n4 4\n6 4\n6 6\n");
    assert_contains(read_map("f a elev 1 ring 0 0 9 0 9 9 f a elev 1 ring 9 9 9 0 0 0 f a elev 2 ring 4 1 6 1 6 2", NULL),
        "slice 1\nring\n0 0\n9 0\n9 9\n");
    assert_int_equal(report.repair[IL_REPAIR_DUPLICATE_RING], 1);
}

/* ---- sheets that overlap ------------------------------------------------------------ */

#define OTHER " f a elev 9 line 0 90 60 90"

/* One sheet ends at x = 35, the other begins at x = 15; both hold the vertices 20 and 30. */
static void ends_on_an_edge_of_another_sheet_are_taken_off(void **state)
{
    (void)state;
    const char *west = "f a elev 5 line 0 0 10 5 20 0 30 5 35 2.5" OTHER, *east = "f a elev 5 line 15 2.5 20 0 30 5 40 0 50 5";
    const char *const files[] = { west, east, NULL }, *const back[] = { east, west, NULL };
    assert_contains(run(files, &defaults), "slice 5\nline\n0 0\n10 5\n20 0\n30 5\nline\n20 0\n30 5\n40 0\n50 5\n");
    assert_int_equal(report.repair[IL_REPAIR_SHARED_EDGE], 2);
    char first[400];
    snprintf(first, sizeof first, "%.399s", output);
    assert_string_equal(run(back, &defaults), first);
}

static void ends_beside_an_edge_stay(void **state)
{
    (void)state;
    /* Beside the edge, beyond it, at its end, back from its vertex, of another level. */
    static const char *const lines[] = { "f a elev 5 line 0 40 20 0 25 2.51", "f a elev 5 line 0 40 20 0 40 10",
        "f a elev 5 line 0 40 20 0 30 5", "f a elev 5 line 0 40 30 5 40 10", "f a elev 6 line 0 40 20 0 25 2.5" };
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        char text[200];
        snprintf(text, sizeof text, "f a elev 5 line 20 0 30 5 30 60 %s" OTHER, lines[k]);
        read_map(text, NULL);
        assert_int_equal(report.repair[IL_REPAIR_SHARED_EDGE], 0);
        assert_int_equal(report.repair[IL_REPAIR_DUPLICATE_LINE], 0);
    }
}

static void lines_within_edges_are_dropped(void **state)
{
    (void)state;
    const char *text = "f a elev 5 line 20 0 30 5 30 60 f a elev 5 line 20 0 22 1 f a elev 5 line 29 4.5 30 5 30 7" OTHER;
    assert_contains(read_map(text, NULL), "slice 5\nline\n20 0\n30 5\n30 60\nslice 9");
    assert_int_equal(report.repair[IL_REPAIR_DUPLICATE_LINE], 2);
    /* An outline drawn on beyond its beginning. */
    assert_contains(read_map("f a elev 5 line 0 0 9 0 9 9 0 0 4 0" OTHER, NULL), "slice 5\nline\n0 0\n9 0\n9 9\n0 0\n");
}

/* ---- where lines come from ----------------------------------------------------------- */

static void lines_know_their_file_and_feature(void **state)
{
    (void)state;
    const char *const files[] = { "f a elev 10 line 0 0 9 0 f a name x f a elev 20 line 0 5 9 5 line 0 6 9 6",
                                  "f a elev 20 line 0 7 9 7 f a elev 10 line 0 8 9 8", NULL };
    run(files, &defaults);
    assert_string_equal(origins, " map:1 two:2 map:3 map:3 two:1");
    read_map("f a min 0 a max 10 ring 0 0 5 0 5 9 0 9 f a min 10 a max 20 ring 5 0 9 0 9 9 5 9 "
             "f a min 20 a max 30 ring 9 0 12 0 12 9 9 9", NULL);
    assert_string_equal(origins, " map:2 map:3"); /* borders, of the band above them */
}

/* ---- spot heights --------------------------------------------------------------------- */

/* The spot heights of OUTPUT: "x y z; " each. */
static const char *spots(const char *text)
{
    static char list[800];
    *list = '\0';
    for (const char *p = strstr(text, "spot "); p; p = strstr(p + 1, "spot "))
        snprintf(list + strlen(list), sizeof list - strlen(list), "%.*s; ", (int)strcspn(p + 5, "\n"), p + 5);
    return list;
}

/* COUNT points were skipped since WHY. */
static void assert_points_skipped(size_t count, const char *why)
{
    size_t n = 0;
    for (size_t k = 0; k < report.n_skips; k++)
        n += strcmp(report.skip[k].what, "point") == 0 && strcmp(report.skip[k].why, why) == 0 ? report.skip[k].count : 0;
    assert_int_equal(n, count);
}

static void points_with_a_height_are_spot_heights(void **state)
{
    (void)state;
    static const struct { const char *text, *spots; size_t n_skipped; } c[] = {
        { TWO("a elev 10", "a elev 20") " f a elev 25 point 150 20 f a elev 26 point 120 30 point 120 20",
          "120 20 26; 120 30 26; 150 20 25; ", 0 },
        { "f a elev 25 point 150 20 " TWO("a elev 10", "a elev 20"), "150 20 25; ", 0 },
        { TWO("a elev 10", "a elev 20") " f a elev 25 point3 150 20 99", "150 20 25; ", 0 }, /* where lines have it comes first */
        { TWO("a elev 10", "a elev 20") " f a name x point3 150 20 12.5 f point3 150 21 0", "150 20 12.5; 150 21 0; ", 0 },
        { TWO("a elev 10", "a elev 20") " f a name x point 150 20 f a elev x point 1 1", "", 2 },
        { TWO("a elev 10", "a elev 20") " f a name label point3 150 20 0 point3 160 20 0", "", 2 }, /* as drawings have it */
        { TWO("a elev 10", "a elev 20") " f a elev 0 point3 150 20 0", "150 20 0; ", 0 },
        { TWO("p name 10", "p name 20") " f p name 30 point 150 20 f p name Summit point3 151 20 31", "150 20 30; 151 20 31; ", 0 },
        { "f line3 100 0 10 200 0 10 f line3 100 50 20 200 50 20 f a elev 7 point3 150 20 12", "150 20 12; ", 0 },
        { "f line3 100 0 10 200 0 10 f line3 100 50 20 200 50 20 f a elev 7 point 150 20", "", 1 },
        { "f a min 0 a max 10 ring 0 0 5 0 5 9 0 9 f a min 10 a max 20 ring 5 0 9 0 9 9 5 9 f a min 20 a max 30 ring 9 0 12 0 12 9 9 9"
          " f a min 3 a max 4 point 1 1 f point3 7 4 13", "7 4 13; ", 1 },
        { TWO("a elev_ft 10", "a elev_ft 20") " f a elev_ft 100 point 150 20 f point3 151 20 100", "150 20 30.48; 151 20 100; ", 0 },
        { TWO("a depth 5", "a depth 1") " f a depth 3 point 150 20 f point3 151 20 3", "150 20 -3; 151 20 3; ", 0 },
        { "unit ft " TWO("a elev_m 3.048", "a elev_m 6.096") " f a elev_m 9.144 point -0 20 f point3 151 20 3", "0 20 30; 151 20 3; ", 0 },
    };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_string_equal(spots(read_map(c[k].text, NULL)), c[k].spots);
        assert_points_skipped(c[k].n_skipped, "a point by itself is no isoline");
        assert_int_equal(report.n_skipped, c[k].n_skipped);
    }
    read_map(c[0].text, NULL);
    assert_noted("spot heights: 3");
    assert_string_equal(run((const char *const[]){ TWO("a elev 10", "a elev 20"), "f a elev 5 point 1 1 f a elev 6 point 0 1", NULL },
                            &defaults),
                        "unit m\nstack \"\"\nkind terrain\nspot 0 1 6\nspot 1 1 5\nslice 10\nline\n100 0\n200 0\n"
                        "slice 20\nline\n100 50\n200 50\n");
}

/* Whatever they say themselves. */
static void points_do_not_choose_where_heights_stand(void **state)
{
    (void)state;
    static const char *const points[] = {
        "f a elev 5 point 1 1 f a elev 6 point 1 2 f a elev 7 point 1 3 f a elev 8 point 1 4 ",
        "f point3 1 1 5 point3 1 2 6 point3 1 3 7 ",
        "f a height_ft 5 a z 9 a contour '7 ft' point3 1 1 4 f a height_ft 6 a z 10 point3 1 2 3 ",
    };
    static const char *const lines[] = { TWO("a level 1", "a level 2"), TWO("p name 1", "p name 2"), TWO("a height 1", "a height 2"),
        "f line3 100 0 1 200 0 1 f line3 100 50 2 200 50 2" };
    for (size_t k = 0; k < sizeof points / sizeof *points; k++) {
        for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
            char text[500];
            snprintf(text, sizeof text, "%s%s", points[k], lines[i]);
            assert_string_equal(heights(read_map(text, NULL)), " 1 2");
        }
        assert_contains(read_map(points[k], NULL), "has no lines and no polygons");
    }
    assert_contains(read_map("f a elev 5 point 1 1 f a elev 6 point 2 1 " TWO("", ""), NULL), "has no heights");
    assert_contains(read_map("f point3 1 1 5 point3 2 1 6 " TWO("", ""), NULL), "has no heights");
}

static void points_do_not_say_what_coordinates_are(void **state)
{
    (void)state;
    /* lines that look like degrees, a point that does not, and the other way round */
    read_map("f a elev 100 line 8 50 9 50 f a elev 200 line 8 50.5 9 50.5 f a elev 150 point 431000 5561000", NULL);
    assert_noted("numbers and relief are those of degrees");
    assert_points_skipped(1, "is no longitude and latitude");
    assert_contains(read_map("f a elev 100 line 8000 50 9000 50 f a elev 200 line 8000 90 9000 90 f a elev 150 point 8 50", NULL),
                    "spot 8 50 150\n");
}

static void spot_heights_follow_the_projection(void **state)
{
    (void)state;
    static const char lines[] = "crs EPSG:4326 f a elev 10 line 8 50 8.01 50 f a elev 20 line 8 50.01 8.01 50.01 ";
    char text[300], x[40], y[40];
    /* a spot on a vertex goes where that goes */
    snprintf(text, sizeof text, "%s f a elev 12 point 8.01 50", lines);
    read_map(text, NULL);
    assert_int_equal(sscanf(spots(output), "%39s %39s", x, y), 2);
    snprintf(text, sizeof text, "%s %s\n", x, y);
    assert_contains(strstr(output, "slice 10"), text);
    snprintf(text, sizeof text, "%s f a elev 12 point 8.01 50", lines);
    il_read_options o = defaults;
    o.map.project = IL_PROJECT_NONE;
    assert_contains(read_map(text, &o), "unit deg\n");
    assert_string_equal(spots(output), "8.01 50 12; ");
    snprintf(text, sizeof text, "%s f a elev 12 point 368.01 50 f a elev 13 point -351 50", lines);
    assert_string_equal(spots(read_map(text, &o)), "9 50 13; "); /* 368.01 is beyond what degrees run to */
    assert_points_skipped(1, "is no longitude and latitude");
    snprintf(text, sizeof text, "%s f a elev 12 point 50 50 f a elev 13 point 8 95 f a elev 14 point 9 50", lines);
    read_map(text, NULL);
    assert_points_skipped(1, "lies too far from the lines for their projection");
    assert_points_skipped(1, "is no longitude and latitude");
    assert_noted("spot heights: 1");
}

static void spot_heights_join_the_run_of_longitudes(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.map.project = IL_PROJECT_NONE;
    read_map("degrees f a elev 10 line 179 50 -179 50 f a elev 20 line 179 51 -179 51 f a elev 30 point -179.5 50.5 point 179.5 50.5", &o);
    const char *beyond = strstr(output, "181 50") ? "179.5 50.5 30; 180.5 50.5 30; " : "-180.5 50.5 30; -179.5 50.5 30; ";
    assert_string_equal(spots(output), beyond);
}

static void points_at_one_place_must_agree(void **state)
{
    (void)state;
    const char *const files[] = { "f a elev 12 point 5 5 f a elev 13 point 6 6 f a elev 14 point 7 7 " TWO("a elev 10", "a elev 20"),
                                  "f a elev 12 point 5 5 f a elev 13.5 point 6 6 f a elev 13 point 6 6", NULL };
    assert_string_equal(spots(run(files, &defaults)), "5 5 12; 7 7 14; ");
    assert_points_skipped(3, "others at its place have another height");
    assert_string_equal(report.skip[0].file, "map");
    assert_noted("with the same height, count once: 1");
    assert_string_equal(spots(read_map(TWO("a elev 10", "a elev 20") " f a elev 12 point 0 5 point -0 5", NULL)), "0 5 12; ");
}

static void too_many_points_are_refused_as_others(void **state)
{
    (void)state;
    il_read_options o = defaults;
    o.max_points = 6;
    read_map(TWO("a elev 10", "a elev 20") " f a elev 12 point 5 5 point 6 5", &o);
    assert_contains(output, "spot 5 5 12");
    assert_contains(read_map(TWO("a elev 10", "a elev 20") " f a elev 12 point 5 5 point 6 5 point 7 5", &o), "more than 6 points");
    o = defaults;
    o.map.has_z_unit = true;
    o.map.z_unit = IL_UNIT_KM;
    assert_contains(read_map("unit um " TWO("a elev 1", "a elev 2") " f a elev 1000000 point 5 5", &o), "a height reaches 1e15");
    assert_contains(read_map(TWO("a elev 10", "a elev 20") " f a elev 12 point 1e15 5", NULL), "a coordinate is not below 1e15");
}

/* ---- long edges ------------------------------------------------------------------- */

static void long_edges_get_vertices_of_their_own(void **state)
{
    (void)state;
    il_read_options o = defaults;
    const char *text = "crs EPSG:4326 f a elev 100 line 8 50 10 50 f a elev 200 line 10 50 8 50";
    o.flatness = 1;
    read_map(text, &o);
    assert_contains(output, "inserted 1 2 3 4");
    assert_noted("none strays farther than 1 m");
    /* the same vertices whichever way the edge runs */
    char first[3000], second[3000], *p = strstr(output, "slice 100\nline\n"), *q = strstr(output, "slice 200\nline\n");
    snprintf(first, sizeof first, "%.*s", (int)(strstr(p, "inserted") - p - 15), p + 15);
    snprintf(second, sizeof second, "%.*s", (int)(strstr(q, "inserted") - q - 15), q + 15);
    for (char *line = strtok(first, "\n"); line; line = strtok(NULL, "\n"))
        assert_contains(second, line);
    o.flatness = 1e6;
    read_map(text, &o);
    assert_null(strstr(output, "inserted"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_attribute_of_a_usual_name_is_the_height),
        cmocka_unit_test(other_names_are_no_heights),
        cmocka_unit_test(the_first_usual_name_that_tells_levels_apart_wins),
        cmocka_unit_test(z_comes_before_the_place_of_the_format),
        cmocka_unit_test(height_names_an_attribute),
        cmocka_unit_test(a_height_may_stand_behind_many_others),
        cmocka_unit_test(files_may_spell_an_attribute_differently),
        cmocka_unit_test(lines_without_a_height_are_left_out_and_counted),
        cmocka_unit_test(a_line_whose_height_varies_is_no_isoline),
        cmocka_unit_test(one_level_is_refused_unless_a_side_is_given),
        cmocka_unit_test(a_map_without_lines_is_refused),
        cmocka_unit_test(depths_count_down),
        cmocka_unit_test(feet_become_the_unit_of_the_stack),
        cmocka_unit_test(heights_that_conversion_takes_beyond_the_bound_are_refused),
        cmocka_unit_test(levels_that_only_decimals_tell_apart_are_one),
        cmocka_unit_test(degrees_are_believed_where_they_can_be),
        cmocka_unit_test(what_relief_denies_is_not_taken_for_degrees),
        cmocka_unit_test(project_none_keeps_degrees),
        cmocka_unit_test(project_asks_for_degrees),
        cmocka_unit_test(files_of_two_systems_are_no_map),
        cmocka_unit_test(a_system_that_is_denied_is_not_handed_on),
        cmocka_unit_test(edges_stray_by_a_millionth_of_the_map),
        cmocka_unit_test(files_of_two_units_are_no_map),
        cmocka_unit_test(longitudes_run_across_the_antimeridian),
        cmocka_unit_test(maps_around_a_pole_are_stereographic),
        cmocka_unit_test(bands_have_lines_between_them),
        cmocka_unit_test(the_outermost_bands_may_lack_an_end),
        cmocka_unit_test(an_island_of_a_band_is_a_ring),
        cmocka_unit_test(bands_that_are_no_neighbours_meet_in_a_cliff),
        cmocka_unit_test(an_edge_that_comes_often_is_met_two_and_two),
        cmocka_unit_test(cliffs_over_very_many_levels_are_refused),
        cmocka_unit_test(bands_without_borders_are_refused),
        cmocka_unit_test(one_height_for_each_band_is_too_little),
        cmocka_unit_test(polygons_of_one_height_lose_the_borders_between_them),
        cmocka_unit_test(ends_on_an_edge_of_another_sheet_are_taken_off),
        cmocka_unit_test(ends_beside_an_edge_stay),
        cmocka_unit_test(lines_within_edges_are_dropped),
        cmocka_unit_test(lines_know_their_file_and_feature),
        cmocka_unit_test(points_with_a_height_are_spot_heights),
        cmocka_unit_test(points_do_not_choose_where_heights_stand),
        cmocka_unit_test(points_do_not_say_what_coordinates_are),
        cmocka_unit_test(spot_heights_follow_the_projection),
        cmocka_unit_test(spot_heights_join_the_run_of_longitudes),
        cmocka_unit_test(points_at_one_place_must_agree),
        cmocka_unit_test(too_many_points_are_refused_as_others),
        cmocka_unit_test(long_edges_get_vertices_of_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
