/* threads.h - a few workers that ask one function for work. */
#ifndef IL_BASE_THREADS_H
#define IL_BASE_THREADS_H

#include "base/status.h"

#include <pthread.h>

/* Processors this process may run on, at least 1. */
int il_threads_available(void);

/* A crew: N - 1 threads beside the caller's.  STEP is called with the crew's
 * mutex held; it finds something to do, unlocks while doing it, locks again
 * and returns 1, or returns 0 when there is nothing to do now.  Workers sleep
 * on 0 until il_crew_wake.  The caller joins in through il_crew_help. */
typedef struct il_crew {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    pthread_t *workers;
    int n_workers;
    int stop;
    int (*step)(void *self, pthread_mutex_t *mutex);
    void *self;
} il_crew;

/* N at least 1.  With fewer threads than asked for (the system's limit) the
 * crew works all the same. */
il_status il_crew_start(il_crew *c, int n, int (*step)(void *, pthread_mutex_t *), void *self, il_error *err);

/* With the mutex held: wake all who wait. */
void il_crew_wake(il_crew *c);

/* With the mutex held: do one step, or wait until something changes. */
void il_crew_help(il_crew *c);

/* Let running steps end, then join all workers.  Safe on a zeroed crew. */
void il_crew_end(il_crew *c);

#endif
