#include "config.h"
#include "base/alloc.h"
#include "base/threads.h"
#include "test.h"

#include <string.h>
#include <sys/resource.h>
#include <time.h>

/* Jobs in a row, each with its own slot; a job may be taken only when its
 * predecessor's predecessor is done, so that workers must sleep and be woken. */
enum { JOBS = 500 };

typedef struct queue {
    il_crew crew;
    int next, done, running, most_running;
    bool finished[JOBS];
    long slot[JOBS];
} queue;

static int step(void *self, pthread_mutex_t *mutex)
{
    queue *q = self;
    int job = q->next;
    if (job == JOBS || (job >= 2 && !q->finished[job - 2]))
        return 0;
    q->next++;
    q->running++;
    q->most_running = q->running > q->most_running ? q->running : q->most_running;
    pthread_mutex_unlock(mutex);
    long sum = 0;
    for (long i = 0; i < 2000; i++)
        sum += i * job % 7;
    q->slot[job] = sum; /* nobody else's slot: no lock */
    pthread_mutex_lock(mutex);
    q->running--;
    q->finished[job] = true;
    q->done++;
    il_crew_wake(&q->crew);
    return 1;
}

static void run(queue *q, int threads)
{
    memset(q, 0, sizeof *q);
    assert_int_equal(il_crew_start(&q->crew, threads, step, q, NULL), IL_OK);
    pthread_mutex_lock(&q->crew.mutex);
    while (q->done < JOBS)
        il_crew_help(&q->crew);
    pthread_mutex_unlock(&q->crew.mutex);
    il_crew_end(&q->crew);
    assert_int_equal(q->done, JOBS);
    assert_int_equal(q->running, 0);
}

static void any_number_of_threads_does_every_job_once(void **state)
{
    (void)state;
    static queue one, many;
    run(&one, 1);
    assert_int_equal(one.most_running, 1);
    static const int threads[] = { 0, 2, 3, 8, 33 };
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        run(&many, threads[i]);
        assert_memory_equal(many.slot, one.slot, sizeof one.slot);
        assert_true(many.most_running <= 2); /* the queue's own rule */
    }
}

static int never(void *self, pthread_mutex_t *mutex)
{
    (void)self, (void)mutex;
    return 0;
}

static void sleeping_workers_go_home(void **state)
{
    (void)state;
    for (int i = 0; i < 50; i++) {
        il_crew c;
        assert_int_equal(il_crew_start(&c, 4, never, NULL, NULL), IL_OK);
        if (i % 10 == 0)
            nanosleep(&(struct timespec){ 0, 5000000 }, NULL); /* now they do sleep */
        il_crew_end(&c);
        il_crew_end(&c); /* safe twice */
    }
}

static void helping_alone_without_work_returns(void **state)
{
    (void)state;
    il_crew c;
    assert_int_equal(il_crew_start(&c, 1, never, NULL, NULL), IL_OK);
    pthread_mutex_lock(&c.mutex);
    il_crew_help(&c);
    pthread_mutex_unlock(&c.mutex);
    il_crew_end(&c);
}

static void a_crew_that_never_was_ends(void **state)
{
    (void)state;
    il_crew c;
    memset(&c, 0, sizeof c);
    il_crew_end(&c);
    il_error err = IL_ERROR_INIT;
    il_alloc_test_fail_after(0);
    il_status st = il_crew_start(&c, 4, never, NULL, &err);
    il_alloc_test_fail_after(-1);
    assert_int_equal(st, IL_E_NOMEM);
    assert_int_equal(err.code, IL_E_NOMEM);
    il_crew_end(&c);
}

static void fewer_threads_than_asked_for_do_it_too(void **state)
{
    (void)state;
#ifndef IL_SANITIZED
    struct rlimit before, less;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    less = before;
    less.rlim_cur = 100 << 20; /* room for some stacks of 8 MB */
    static queue q;
    memset(&q, 0, sizeof q);
    assert_int_equal(setrlimit(RLIMIT_AS, &less), 0);
    il_status st = il_crew_start(&q.crew, 200, step, &q, NULL);
    setrlimit(RLIMIT_AS, &before);
    assert_int_equal(st, IL_OK);
    assert_true(q.crew.n_workers < 199);
    pthread_mutex_lock(&q.crew.mutex);
    while (q.done < JOBS)
        il_crew_help(&q.crew);
    pthread_mutex_unlock(&q.crew.mutex);
    il_crew_end(&q.crew);
#endif
}

static void there_is_a_processor(void **state)
{
    (void)state;
    assert_in_range(il_threads_available(), 1, 1024);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_does_every_job_once),
        cmocka_unit_test(sleeping_workers_go_home),
        cmocka_unit_test(helping_alone_without_work_returns),
        cmocka_unit_test(a_crew_that_never_was_ends),
        cmocka_unit_test(fewer_threads_than_asked_for_do_it_too),
        cmocka_unit_test(there_is_a_processor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
