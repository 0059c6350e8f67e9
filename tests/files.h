/* files.h - files in the test's own folder, and its standard streams moved away. */
#ifndef IL_TESTS_FILES_H
#define IL_TESTS_FILES_H

#include "test.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FILES_PATH_MAX = 1024 };

/* A fresh folder below TMPDIR: the group fixture's state is its name. */
static inline int files_setup(void **state)
{
    const char *tmp = getenv("TMPDIR");
    char *dir = malloc(FILES_PATH_MAX);
    snprintf(dir, FILES_PATH_MAX, "%s/files-XXXXXX", tmp && *tmp ? tmp : "/tmp");
    *state = dir;
    return mkdtemp(dir) ? 0 : -1;
}

/* Files only one level deep are removed. */
static inline int files_teardown(void **state)
{
    DIR *d = opendir(*state);
    for (struct dirent *e; d && (e = readdir(d));) {
        char path[FILES_PATH_MAX + 300];
        snprintf(path, sizeof path, "%s/%s", (char *)*state, e->d_name);
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
            remove(path);
    }
    if (d)
        closedir(d);
    int failed = rmdir(*state);
    free(*state);
    return failed;
}

static inline const char *files_path(char to[FILES_PATH_MAX], void **state, const char *name)
{
    int n = snprintf(to, FILES_PATH_MAX, "%s/%s", (char *)*state, name);
    assert_in_range(n, 1, FILES_PATH_MAX - 1);
    return to;
}

static inline void files_write(const char *path, const void *data, size_t n)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(data, 1, n, f), n);
    assert_int_equal(fclose(f), 0);
}

/* All bytes, with a terminator behind them; to be freed. */
static inline char *files_read(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    assert_int_equal(fseek(f, 0, SEEK_END), 0);
    *n = (size_t)ftell(f);
    rewind(f);
    char *data = malloc(*n + 1);
    assert_non_null(data);
    assert_int_equal(fread(data, 1, *n, f), *n);
    data[*n] = '\0';
    fclose(f);
    return data;
}

static inline void files_assert_content(const char *path, const char *text)
{
    size_t n;
    char *data = files_read(path, &n);
    assert_string_equal(data, text);
    assert_int_equal(n, strlen(text));
    free(data);
}

/* Names in the folder, without . and .. */
static inline int files_count(void **state)
{
    int n = -2;
    DIR *d = opendir(*state);
    assert_non_null(d);
    while (readdir(d))
        n++;
    closedir(d);
    return n;
}

/* Put NEW_FD (closed here; -1: nothing at all) in the place of FD; what was
 * there is returned for files_restore.  FD is put back before any assertion. */
static inline int files_replace(int fd, int new_fd)
{
    fflush(stdout);
    int old = fcntl(fd, F_DUPFD_CLOEXEC, 100);
    if (new_fd < 0) {
        close(fd);
    } else {
        dup2(new_fd, fd);
        close(new_fd);
    }
    return old;
}

static inline void files_restore(int fd, int old)
{
    dup2(old, fd);
    close(old);
}

#endif
