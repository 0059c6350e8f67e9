/* measure.c - time and memory of a command.
 *
 *     measure RUNS COMMAND [ARGUMENT]...
 *
 * Runs it RUNS times with standard output to /dev/null and prints what the
 * fastest run took: seconds on the clock, seconds of processors, and the peak
 * memory of any run in MB.  The exit status is the first that is not 0. */
#include "config.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Of all children so far. */
static double processor_seconds(struct rusage *u)
{
    getrusage(RUSAGE_CHILDREN, u);
    return seconds_of(u->ru_utime) + seconds_of(u->ru_stime);
}

static int run(char **command)
{
    pid_t child = fork();
    if (child == 0) {
        int nowhere = open("/dev/null", O_WRONLY);
        if (nowhere < 0 || dup2(nowhere, 1) < 0)
            _exit(126);
        execvp(command[0], command);
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child)
        return 125;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(int argc, char **argv)
{
    int runs = argc > 2 ? atoi(argv[1]) : 0, failed = 0;
    double clock = 1e9, processors = 0;
    struct rusage u = { 0 };
    if (runs < 1)
        return 2;
    for (int i = 0; i < runs && failed == 0; i++) {
        double before = processor_seconds(&u), start = seconds();
        failed = run(argv + 2);
        double took = seconds() - start, worked = processor_seconds(&u) - before;
        if (took < clock) {
            clock = took;
            processors = worked;
        }
    }
    printf("%.3f %.3f %.1f\n", clock, processors, (double)u.ru_maxrss / 1024);
    return failed;
}
