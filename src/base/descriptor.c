#include "config.h"
#include "base/descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int il_descriptor_above_stdio(int fd)
{
    if (fd < 0 || fd > 2)
        return fd;
    int higher = fcntl(fd, F_DUPFD_CLOEXEC, 3);
    int reason = errno;
    close(fd);
    errno = reason;
    return higher;
}

/* After a call that failed: is it worth another try?  Waits until EVENTS when
 * the descriptor is one that somebody made non-blocking. */
static bool try_again(int fd, short events)
{
    if (errno == EINTR)
        return true;
    if (errno != EAGAIN && errno != EWOULDBLOCK)
        return false;
    struct pollfd p = { fd, events, 0 };
    return poll(&p, 1, -1) >= 0 || errno == EINTR;
}

bool il_descriptor_read(int fd, void *to, size_t n, size_t *got)
{
    ssize_t r;
    do
        r = read(fd, to, n);
    while (r < 0 && try_again(fd, POLLIN));
    *got = r > 0 ? (size_t)r : 0;
    return r >= 0;
}

bool il_descriptor_write(int fd, const void *from, size_t n)
{
    const char *p = from;
    while (n > 0) {
        ssize_t w = write(fd, p, n);
        if (w < 0 && !try_again(fd, POLLOUT))
            return false;
        if (w > 0)
            p += w, n -= (size_t)w;
    }
    return true;
}

il_status il_fail_system(il_error *err, const char *file, const char *what, int reason)
{
    char words[128];
    if (strerror_r(reason, words, sizeof words) != 0)
        snprintf(words, sizeof words, "error %d", reason);
    il_status st = il_fail(err, IL_E_IO, 0, "%s: %s", what, words);
    il_error_set_file(err, file);
    return st;
}
