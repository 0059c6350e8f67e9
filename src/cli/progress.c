#include "config.h"
#include "cli/progress.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double il_clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void il_voice_init(il_voice *v, const il_options *o)
{
    bool wanted = o->progress == IL_WHEN_ALWAYS || (o->progress == IL_WHEN_AUTO && isatty(STDERR_FILENO));
    *v = (il_voice){ .quiet = o->quiet, .verbose = o->verbose && !o->quiet, .progress = wanted && !o->quiet };
}

enum { WIDTH = 79, NAME_WIDTH = 30 };
static const double INTERVAL = 0.1;

void il_progress_show(il_voice *v, const char *stack, size_t slices, size_t slabs)
{
    if (!v->progress)
        return;
    double now = il_clock_seconds();
    if (v->shown > 0 && now - v->last_shown < INTERVAL)
        return;
    char name[NAME_WIDTH + 1], line[WIDTH + 1];
    il_text_printable(name, sizeof name, stack, strlen(stack));
    int n = snprintf(line, sizeof line, "%s%s%zu slices, %zu slabs", name, *name ? ": " : "", slices, slabs);
    il_progress_clear(v);
    fputs(line, stderr);
    fflush(stderr);
    v->shown = n < WIDTH ? (size_t)n : WIDTH;
    v->last_shown = now;
}

void il_progress_clear(il_voice *v)
{
    if (v->shown == 0)
        return;
    fprintf(stderr, "\r%*s\r", (int)v->shown, "");
    v->shown = 0;
}
