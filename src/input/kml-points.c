#include "config.h"
#include "input/kml-points.h"
#include "base/alloc.h"
#include "base/number.h"
#include "input/xml-feed.h"

#include <math.h>
#include <string.h>

void il_kml_points_reset(il_kml_points *p)
{
    p->n_points = 0;
}

void il_kml_points_free(il_kml_points *p)
{
    il_free(p->rest);
}

void il_kml_points_begin(il_kml_points *p, bool is_coord)
{
    p->is_coord = is_coord;
    p->comma = false;
    p->n = p->n_rest = 0;
}

/* ---- points --------------------------------------------------------------------- */

/* The numbers at hand are a point. */
static il_status emit(il_kml_points *p, il_error *err)
{
    double z = p->n == 3 ? p->value[2] : NAN;
    if (p->n < 2)
        return il_fail(err, IL_E_INPUT, p->line, "a place of one number: longitude and latitude belong together");
    p->last[0] = p->value[0];
    p->last[1] = p->value[1];
    p->last[2] = z;
    if (p->n_points++ == 0)
        memcpy(p->first, p->last, sizeof p->first);
    p->n = 0;
    return il_map_point(p->set, p->value[0], p->value[1], z, p->line, err);
}

/* A number belongs to the point at hand if a comma joins it to that one. */
static il_status take_number(il_kml_points *p, double v, il_error *err)
{
    il_status st = p->n > 0 && !p->comma && !p->is_coord ? emit(p, err) : IL_OK;
    if (st != IL_OK)
        return st;
    if (p->n == 3)
        return il_fail(err, IL_E_INPUT, p->at, "a place of more than three numbers%s", p->is_coord ? "" : ": blanks belong between places");
    if (p->n == 0)
        p->line = p->at;
    p->value[p->n++] = v;
    p->comma = false;
    return IL_OK;
}

static il_status take_comma(il_kml_points *p, il_error *err)
{
    if (p->is_coord)
        return il_fail(err, IL_E_INPUT, p->at, "a comma in gx:coord, where blanks belong between numbers");
    if (p->n == 0 || p->comma)
        return il_fail(err, IL_E_INPUT, p->at, "a comma without a number before it");
    p->comma = true;
    return IL_OK;
}

/* ---- numbers that are in one piece, or two ------------------------------------------ */

static bool is_between(char c)
{
    return c == ',' || il_xml_is_blank(c);
}

static size_t word_end(const char *s, size_t n, size_t i)
{
    while (i < n && !is_between(s[i]))
        i++;
    return i;
}

static il_status fail_number(const il_kml_points *p, const char *s, size_t n, il_error *err)
{
    return il_fail(err, IL_E_INPUT, p->at, "'%.*s' is not a finite number", (int)(n < 40 ? n : 40), s);
}

static il_status keep_rest(il_kml_points *p, const char *s, size_t n, il_error *err)
{
    if (n > p->max_text || p->n_rest > p->max_text - n)
        return il_fail(err, IL_E_INPUT, p->at, "a number of more than %zu bytes", p->max_text);
    if (!il_grow(&p->rest, &p->cap_rest, p->n_rest + n, 1))
        return il_fail_nomem(err);
    memcpy(p->rest + p->n_rest, s, n);
    p->n_rest += n;
    return IL_OK;
}

/* The number in p->rest is whole. */
static il_status take_rest(il_kml_points *p, il_error *err)
{
    double v = 0;
    size_t used = il_number_parse(p->rest, p->n_rest, &v);
    il_status st = used == p->n_rest ? take_number(p, v, err) : fail_number(p, p->rest, p->n_rest, err);
    p->n_rest = 0;
    return st;
}

/* The number at S[*I..N), which may go on in the next piece. */
static il_status next_number(il_kml_points *p, const char *s, size_t n, size_t *i, il_error *err)
{
    double v = 0;
    size_t from = *i, end = from + il_number_parse(s + from, n - from, &v);
    bool is_whole = end > from && end < n && is_between(s[end]);
    *i = is_whole ? end : word_end(s, n, end);
    if (is_whole)
        return take_number(p, v, err);
    return *i == n ? keep_rest(p, s + from, n - from, err) : fail_number(p, s + from, *i - from, err);
}

/* The number that began in an earlier piece goes on at S[0..N). */
static il_status go_on(il_kml_points *p, const char *s, size_t n, size_t *i, il_error *err)
{
    *i = word_end(s, n, 0);
    il_status st = keep_rest(p, s, *i, err);
    return st == IL_OK && *i < n ? take_rest(p, err) : st;
}

il_status il_kml_points_add(il_kml_points *p, const char *s, size_t n, long line, il_error *err)
{
    size_t i = 0;
    p->at = line;
    il_status st = p->n_rest > 0 ? go_on(p, s, n, &i, err) : IL_OK;
    while (i < n && st == IL_OK) {
        char c = s[i];
        if (!is_between(c)) {
            st = next_number(p, s, n, &i, err);
        } else {
            st = c == ',' ? take_comma(p, err) : IL_OK;
            p->at += c == '\n' ? 1 : 0;
            i++;
        }
    }
    return st;
}

il_status il_kml_points_end(il_kml_points *p, long line, il_error *err)
{
    p->at = p->n_rest > 0 ? p->at : line;
    il_status st = p->n_rest > 0 ? take_rest(p, err) : IL_OK;
    if (st == IL_OK && p->comma)
        return il_fail(err, IL_E_INPUT, p->at, "a comma without a number behind it");
    if (st == IL_OK && p->is_coord && p->n == 0)
        il_map_skip(p->set, line, "gx:coord", "is empty");
    return st == IL_OK && p->n > 0 ? emit(p, err) : st;
}

il_status il_kml_points_close(il_kml_points *p, long line, il_error *err)
{
    if (p->n_points == 0 || (p->first[0] == p->last[0] && p->first[1] == p->last[1]))
        return IL_OK;
    return il_map_point(p->set, p->first[0], p->first[1], p->first[2], line, err);
}
