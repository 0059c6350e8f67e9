/* output-file.c - names, temporaries and renames; the end of every output. */
#include "config.h"
#include "base/output-private.h"
#include "base/alloc.h"
#include "base/descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* ---- opening -------------------------------------------------------------- */

/* The length of PATH's folder with its slash; 0 when there is none. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* The N bytes of FOLDER (with its slash) and NAME in one string, owned. */
static char *join_path(const char *folder, size_t n, const char *name)
{
    size_t m = strlen(name);
    char *s = il_alloc(n + m + 1, 1);
    if (s) {
        memcpy(s, folder, n);
        memcpy(s + n, name, m + 1);
    }
    return s;
}

/* Replace *PATH, a symbolic link, by what it points to. */
static il_status follow_link(char **path, il_error *err)
{
    char to[4096];
    ssize_t n = readlink(*path, to, sizeof to);
    if (n < 0 || (size_t)n >= sizeof to)
        return il_fail_system(err, *path, "cannot follow the link", n < 0 ? errno : ENAMETOOLONG);
    to[n] = '\0';
    char *next = join_path(*path, to[0] == '/' ? 0 : folder_length(*path), to);
    if (!next)
        return il_fail_nomem(err);
    il_free(*path);
    *path = next;
    return IL_OK;
}

/* O->target: the path with the links at its end followed, also a dangling one,
 * so that the rename replaces the file and not the link. */
static il_status find_target(il_output *o, il_error *err)
{
    enum { LINKS_MOST = 40 };
    o->target = il_strndup(o->path, strlen(o->path));
    if (!o->target)
        return il_fail_nomem(err);
    struct stat st;
    for (int i = 0; lstat(o->target, &st) == 0 && S_ISLNK(st.st_mode); i++) {
        il_status failed = i < LINKS_MOST ? follow_link(&o->target, err)
                                          : il_fail_system(err, o->path, "cannot open", ELOOP);
        if (failed != IL_OK)
            return failed;
    }
    return IL_OK;
}

/* Learn now what would make the temporary or the rename fail later. */
static il_status check_replaceable(il_output *o, il_error *err)
{
    if (o->existed && faccessat(AT_FDCWD, o->target, W_OK, AT_EACCESS) != 0)
        return il_fail_system(err, o->path, "cannot write", errno);
    size_t n = folder_length(o->target);
    if (o->target[n] == '\0')
        return il_fail_system(err, o->path, "cannot write", o->path[0] ? EISDIR : ENOENT);
    char *folder = n > 0 ? il_strndup(o->target, n) : il_strndup(".", 1);
    if (!folder)
        return il_fail_nomem(err);
    int reason = faccessat(AT_FDCWD, folder, W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
    il_free(folder);
    return reason == 0 ? IL_OK : il_fail_system(err, o->path, "cannot write into its folder", reason);
}

/* Is ST the regular file that standard output goes to?  /dev/stdout can be:
 * then it is written where it stands, as the shell has it. */
static bool is_standard_output(const struct stat *st)
{
    struct stat out;
    return fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == st->st_dev && out.st_ino == st->st_ino;
}

static il_status open_standard_output(il_output *o, il_error *err)
{
    struct stat st;
    o->kind = IL_OUTPUT_IN_PLACE;
    o->fd = STDOUT_FILENO;
    return fstat(o->fd, &st) == 0 ? IL_OK : il_fail_system(err, o->path, "cannot write", errno);
}

static il_status open_in_place(il_output *o, il_error *err)
{
    o->kind = IL_OUTPUT_IN_PLACE;
    o->fd = il_descriptor_above_stdio(open(o->path, O_WRONLY | O_CLOEXEC | O_NOCTTY));
    o->owns_fd = o->fd >= 0;
    return o->fd >= 0 ? IL_OK : il_fail_system(err, o->path, "cannot open", errno);
}

static il_status open_path(il_output *o, il_error *err)
{
    struct stat st;
    o->existed = stat(o->path, &st) == 0;
    if (!o->existed && errno != ENOENT)
        return il_fail_system(err, o->path, "cannot open", errno);
    if (o->existed && S_ISDIR(st.st_mode))
        return il_fail_system(err, o->path, "cannot write", EISDIR);
    if (o->existed && S_ISREG(st.st_mode) && is_standard_output(&st))
        return open_standard_output(o, err);
    if (o->existed && !S_ISREG(st.st_mode))
        return open_in_place(o, err);
    if (o->existed)
        o->mode = st.st_mode & 07777, o->owner = st.st_uid, o->group = st.st_gid;
    il_status failed = find_target(o, err);
    return failed == IL_OK ? check_replaceable(o, err) : failed;
}

il_status il_output_open(il_output **out, const char *path, il_error *err)
{
    *out = NULL;
    bool standard = strcmp(path, "-") == 0;
    il_output *o;
    il_status st = il_output_new(&o, IL_OUTPUT_REPLACED, standard ? "standard output" : path, IL_OUTPUT_BLOCK, err);
    if (st != IL_OK)
        return st;
    st = standard ? open_standard_output(o, err) : open_path(o, err);
    if (st == IL_OK)
        *out = o;
    else
        il_output_discard(o);
    return st;
}

/* ---- the temporary -------------------------------------------------------- */

/* A name that nobody is likely to have taken; O_EXCL decides. */
static void temporary_name(char *to, size_t size, int attempt)
{
    struct timespec t = { 0, 0 };
    clock_gettime(CLOCK_REALTIME, &t);
    unsigned long long seed = (unsigned long long)t.tv_nsec + (unsigned long long)t.tv_sec * 1000000007u;
    snprintf(to, size, ".isoloft-%lx-%llx-%d", (unsigned long)getpid(), seed & 0xFFFFFFFFFFu, attempt);
}

/* Give the new file what the old one had.  The owner only if we may; without
 * it the set-id bits would mean somebody else, so they go. */
static bool keep_permissions(const il_output *o)
{
    if (!o->existed)
        return true;
    bool same = fchown(o->fd, (uid_t)o->owner, (gid_t)o->group) == 0 ||
                (fchown(o->fd, (uid_t)-1, (gid_t)o->group) == 0 && o->owner == (unsigned)geteuid());
    return fchmod(o->fd, (mode_t)(same ? o->mode : o->mode & 0777)) == 0;
}

bool il_output_make_temporary(il_output *o)
{
    enum { ATTEMPTS = 100 };
    if (o->failure.code != IL_OK)
        return false;
    size_t folder = folder_length(o->target);
    mode_t mode = o->existed ? (mode_t)(o->mode & 0666) : 0666;
    errno = EEXIST;
    for (int i = 0; i < ATTEMPTS && o->fd < 0 && errno == EEXIST; i++) {
        char name[80];
        temporary_name(name, sizeof name, i);
        char *path = join_path(o->target, folder, name);
        if (!path) {
            il_fail_nomem(&o->failure);
            return false;
        }
        o->fd = il_descriptor_above_stdio(open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, mode));
        if (o->fd >= 0)
            o->temporary = path;
        else
            il_free(path);
    }
    o->owns_fd = o->fd >= 0;
    if (o->fd < 0)
        il_fail_system(&o->failure, o->path, "cannot make a temporary file beside it", errno);
    else if (!keep_permissions(o))
        il_fail_system(&o->failure, o->path, "cannot give the new file the old one's permissions", errno);
    return o->failure.code == IL_OK;
}

/* ---- the end -------------------------------------------------------------- */

bool il_output_close_descriptor(il_output *o)
{
    /* Standard output stays open for others; closing a duplicate makes file
     * systems that write late (NFS, quotas) tell what they could not keep. */
    int fd = o->owns_fd ? o->fd : dup(o->fd);
    o->fd = -1;
    o->owns_fd = false;
    return fd >= 0 && (close(fd) == 0 || errno == EINTR);
}

/* All bytes into the file, under whatever name. */
static void complete(il_output *o)
{
    if (o->kind == IL_OUTPUT_MEMORY || o->kind == IL_OUTPUT_SPOOL)
        return;
    il_output_empty_buffer(o);
    if (o->fd < 0)
        il_output_make_temporary(o); /* an empty file is a file too */
    if (o->failure.code == IL_OK && !il_output_close_descriptor(o))
        il_fail_system(&o->failure, o->path, "cannot write", errno);
}

static void put_in_place(il_output *o)
{
    if (!o->temporary)
        return;
    if (rename(o->temporary, o->target) != 0) {
        il_fail_system(&o->failure, o->path, "cannot put the finished file in place", errno);
        return;
    }
    il_free(o->temporary);
    o->temporary = NULL;
}

il_status il_output_commit(il_output *o, il_error *err)
{
    complete(o);
    if (o->beside && o->failure.code == IL_OK) {
        il_output *beside = o->beside;
        o->beside = NULL;
        il_output_commit(beside, &o->failure);
    }
    if (o->failure.code == IL_OK)
        put_in_place(o);
    il_status st = il_output_status(o, err);
    il_output_discard(o);
    return st;
}

void il_output_discard(il_output *o)
{
    if (!o)
        return;
    il_output_discard(o->beside);
    if (o->owns_fd)
        close(o->fd);
    if (o->temporary)
        unlink(o->temporary);
    il_free(o->temporary);
    il_free(o->target);
    il_free(o->path);
    il_free(o->buf);
    il_free(o);
}
