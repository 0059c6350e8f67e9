#include "config.h"
#include "cli/options.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/* Parse WORDS, separated by blanks; a copy of them stays in BUF. */
static il_status parse(il_options *o, const char *words, char *buf, size_t size, il_error *err)
{
    static char program[] = "isoloft";
    char *argv[64] = { program };
    int argc = 1;
    snprintf(buf, size, "%s", words);
    for (char *w = strtok(buf, " "); w; w = strtok(NULL, " ")) {
        assert_true((size_t)argc < sizeof argv / sizeof *argv);
        argv[argc++] = w;
    }
    il_options_init(o);
    *err = (il_error)IL_ERROR_INIT;
    return il_options_parse(o, argc, argv, err);
}

#define PARSE(o, words) parse(&(o), words, buf, sizeof buf, &err)

static void operands_and_options_stand_in_any_order(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    static const char *const lines[] = { "mesh a.loft -t ply -o out", "-t ply mesh -o out a.loft",
                                         "-tply -oout mesh a.loft", "--output=out mesh --output-format ply -- a.loft" };
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        assert_int_equal(PARSE(o, lines[k]), IL_OK);
        assert_int_equal(o.verb, IL_VERB_MESH);
        assert_int_equal(o.n_inputs, 1);
        assert_string_equal(o.input[0], "a.loft");
        assert_string_equal(o.output, "out");
        assert_ptr_equal(o.to, &il_writer_ply);
        il_options_free(&o);
    }
}

static void the_first_operand_alone_can_be_a_verb(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    assert_int_equal(PARSE(o, "x.svg read"), IL_OK);
    assert_int_equal(o.verb, IL_VERB_CONVERT);
    assert_int_equal(o.n_inputs, 2);
    il_options_free(&o);
    assert_int_equal(PARSE(o, "./read"), IL_OK);
    assert_int_equal(o.verb, IL_VERB_CONVERT);
    assert_int_equal(o.n_inputs, 1);
    il_options_free(&o);
    assert_int_equal(PARSE(o, "read read"), IL_OK);
    assert_int_equal(o.verb, IL_VERB_READ);
    assert_string_equal(o.input[0], "read");
    il_options_free(&o);
}

static void between_is_a_number_or_auto(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    static const struct { const char *line; int between; } c[] = {
        { "x", IL_BETWEEN_AUTO }, { "--between 4 x", 4 }, { "--between=64 x", 64 }, { "--between 0 x", 0 },
        { "--no-between x", 0 }, { "--between 3 --between auto x", IL_BETWEEN_AUTO } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_int_equal(PARSE(o, c[k].line), IL_OK);
        assert_int_equal(o.between, c[k].between);
        il_options_free(&o);
    }
    static const char *const wrong[] = { "--between", "--between 65 x", "--between -1 x", "--between 1.5 x", "--between= x",
                                         "match --between 1" };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        assert_int_equal(PARSE(o, wrong[k]), IL_E_USAGE);
        il_options_free(&o);
    }
}

static void keyhole_has_a_value_and_can_be_taken_back(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    static const struct { const char *line; double keyhole; bool given; } c[] = {
        { "x", 0, false }, { "--keyhole 0.25 x", 0.25, true }, { "--keyhole=0 x", 0, true },
        { "--keyhole 1 --no-keyhole x", 0, true }, { "--no-keyhole --keyhole 2 x", 2, true } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_int_equal(PARSE(o, c[k].line), IL_OK);
        assert_true(o.keyhole == c[k].keyhole);
        assert_int_equal(o.has_keyhole, c[k].given);
        assert_int_equal(o.n_inputs, 1);
        il_options_free(&o);
    }
    assert_int_equal(PARSE(o, "--keyhole"), IL_E_USAGE);
    il_options_free(&o);
    assert_int_equal(PARSE(o, "--no-keyhole=1 x"), IL_E_USAGE);
    il_options_free(&o);
}

static void every_switch_can_be_taken_back(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    assert_int_equal(PARSE(o, "-qv --strict --json --no-flip --progress x"), IL_OK);
    assert_true(o.quiet && o.verbose && o.strict && o.json && o.read.no_flip && o.progress == IL_WHEN_ALWAYS);
    il_options_free(&o);
    assert_int_equal(PARSE(o, "-qv --strict --json=f --no-flip --no-quiet --no-verbose --no-strict --no-json "
                              "--flip --no-progress x"), IL_OK);
    assert_false(o.quiet || o.verbose || o.strict || o.json || o.json_path || o.read.no_flip);
    assert_int_equal(o.progress, IL_WHEN_NEVER);
    il_options_free(&o);
    for (const il_option *p = il_option_table; p->name; p++) {
        if (p->kind != IL_OPTION_SWITCH)
            continue;
        char line[80];
        snprintf(line, sizeof line, "%s --no-%s x", p->verbs & 1 << IL_VERB_CONVERT ? "convert" : "plot", p->name);
        assert_int_equal(PARSE(o, line), IL_OK);
        il_options_free(&o);
    }
}

static void the_format_follows_the_name_unless_t_gives_it(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    const struct { const char *line; const il_writer *to; } c[] = {
        { "x", &il_writer_stl }, { "x -o y.ply", &il_writer_ply }, { "x -o y.obj", &il_writer_obj },
        { "x -o y.stl", &il_writer_stl }, { "x -o y.obj -t ply-ascii", &il_writer_ply_ascii },
        { "x -o y.zip -t obj", &il_writer_obj }, { "x -o y", &il_writer_stl }, { "x -o d.x/y", &il_writer_stl },
        { "x -o no-such.ply/", &il_writer_stl }, { "x -o y.loft", &il_writer_loft }, { "read x", &il_writer_loft },
        { "match -o y.loft", &il_writer_loft } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_int_equal(PARSE(o, c[k].line), IL_OK);
        assert_ptr_equal(o.to, c[k].to);
        il_options_free(&o);
    }
}

static void what_makes_no_sense_is_a_usage_error(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    static const char *const lines[] = {
        "x --frame", "--no-such x", "--no-output x", "-z x", "x -o", "x --threads", "x --threads 0", "x --threads 257",
        "x --threads 1x", "x --threads=-1", "x --threads 99999999999999999999", "x --spacing 0", "x --spacing -1",
        "x --spacing nan", "x --spacing 1e15", "x --spacing 1,5", "x --unit parsec", "x --to deg", "x --to",
        "x --cap none", "x --groups x", "read x --groups slab", "check --strict x", "x --matcher x",
        "x --progress=often", "x --strict=yes", "x --no-strict=yes", "x --help=x", "x -t svg", "x -f stp", "x -o y.zip",
        "x -t loft --matcher", "read x --cap dome", "check x -o y", "info x -t stl", "read x -t stl", "read x -o y.stl",
        "mesh x -t loft", "mesh x y", "match x y", "check x y", "plot x y", "plot x --cap dome",
        "plot x -o y.stl", "plot --pair", "plot --pair x", "plot --pair -1", "plot --pair 3 --slices",
        "plot --slices --pair 3", "plot --slices=3", "plot --skeleton --pair 3", "plot --slices --skeleton",
        "plot --skeleton=1", "x --skeleton", "plot --pieces few", "plot --skeleton --pieces many", "plot x -t stl",
        "read x --pair 3", "x --slices", "- -", "x -o y --pairs y",
        "x --pairs -", "x -o - --pairs -", "x -o y.stl --json=y.stl", "read x --pairs y", "match --spacing 1",
        "--output= x", "x --json=",
        "x --list -o y", "x --list --pairs y", "read x --list -o -", "match --list", "check x --list", "plot --list",
        "info x --ras", "match --ras", "mesh --ras", "x --roi", "x --no-roi", "check x --roi y",
        "x --base 3", "x --solid --base x", "x --solid --base 1e15", "x --solid --base=", "read x --solid", "match --fit 1",
        "x --fit 0", "x --fit -3", "x --fit 3deg", "x --fit mm", "x --fit 3mmm", "x --fit=", "x --fit 1e15", "x --z-scale 0",
        "x --detail -.1", "x --detail 1.5", "x --detail nan", "x --detail 5%", "x --detail=", "plot --detail 1",
        "x --law", "x --law flat", "x --spread -1", "x --spread 11", "x --spread=", "x --law plate --spread 1", "read x --law mean",
        "x --z-scale -1", "x --z-scale x", "x --z-scale 3x", "plot --solid", "check x --recentre", "match --high left" };
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        if (PARSE(o, lines[k]) != IL_E_USAGE)
            fail_msg("accepted: %s", lines[k]);
        assert_int_equal(err.code, IL_E_USAGE);
        assert_true(err.text[0] != '\0');
        il_options_free(&o);
    }
}

static void placement_of_maps_depends_on_the_format(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    static const struct { const char *line; bool recentre, round_float; } c[] = {
        { "x", true, true }, { "x -o y.ply", false, false }, { "x -o y.ply --recentre", true, false },
        { "x --no-recentre", false, true }, { "x -t stl-ascii", true, true }, { "info x", false, false } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_int_equal(PARSE(o, c[k].line), IL_OK);
        assert_true(o.relief.placement.recentre == c[k].recentre && o.relief.placement.round_float == c[k].round_float);
        assert_true(o.relief.placement.fit == 0 && o.relief.placement.z_scale == 1 && !o.relief.placement.solid);
        il_options_free(&o);
    }
    assert_int_equal(PARSE(o, "x --solid --base -12.5 --z-scale 2 --fit 6in --high right"), IL_OK);
    assert_true(o.relief.placement.solid && o.relief.placement.has_base && o.relief.placement.base == -12.5);
    assert_true(o.relief.placement.z_scale == 2 && o.relief.placement.fit == 152.4);
    assert_int_equal(o.relief.high, IL_SIDE_RIGHT);
    il_options_free(&o);
    static const struct { const char *line; bool has; double detail; } details[] = {
        { "x", false, 0 }, { "x --detail .2", true, .2 }, { "x --detail 0", true, 0 }, { "x --no-detail", true, 0 } };
    for (size_t k = 0; k < sizeof details / sizeof *details; k++) {
        assert_int_equal(PARSE(o, details[k].line), IL_OK);
        assert_true(o.relief.has_detail == details[k].has && o.relief.detail == details[k].detail);
        il_options_free(&o);
    }
    static const struct { const char *line; double fit; } fits[] = {
        { "x --fit 150", 150 }, { "x --fit 150mm", 150 }, { "x --fit=15cm", 150 }, { "x --fit .15m", 150 } };
    for (size_t k = 0; k < sizeof fits / sizeof *fits; k++) {
        assert_int_equal(PARSE(o, fits[k].line), IL_OK);
        assert_true(o.relief.placement.fit == fits[k].fit);
        il_options_free(&o);
    }
}

static void values_reach_their_place(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    assert_int_equal(PARSE(o, "x --spacing 2.5 --unit in --to m --threads 3 --cap dome --stack L* --roi !*x --max-depth 7 "
                              "--max-line 100 --max-points 12 --flatness 0.01 --matcher none --pairs p -f svg "
                              "--progress=auto --groups slab"), IL_OK);
    assert_true(o.groups_by_slab);
    assert_true(o.read.has_spacing && o.read.spacing == 2.5 && o.read.has_unit && o.read.unit == IL_UNIT_IN);
    assert_true(o.convert_unit && o.to_unit == IL_UNIT_M && o.threads == 3 && o.cap == IL_CAP_DOME);
    assert_true(o.read.max_depth == 7 && o.read.max_line == 100 && o.read.max_points == 12 && o.read.flatness == 0.01);
    assert_int_equal(o.n_patterns, 2);
    assert_string_equal(o.pattern[0], "L*");
    assert_string_equal(o.pattern[1], "!*x");
    assert_string_equal(o.pairs, "p");
    assert_ptr_equal(o.from, &il_reader_svg);
    il_options_free(&o);
}

static void a_list_needs_no_output_format(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    assert_int_equal(PARSE(o, "x --list --ras --json=y"), IL_OK);
    assert_true(o.list && o.ras && !o.to);
    il_options_free(&o);
    assert_int_equal(PARSE(o, "x --list --ras --no-list --no-ras -o y.ply"), IL_OK);
    assert_true(!o.list && !o.ras && o.to == &il_writer_ply);
    il_options_free(&o);
}

static void control_characters_of_the_line_are_not_echoed(void **state)
{
    (void)state;
    char buf[400];
    il_options o;
    il_error err;
    assert_int_equal(PARSE(o, "--\x1b[31mred x"), IL_E_USAGE);
    assert_null(strchr(err.text, '\x1b'));
    il_options_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operands_and_options_stand_in_any_order),
        cmocka_unit_test(the_first_operand_alone_can_be_a_verb),
        cmocka_unit_test(between_is_a_number_or_auto),
        cmocka_unit_test(keyhole_has_a_value_and_can_be_taken_back),
        cmocka_unit_test(every_switch_can_be_taken_back),
        cmocka_unit_test(the_format_follows_the_name_unless_t_gives_it),
        cmocka_unit_test(what_makes_no_sense_is_a_usage_error),
        cmocka_unit_test(placement_of_maps_depends_on_the_format),
        cmocka_unit_test(values_reach_their_place),
        cmocka_unit_test(a_list_needs_no_output_format),
        cmocka_unit_test(control_characters_of_the_line_are_not_echoed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
