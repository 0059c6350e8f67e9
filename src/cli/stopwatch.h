/* stopwatch.h - when each stack begins to come out of the reader. */
#ifndef IL_CLI_STOPWATCH_H
#define IL_CLI_STOPWATCH_H

#include "model/sink.h"

/* A sink in front of NEXT that writes the time to *BEGAN when a stack begins. */
typedef struct il_stopwatch {
    il_sink sink;
    il_sink *next;
    double *began;              /* seconds of il_clock_seconds */
} il_stopwatch;

/* NEXT and BEGAN are borrowed; W has nothing to free. */
il_sink *il_stopwatch_init(il_stopwatch *w, il_sink *next, double *began);

#endif
