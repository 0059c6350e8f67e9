/* t-api.c - isoloft.h as other programs use it. */
#include "config.h"
#include "isoloft.h"
#include "base/alloc.h"
#include "files.h"

#include <math.h>
#include <pthread.h>

/* A box with a shaft through it: two slices with a hole, direction as it comes. */
static const double outer[] = { 0, 0, 9, 0, 9, 9, 0, 9 }, shaft[] = { 3, 3, 6, 3, 6, 6, 3, 6 };
static const il_contour box[] = { { 5, outer, 4, 0 }, { 0, shaft, 4, 0 }, { 0, outer, 4, 0 }, { 5, shaft, 4, 0 } };
static const char box_text[] = "isoloft 1\nunit mm\nstack \"\"\nslice 0\nring\n0 0\n9 0\n9 9\n0 9\n"
                               "ring\n3 3\n6 3\n6 6\n3 6\nslice 5\nring\n0 0\n9 0\n9 9\n0 9\n"
                               "ring\n3 3\n6 3\n6 6\n3 6\nend\n";

static il_from from_box(void)
{
    return (il_from){ .contour = box, .n_contours = 4 };
}

static il_from from_text(const char *text)
{
    return (il_from){ .data = text, .size = strlen(text) };
}

static void arrays_become_a_closed_mesh(void **state)
{
    (void)state;
    il_from from = from_box();
    il_solids s = IL_SOLIDS_INIT;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, &err), IL_OK);
    assert_int_equal(s.n, 1);
    const il_solid *b = &s.solid[0];
    assert_int_equal(b->genus, 1);
    assert_int_equal(b->components, 1);
    assert_true(fabs(b->volume - 72 * 5) < 1e-9);
    assert_true(fabs(b->area - (2 * 72 + 5 * (36 + 12))) < 1e-9);
    size_t original = 0;
    double volume = 0;
    for (size_t i = 0; i < b->n_vertices; i++)
        original += b->contour_vertex[i];
    for (size_t i = 0; i < b->n_triangles; i++) {
        const double *p = b->xyz + 3 * b->triangle[3 * i], *q = b->xyz + 3 * b->triangle[3 * i + 1],
                     *r = b->xyz + 3 * b->triangle[3 * i + 2];
        volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                   p[2] * (q[0] * r[1] - q[1] * r[0])) / 6;
    }
    assert_int_equal(original, 16);
    assert_true(fabs(volume - 360) < 1e-9);
    il_solids_free(&s);
    il_solids_free(&s);
    assert_null(s.solid);
}

static void arrays_and_text_give_the_same_bytes(void **state)
{
    (void)state;
    static const char *const formats[] = { "stl", "stl-ascii", "obj", "ply-ascii" };
    for (size_t k = 0; k < sizeof formats / sizeof *formats; k++) {
        il_blob a = IL_BLOB_INIT, b = IL_BLOB_INIT;
        il_from arrays = from_box(), text = from_text(box_text);
        assert_int_equal(il_loft(&arrays, &(il_to){ .bytes = &a, .format = formats[k] }, NULL, NULL), IL_OK);
        assert_int_equal(il_loft(&text, &(il_to){ .bytes = &b, .format = formats[k] }, NULL, NULL), IL_OK);
        assert_true(a.size > 100);
        assert_int_equal(a.size, b.size);
        assert_memory_equal(a.data, b.data, a.size);
        il_blob_free(&a);
        il_blob_free(&b);
        il_blob_free(&b);
    }
}

static void stack_numbers_part_solids(void **state)
{
    (void)state;
    il_contour c[8];
    memcpy(c, box, sizeof box);
    memcpy(c + 4, box, sizeof box);
    for (int i = 0; i < 8; i++)
        c[i].stack = i < 4 ? 7 : -2;
    il_from from = { .contour = c, .n_contours = 8 };
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, NULL), IL_OK);
    assert_int_equal(s.n, 2);
    assert_true(fabs(s.solid[0].volume - 360) < 1e-9);
    assert_true(fabs(s.solid[1].volume - 360) < 1e-9);
    il_solids_free(&s);
}

/* Two squares, the upper shifted: with matching a slanted prism of their eight
 * vertices, without it what they do not share needs more. */
static void slices_are_matched_unless_told_otherwise(void **state)
{
    (void)state;
    static const char text[] = "isoloft 1\nunit mm\nstack \"a\"\nslice 0\nring\n0 0\n10 0\n10 10\n0 10\n"
                               "slice 2\nring\n6 0\n16 0\n16 10\n6 10\nend\n";
    il_from from = { .data = text, .size = sizeof text - 1 };
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, NULL), IL_OK);
    assert_int_equal(s.solid[0].n_vertices, 8);
    il_solids_free(&s);
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .unmatched = 1 }, NULL), IL_OK);
    assert_true(s.solid[0].n_vertices > 8);
    il_solids_free(&s);
}

static void gaps_and_single_slices_are_treated_as_is_wanted(void **state)
{
    (void)state;
    static const double square[] = { 0, 0, 2, 0, 2, 2, 0, 2 };
    static const il_contour c[] = { { 0, square, 4, 1 },  { 1, square, 4, 1 },  { 20, square, 4, 1 },
                                    { 40, square, 4, 1 }, { 41, square, 4, 1 }, { 42, square, 4, 1 } };
    static const struct { il_gap_mode gaps; double thickness; il_status st; long components; double volume; } cases[] = {
        { IL_GAPS_AS_GIVEN, 0, IL_OK, 1, 4 * 42 }, { IL_GAPS_BRIDGE, 7, IL_OK, 1, 4 * 42 }, { IL_GAPS_CAP, 0, IL_OK, 3, 4 * 4 },
        { IL_GAPS_CAP, 5, IL_OK, 3, 4 * 8 }, { IL_GAPS_FAIL, 0, IL_E_INPUT, 0, 0 }, { (il_gap_mode)7, 0, IL_E_USAGE, 0, 0 },
        { IL_GAPS_CAP, -1, IL_E_USAGE, 0, 0 } };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        il_from from = { .contour = c, .n_contours = 6 };
        il_settings settings = { .gaps = cases[k].gaps, .thickness = cases[k].thickness };
        il_solids s = IL_SOLIDS_INIT;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &settings, &err), cases[k].st);
        if (cases[k].st == IL_OK) {
            assert_int_equal(s.solid[0].components, cases[k].components);
            assert_true(fabs(s.solid[0].volume - cases[k].volume) < 1e-9);
        }
        il_solids_free(&s);
    }
    il_from one = { .contour = c, .n_contours = 1 };
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&one, &(il_to){ .solids = &s }, &(il_settings){ .thickness = 3 }, NULL), IL_OK);
    assert_true(fabs(s.solid[0].volume - 12) < 1e-9);
    il_solids_free(&s);
}

static void a_dome_adds_to_the_volume(void **state)
{
    (void)state;
    il_from from = from_box();
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .dome = 1, .threads = 3 }, NULL), IL_OK);
    assert_true(s.solid[0].volume > 361);
    il_solids_free(&s);
}

static void contours_between_are_as_many_as_asked(void **state)
{
    (void)state;
    il_from from = from_box();
    il_solids s = IL_SOLIDS_INIT;
    size_t straight = 0;
    for (int between = -1; between < 3; between += 3) {
        assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .between = between }, NULL), IL_OK);
        straight = between < 0 ? s.solid[0].n_vertices : straight;
        assert_true(between < 0 || s.solid[0].n_vertices > straight);
        il_solids_free(&s);
    }
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .between = 65 }, NULL), IL_E_USAGE);
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .between = -2 }, NULL), IL_E_USAGE);
}

static void a_file_appears_whole_or_not_at_all(void **state)
{
    char path[FILES_PATH_MAX], text[32];
    files_path(path, state, "box.ply");
    il_from good = from_box(), bad = from_text("isoloft 1\nunit mm\nstack \"\"\nslice 0\nring\n0 0\n9 x\n");
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_loft(&bad, &(il_to){ .path = path }, NULL, &err), IL_E_INPUT);
    assert_int_equal(err.line, 7);
    assert_null(fopen(path, "r"));
    assert_int_equal(il_loft(&good, &(il_to){ .path = path }, NULL, &err), IL_OK);
    assert_int_equal(err.code, IL_OK);
    assert_int_equal(il_loft(&bad, &(il_to){ .path = path }, NULL, &err), IL_E_INPUT);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    assert_non_null(fgets(text, sizeof text, f));
    assert_string_equal(text, "ply\n");
    fclose(f);
}

static void a_call_that_makes_no_sense_is_refused(void **state)
{
    (void)state;
    il_solids s = IL_SOLIDS_INIT;
    il_blob b = IL_BLOB_INIT, full = { &b, 1 };
    il_from good = from_box(), both = good, none = { 0 }, text = from_text(box_text);
    both.data = "x", both.size = 1;
    struct { il_from from; il_to to; } c[] = {
        { none, { .solids = &s } }, { both, { .solids = &s } }, { good, { 0 } }, { good, { .solids = &s, .bytes = &b } },
        { good, { .bytes = &full } }, { good, { .bytes = &b, .format = "bmp" } }, { good, { .bytes = &b, .format = "loft" } },
        { good, { .solids = &s, .format = "stl" } }, { text, { .bytes = &b } }, { text, { .bytes = &b } },
        { text, { .bytes = &b } }, { { .path = (const char *const[]){ "x" } }, { .bytes = &b } } };
    c[8].from.format = "bmp", c[9].from.unit = "furlong", c[10].from.spacing = NAN;
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_loft(&c[k].from, &c[k].to, NULL, &err), IL_E_USAGE);
        assert_int_equal(err.code, IL_E_USAGE);
        assert_true(strlen(err.text) > 10);
    }
    assert_null(s.solid);
    assert_null(b.data);
    assert_ptr_equal(full.data, &b);
}

static void numbers_that_are_none_are_refused(void **state)
{
    (void)state;
    double bad[] = { NAN, INFINITY, -INFINITY, 1e15, -1e300 };
    for (size_t k = 0; k < 2 * sizeof bad / sizeof *bad; k++) {
        double xy[8];
        il_contour c[4];
        il_solids s = IL_SOLIDS_INIT;
        il_error err = IL_ERROR_INIT;
        memcpy(xy, outer, sizeof xy);
        memcpy(c, box, sizeof c);
        c[2].xy = xy;
        if (k % 2)
            xy[5] = bad[k / 2];
        else
            c[2].z = bad[k / 2];
        il_from from = { .contour = c, .n_contours = 4 };
        assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, &err), IL_E_INPUT);
        assert_non_null(strstr(err.text, "contour 2"));
        assert_null(s.solid);
    }
}

static void nothing_in_gives_nothing_out(void **state)
{
    (void)state;
    il_from none = { .contour = box, .n_contours = 0 }, flat = { .contour = box + 1, .n_contours = 2 };
    il_from no_file = { .path = (const char *const[]){ "/nowhere/at/all" }, .n_paths = 1 };
    il_blob b = IL_BLOB_INIT;
    assert_int_equal(il_loft(&none, &(il_to){ .bytes = &b }, NULL, NULL), IL_E_INPUT);
    assert_int_equal(il_loft(&flat, &(il_to){ .bytes = &b }, NULL, NULL), IL_E_INPUT);
    assert_int_equal(il_loft(&no_file, &(il_to){ .bytes = &b }, NULL, NULL), IL_E_IO);
    assert_null(b.data);
}

/* Two ROIs of a structure set: one without contours, and one in planes across y. */
static const char set_text[] =
    "(3006,0020) SQ (Sequence with explicit length #=2) # 0, 1 StructureSetROISequence\n"
    "(fffe,e000) na (Item) # 0, 1 Item\n(3006,0022) IS [1] # 2, 1 ROINumber\n"
    "(3006,0026) LO [empty] # 6, 1 ROIName\n(fffe,e00d) na (Item) # 0, 0 Item\n"
    "(fffe,e000) na (Item) # 0, 1 Item\n(3006,0022) IS [2] # 2, 1 ROINumber\n"
    "(3006,0026) LO [box] # 4, 1 ROIName\n(fffe,e00d) na (Item) # 0, 0 Item\n"
    "(fffe,e0dd) na (End) # 0, 0 End\n"
    "(3006,0039) SQ (Sequence with explicit length #=1) # 0, 1 ROIContourSequence\n"
    "(fffe,e000) na (Item) # 0, 1 Item\n"
    "(3006,0040) SQ (Sequence with explicit length #=2) # 0, 1 ContourSequence\n"
    "(fffe,e000) na (Item) # 0, 1 Item\n(3006,0042) CS [CLOSED_PLANAR] # 14, 1 ContourGeometricType\n"
    "(3006,0050) DS [0\\5\\0\\4\\5\\0\\4\\5\\3\\0\\5\\3] # 24,12 ContourData\n(fffe,e00d) na (Item) # 0, 0 Item\n"
    "(fffe,e000) na (Item) # 0, 1 Item\n(3006,0042) CS [CLOSED_PLANAR] # 14, 1 ContourGeometricType\n"
    "(3006,0050) DS [0\\7\\0\\4\\7\\0\\4\\7\\3\\0\\7\\3] # 24,12 ContourData\n(fffe,e00d) na (Item) # 0, 0 Item\n"
    "(fffe,e0dd) na (End) # 0, 0 End\n(3006,0084) IS [2] # 2, 1 ReferencedROINumber\n"
    "(fffe,e00d) na (Item) # 0, 0 Item\n(fffe,e0dd) na (End) # 0, 0 End\n";

static void structure_sets_come_in_the_patients_coordinates(void **state)
{
    (void)state;
    il_from from = from_text(set_text);
    il_solids s = IL_SOLIDS_INIT;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, &err), IL_OK);
    assert_int_equal(s.n, 1);
    assert_string_equal(s.solid[0].name, "box");
    assert_true(fabs(s.solid[0].volume - 24) < 1e-9);
    double most[3] = { 0, 0, 0 };
    for (size_t i = 0; i < s.solid[0].n_vertices; i++)
        for (size_t k = 0; k < 3; k++)
            most[k] = fmax(most[k], s.solid[0].xyz[3 * i + k]);
    assert_true(most[0] == 4 && most[1] == 7 && most[2] == 3);
    il_solids_free(&s);
}

/* A hill of three levels, squares on their corners. */
static const char hill[] =
    "isoloft 1\nunit m\nstack \"hill\"\nkind terrain\nslice 10\nring\n1000 30\n1030 0\n1060 30\n1030 60\n"
    "slice 20\nring\n1010 30\n1030 10\n1050 30\n1030 50\nslice 30\nring\n1020 30\n1030 20\n1040 30\n1030 40\nend\n";

static void terrain_is_an_open_surface(void **state)
{
    (void)state;
    il_from from = from_text(hill);
    il_solids s = IL_SOLIDS_INIT;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, NULL, &err), IL_OK);
    assert_int_equal(s.n, 1);
    const il_solid *h = &s.solid[0];
    assert_true(h->is_open && h->components == 1 && h->volume == 0 && h->area > 3600);
    for (int k = 0; k < 3; k++)
        assert_true(h->offset[k] == 0 && h->scale[k] == 1);
    size_t corners = 0;
    for (size_t i = 0; i < h->n_vertices; i++)
        corners += h->contour_vertex[i] && h->xyz[3 * i] == 1020 && h->xyz[3 * i + 1] == 30 && h->xyz[3 * i + 2] == 30;
    assert_int_equal(corners, 1);
    il_solids_free(&s);
}

static void terrain_becomes_a_solid_of_the_size_asked_for(void **state)
{
    (void)state;
    il_from from = from_text(hill);
    il_solids s = IL_SOLIDS_INIT;
    il_error err = IL_ERROR_INIT;
    const il_settings settings = { .map = { .solid = 1, .has_base = 1, .base = -5, .recentre = 1, .fit = 120, .z_scale = 2 } };
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &settings, &err), IL_OK);
    const il_solid *h = &s.solid[0];
    assert_true(!h->is_open && h->genus == 0 && h->volume > 120 * 120 * 20);
    assert_true(h->offset[0] == 1030 && h->offset[1] == 30 && h->offset[2] == -5 && h->scale[0] == 0.5 && h->scale[2] == 0.25);
    double low = 1e9, left = 1e9, right = -1e9;
    for (size_t i = 0; i < h->n_vertices; i++) {
        low = fmin(low, h->xyz[3 * i + 2]);
        left = fmin(left, h->xyz[3 * i]);
        right = fmax(right, h->xyz[3 * i]);
    }
    assert_true(low == 0 && left == -60 && right == 60);
    il_solids_free(&s);
    const il_settings bad[] = { { .map = { .fit = -1 } }, { .map = { .z_scale = NAN } }, { .map = { .base = INFINITY } },
                                { .map = { .law = (il_ground_law)3 } }, { .map = { .spread = -1 } },
                                { .map = { .detail = NAN } }, { .map = { .detail = 1.5 } } };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &bad[k], &err), IL_E_USAGE);
}

static void stl_of_terrain_is_recentred_unless_told_otherwise(void **state)
{
    (void)state;
    il_from from = from_text(hill);
    static const char *const header[] = { "STL isoloft offset 1030 30 0 hill", "STL isoloft hill" };
    for (int k = 0; k < 2; k++) {
        il_blob b = IL_BLOB_INIT;
        const il_settings settings = { .map = { .recentre = -k } };
        assert_int_equal(il_loft(&from, &(il_to){ .bytes = &b }, &settings, NULL), IL_OK);
        assert_string_equal((const char *)b.data, header[k]);
        il_blob_free(&b);
    }
}

static void collect(void *self, const char *sentence)
{
    char *all = self;
    strncat(all, sentence, 1000 - strlen(all));
    strncat(all, "\n", 1000 - strlen(all));
}

/* A thick pillar, and a thin one beside it that leaves it by 2.5 from slice to slice, so that its
 * rings lie 0.5 apart; slices are HEIGHT apart. */
static long pieces_of(double height, const il_settings *settings)
{
    double xy[8][8];
    il_contour c[8];
    for (int k = 0; k < 4; k++)
        for (int thin = 0; thin < 2; thin++) {
            double x = thin ? 20.5 + 2.5 * k : 0, size = thin ? 2 : 20;
            memcpy(xy[2 * k + thin], (double[]){ x, 0, x + size, 0, x + size, size, x, size }, sizeof *xy);
            c[2 * k + thin] = (il_contour){ k * height, xy[2 * k + thin], 4, 0 };
        }
    il_from from = { .contour = c, .n_contours = 8 };
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, settings, NULL), IL_OK);
    long n = s.solid[0].components;
    il_solids_free(&s);
    return n;
}

static void rings_apart_are_linked_as_is_wanted(void **state)
{
    (void)state;
    char all[1001] = "";
    assert_int_equal(pieces_of(1, &(il_settings){ .pieces = IL_PIECES_OVERLAP }), 5);
    assert_int_equal(pieces_of(1, &(il_settings){ .unmatched = 1 }), 5);
    assert_int_equal(pieces_of(1, NULL), 3);
    assert_int_equal(pieces_of(0.25, NULL), 5);
    assert_true(pieces_of(0.25, &(il_settings){ .pieces = IL_PIECES_FEW, .note = collect, .note_self = all }) <= 2);
    assert_non_null(strstr(all, "guesses"));
    il_from from = from_box();
    il_solids s = IL_SOLIDS_INIT;
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .pieces = (il_pieces_mode)3 }, NULL), IL_E_USAGE);
}

static void repairs_are_told(void **state)
{
    (void)state;
    const double repeated[] = { 0, 0, 0, 0, 9, 0, 9, 9, 0, 9 };
    il_contour c[4];
    memcpy(c, box, sizeof c);
    c[0].xy = repeated, c[0].n = 5;
    il_from from = { .contour = c, .n_contours = 4 };
    il_solids s = IL_SOLIDS_INIT;
    char all[1001] = "";
    assert_int_equal(il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .note = collect, .note_self = all }, NULL), IL_OK);
    assert_non_null(strstr(all, "repeated"));
    il_solids_free(&s);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    il_from sources[] = { from_box(), from_text(box_text) };
    for (long fail = 0; fail < 10000; fail++) {
        il_blob b = IL_BLOB_INIT;
        il_solids s = IL_SOLIDS_INIT;
        il_to to = fail % 2 ? (il_to){ .bytes = &b, .format = "ply" } : (il_to){ .solids = &s };
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(fail / 2);
        il_status st = il_loft(&sources[fail / 2 % 2], &to, NULL, &err);
        il_alloc_test_fail_after(-1);
        il_blob_free(&b);
        il_solids_free(&s);
        if (st == IL_OK && fail % 4 == 3)
            return;
        assert_true(st == IL_OK || (st == IL_E_NOMEM && !b.data && !s.solid));
    }
    fail_msg("it never came through");
}

static void *loft_many(void *unused)
{
    (void)unused;
    double sum = 0;
    for (int i = 0; i < 20; i++) {
        il_from from = from_box();
        il_solids s = IL_SOLIDS_INIT;
        if (il_loft(&from, &(il_to){ .solids = &s }, &(il_settings){ .threads = 2 }, NULL) == IL_OK)
            sum += s.solid[0].volume;
        il_solids_free(&s);
    }
    return fabs(sum - 20 * 360) < 1e-6 ? NULL : "wrong";
}

static void calls_at_the_same_time_are_safe(void **state)
{
    (void)state;
    pthread_t thread[3];
    for (int i = 0; i < 3; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, loft_many, NULL), 0);
    for (int i = 0; i < 3; i++) {
        void *wrong;
        pthread_join(thread[i], &wrong);
        assert_null(wrong);
    }
}

static void the_version_is_the_programs(void **state)
{
    (void)state;
    assert_string_equal(il_version(), PACKAGE_VERSION);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_become_a_closed_mesh),
        cmocka_unit_test(arrays_and_text_give_the_same_bytes),
        cmocka_unit_test(stack_numbers_part_solids),
        cmocka_unit_test(slices_are_matched_unless_told_otherwise),
        cmocka_unit_test(rings_apart_are_linked_as_is_wanted),
        cmocka_unit_test(gaps_and_single_slices_are_treated_as_is_wanted),
        cmocka_unit_test(a_dome_adds_to_the_volume),
        cmocka_unit_test(contours_between_are_as_many_as_asked),
        cmocka_unit_test(a_file_appears_whole_or_not_at_all),
        cmocka_unit_test(a_call_that_makes_no_sense_is_refused),
        cmocka_unit_test(numbers_that_are_none_are_refused),
        cmocka_unit_test(nothing_in_gives_nothing_out),
        cmocka_unit_test(structure_sets_come_in_the_patients_coordinates),
        cmocka_unit_test(terrain_is_an_open_surface),
        cmocka_unit_test(terrain_becomes_a_solid_of_the_size_asked_for),
        cmocka_unit_test(stl_of_terrain_is_recentred_unless_told_otherwise),
        cmocka_unit_test(repairs_are_told),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(calls_at_the_same_time_are_safe),
        cmocka_unit_test(the_version_is_the_programs),
    };
    return cmocka_run_group_tests(tests, files_setup, files_teardown);
}
