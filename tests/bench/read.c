/* read.c - how fast a reader alone is.
 *
 *     read FORMAT FILE
 *
 * Reads FILE from memory into a sink that counts and drops, degrees as they are; the
 * best of several runs, as megabytes of text a second and vertices a second. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"

#include <stdio.h>
#include <time.h>

typedef struct counter {
    il_sink sink;
    size_t points;
} counter;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self;
    (void)head;
    (void)err;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    (void)err;
    ((counter *)self)->points += il_slice_points(s);
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    (void)self;
    (void)p;
    (void)err;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

/* Of the processor: what else the machine does is left out. */
static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The whole file; null when it cannot be had. */
static char *load(const char *path, size_t *n)
{
    char *data = NULL;
    FILE *f = fopen(path, "rb");
    if (f && fseek(f, 0, SEEK_END) == 0) {
        long size = ftell(f);
        rewind(f);
        data = size > 0 ? il_alloc((size_t)size, 1) : NULL;
        *n = data ? fread(data, 1, (size_t)size, f) : 0;
    }
    if (f)
        fclose(f);
    return data;
}

static il_status run_once(const il_reader *r, const char *data, size_t n, counter *c, il_error *err)
{
    *c = (counter){ { on_stack, on_slice, on_pair, on_end, on_end }, 0 };
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.map.project = IL_PROJECT_NONE;
    il_report report = IL_REPORT_INIT;
    il_source *s = NULL;
    il_status st = il_source_from_memory(&s, data, n, "bench", err);
    if (st == IL_OK)
        st = r->read(&s, 1, &o, &c->sink, &report, err);
    il_source_close(s);
    il_report_free(&report);
    return st;
}

int main(int argc, char **argv)
{
    const il_reader *r = argc == 3 ? il_reader_named(argv[1]) : NULL;
    size_t n = 0;
    char *data = r ? load(argv[2], &n) : NULL;
    double best = 1e9;
    counter c = { .points = 0 };
    il_error err = IL_ERROR_INIT;
    il_status st = data ? IL_OK : IL_E_USAGE;
    for (int i = 0; i < 5 && st == IL_OK; i++) {
        double start = seconds();
        st = run_once(r, data, n, &c, &err);
        best = seconds() - start < best ? seconds() - start : best;
    }
    il_free(data);
    if (st == IL_OK)
        printf("%.1f %.0f\n", (double)n / best / 1e6, (double)c.points / best);
    else
        fprintf(stderr, "read: %s\n", err.text);
    return (int)st;
}
