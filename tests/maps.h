/* maps.h - a map read from memory, and what is told of it. */
#ifndef IL_TESTS_MAPS_H
#define IL_TESTS_MAPS_H

#include "base/alloc.h"
#include "input/reader.h"
#include "test.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAP_LINES = 200 };

/* line[n]: all lines, owned; z[n]: their heights. */
typedef struct map {
    il_sink sink;
    il_ring line[MAP_LINES];
    double z[MAP_LINES];
    size_t n;
    il_unit unit;
    char crs[400];
    il_report report;
    il_error err;
} map;

static inline il_status map_on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)err;
    ((map *)self)->unit = head->unit;
    snprintf(((map *)self)->crs, sizeof ((map *)self)->crs, "%s", head->crs ? head->crs : "");
    return IL_OK;
}

static inline il_status map_on_slice(il_sink *self, il_slice *s, il_error *err)
{
    map *m = (map *)self;
    for (size_t i = 0; i < s->n; i++) {
        assert_true(m->n < MAP_LINES);
        il_ring *to = &m->line[m->n];
        *to = (il_ring){ .open = s->ring[i].open, .line = s->ring[i].line, .feature = s->ring[i].feature };
        for (size_t k = 0; k < s->ring[i].n; k++)
            if (!il_ring_add(to, s->ring[i].xy[2 * k], s->ring[i].xy[2 * k + 1], 0))
                return il_fail_nomem(err);
        m->z[m->n++] = s->z;
    }
    return IL_OK;
}

static inline il_status map_on_end(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

static inline void map_free(map *m)
{
    for (size_t i = 0; i < m->n; i++) {
        il_free(m->line[i].xy);
        il_free(m->line[i].mark);
    }
    il_report_free(&m->report);
    *m = (map){ .n = 0 };
}

/* Read N bytes at DATA, called NAME, into M, which is emptied before. */
static inline il_status map_read(map *m, const il_reader *reader, const void *data, size_t n, const char *name,
                                 const il_read_options *o)
{
    const il_read_options defaults = IL_READ_OPTIONS_INIT;
    il_source *source = NULL;
    map_free(m);
    m->sink = (il_sink){ map_on_stack, map_on_slice, NULL, map_on_end, map_on_end };
    il_status st = il_source_from_memory(&source, data, n, name, &m->err);
    if (st == IL_OK)
        st = reader->read(&source, 1, o ? o : &defaults, &m->sink, &m->report, &m->err);
    il_source_close(source);
    return st;
}

static inline void assert_noted(const map *m, const char *words)
{
    for (size_t k = 0; k < m->report.n_notes; k++)
        if (strstr(m->report.note[k], words))
            return;
    for (size_t k = 0; k < m->report.n_notes; k++)
        print_error("note: %s\n", m->report.note[k]);
    fail_msg("nothing is said of '%s'", words);
}

static inline void assert_not_noted(const map *m, const char *words)
{
    for (size_t k = 0; k < m->report.n_notes; k++)
        if (strstr(m->report.note[k], words))
            fail_msg("it is said: %s", m->report.note[k]);
}

/* COUNT times WHAT was left out since it WHY, first in LINE. */
static inline void assert_skipped(const map *m, size_t count, const char *what, const char *why, long line)
{
    for (size_t k = 0; k < m->report.n_skips; k++) {
        const il_skip *s = &m->report.skip[k];
        if (strcmp(s->what, what) == 0 && strcmp(s->why, why) == 0) {
            assert_int_equal(s->count, count);
            assert_int_equal(s->line, line);
            return;
        }
    }
    for (size_t k = 0; k < m->report.n_skips; k++)
        print_error("%ld: %s %s\n", m->report.skip[k].line, m->report.skip[k].what, m->report.skip[k].why);
    fail_msg("no %s was left out: %s", what, why);
}

#endif
