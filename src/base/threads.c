#include "config.h"
#ifdef HAVE_SCHED_GETAFFINITY
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "base/threads.h"
#include "base/alloc.h"

#include <sched.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

int il_threads_available(void)
{
    long n = 0;
#ifdef HAVE_SCHED_GETAFFINITY
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        n = CPU_COUNT(&set);
#endif
    if (n < 1)
        n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}

static void *work(void *self)
{
    il_crew *c = self;
    pthread_mutex_lock(&c->mutex);
    while (!c->stop)
        if (!c->step(c->self, &c->mutex) && !c->stop)
            pthread_cond_wait(&c->changed, &c->mutex);
    pthread_mutex_unlock(&c->mutex);
    return NULL;
}

/* Start up to N workers, as many as the system gives.  They take no signals:
 * those are the caller's thread's. */
static void start_workers(il_crew *c, int n)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (c->n_workers < n && pthread_create(&c->workers[c->n_workers], NULL, work, c) == 0)
        c->n_workers++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

il_status il_crew_start(il_crew *c, int n, int (*step)(void *, pthread_mutex_t *), void *self, il_error *err)
{
    memset(c, 0, sizeof *c);
    size_t workers = n > 1 ? (size_t)n - 1 : 0;
    pthread_t *w = il_alloc(workers, sizeof *w);
    if (!w)
        return il_fail_nomem(err);
    if (pthread_mutex_init(&c->mutex, NULL) != 0) {
        il_free(w);
        return il_fail(err, IL_E_INTERNAL, 0, "the system gives no mutex");
    }
    if (pthread_cond_init(&c->changed, NULL) != 0) {
        pthread_mutex_destroy(&c->mutex);
        il_free(w);
        return il_fail(err, IL_E_INTERNAL, 0, "the system gives no condition variable");
    }
    c->workers = w;
    c->step = step;
    c->self = self;
    /* The workers wait here until c->n_workers is settled. */
    pthread_mutex_lock(&c->mutex);
    start_workers(c, (int)workers);
    pthread_mutex_unlock(&c->mutex);
    return IL_OK;
}

void il_crew_wake(il_crew *c)
{
    pthread_cond_broadcast(&c->changed);
}

void il_crew_help(il_crew *c)
{
    /* Without workers nobody could change anything: waiting would be for ever. */
    if (!c->step(c->self, &c->mutex) && c->n_workers > 0)
        pthread_cond_wait(&c->changed, &c->mutex);
}

void il_crew_end(il_crew *c)
{
    if (!c->step)
        return;
    pthread_mutex_lock(&c->mutex);
    c->stop = 1;
    pthread_cond_broadcast(&c->changed);
    pthread_mutex_unlock(&c->mutex);
    for (int i = 0; i < c->n_workers; i++)
        pthread_join(c->workers[i], NULL);
    pthread_cond_destroy(&c->changed);
    pthread_mutex_destroy(&c->mutex);
    il_free(c->workers);
    memset(c, 0, sizeof *c);
}
