/* replay.c - a main for fuzz harnesses where there is no libFuzzer: runs the
 * harness over the files named, and over all files in the folders named.
 * Arguments that begin with '-' are libFuzzer's, and mean nothing here; so
 *     HARNESS -runs=0 FOLDER...
 * is the same call for both. */
#include "config.h"

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

enum { DEEPEST = 16, LONGEST_PATH = 4096 };

static void die(const char *what, const char *path)
{
    fprintf(stderr, "replay: %s %s\n", what, path);
    exit(1);
}

/* The file's bytes in a block of just their size, so that a sanitizer sees a
 * harness read beyond them. */
static long replay_file(const char *path, size_t size)
{
    FILE *f = fopen(path, "rb");
    uint8_t *data = malloc(size > 0 ? size : 1);
    if (!f || !data || fread(data, 1, size, f) != size)
        die("cannot read", path);
    fclose(f);
    fprintf(stderr, "%s\n", path); /* the last one named is the one that crashed */
    LLVMFuzzerTestOneInput(data, size);
    free(data);
    return 1;
}

static long replay(const char *path, int depth);

static long replay_folder(const char *path, int depth)
{
    struct dirent **entry;
    int n = depth < DEEPEST ? scandir(path, &entry, NULL, alphasort) : -1;
    if (n < 0)
        die("cannot list", path);
    long files = 0;
    for (int i = 0; i < n; i++) {
        char inside[LONGEST_PATH];
        int length = snprintf(inside, sizeof inside, "%s/%s", path, entry[i]->d_name);
        if (entry[i]->d_name[0] != '.' && length < LONGEST_PATH)
            files += replay(inside, depth + 1);
        free(entry[i]);
    }
    free(entry);
    return files;
}

static long replay(const char *path, int depth)
{
    struct stat st;
    if (stat(path, &st) != 0)
        die("cannot find", path);
    return S_ISDIR(st.st_mode) ? replay_folder(path, depth) : replay_file(path, (size_t)st.st_size);
}

int main(int argc, char **argv)
{
    long files = 0;
    for (int i = 1; i < argc; i++)
        if (argv[i][0] != '-')
            files += replay(argv[i], 0);
    printf("%ld inputs\n", files);
    return files > 0 ? 0 : 1;
}
