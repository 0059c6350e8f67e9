/* map-crew.c - the points of a map projected by several threads.  Each point is by
 * itself, so that their number changes nothing. */
#include "config.h"
#include "base/threads.h"
#include "input/map-project.h"

enum { CHUNK = 8192 };

/* next: the first point that nobody has taken; n_done: points that are projected. */
typedef struct job {
    const il_projection *projection;
    double *xy;
    size_t n, next, n_done;
    il_status status;
    il_error *err;
    il_crew crew;
} job;

static int step(void *self, pthread_mutex_t *mutex)
{
    job *j = self;
    il_error err = IL_ERROR_INIT;
    size_t begin = j->next, n = j->n - begin < CHUNK ? j->n - begin : CHUNK;
    if (n == 0)
        return 0;
    j->next += n;
    pthread_mutex_unlock(mutex);
    il_status st = il_project_points(j->projection, j->xy + 2 * begin, n, &err);
    pthread_mutex_lock(mutex);
    if (st != IL_OK && j->status == IL_OK) {
        j->status = st;
        *j->err = err;
    }
    j->n_done += n;
    il_crew_wake(&j->crew);
    return 1;
}

il_status il_map_project_points(const il_projection *p, double *xy, size_t n, int threads, il_error *err)
{
    il_error failure = IL_ERROR_INIT;
    job j = { .projection = p, .xy = xy, .n = n, .err = &failure };
    if (threads < 2 || n <= CHUNK)
        return il_project_points(p, xy, n, err);
    il_status st = il_crew_start(&j.crew, threads, step, &j, err);
    if (st != IL_OK)
        return st;
    pthread_mutex_lock(&j.crew.mutex);
    while (j.n_done < n)
        il_crew_help(&j.crew);
    pthread_mutex_unlock(&j.crew.mutex);
    il_crew_end(&j.crew);
    return j.status == IL_OK ? IL_OK : il_fail(err, j.status, failure.line, "%s", failure.text);
}
