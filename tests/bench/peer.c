#include "config.h"
#include "peer.h"
#include "base/alloc.h"
#include "base/number.h"
#include "judge.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* ---- running it ---- */

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Of all children so far. */
static double processor_seconds(void)
{
    struct rusage u;
    getrusage(RUSAGE_CHILDREN, &u);
    return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

enum { INTERRUPTED = 128 + SIGINT };

/* COMMAND in FOLDER (null: here), silent; its exit status, or more than 125.  An
 * interrupt ends the child alone, so that the folder can be removed first. */
static int run(const char *folder, char *const command[])
{
    struct sigaction ignore = { .sa_handler = SIG_IGN }, before;
    sigaction(SIGINT, &ignore, &before);
    pid_t child = fork();
    if (child == 0) {
        sigaction(SIGINT, &before, NULL);
        int nowhere = open("/dev/null", O_RDWR);
        if (nowhere < 0 || dup2(nowhere, 0) < 0 || dup2(nowhere, 1) < 0 || dup2(nowhere, 2) < 0)
            _exit(126);
        if (folder && chdir(folder) != 0)
            _exit(126);
        execvp(command[0], command);
        _exit(127);
    }
    int status = 0;
    bool gone = child < 0 || waitpid(child, &status, 0) != child;
    sigaction(SIGINT, &before, NULL);
    return gone ? 126 : WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool peer_is_there(void)
{
    return run(NULL, (char *const[]){ "elastix", "--version", NULL }) == 0;
}

/* ---- what it reads ---- */

static const char parameters[] =
    "(FixedImageDimension 2)\n(MovingImageDimension 2)\n"
    "(FixedInternalImagePixelType \"float\")\n(MovingInternalImagePixelType \"float\")\n"
    "(Registration \"MultiResolutionRegistration\")\n"
    "(FixedImagePyramid \"FixedSmoothingImagePyramid\")\n"
    "(MovingImagePyramid \"MovingSmoothingImagePyramid\")\n"
    "(Interpolator \"BSplineInterpolator\")\n"
    "(ResampleInterpolator \"FinalBSplineInterpolator\")\n"
    "(Resampler \"DefaultResampler\")\n"
    "(Metric \"AdvancedMeanSquares\")\n"
    "(Optimizer \"AdaptiveStochasticGradientDescent\")\n"
    "(Transform \"BSplineTransform\")\n"
    "(UseDirectionCosines \"true\")\n"
    "(FinalGridSpacingInPhysicalUnits 8)\n"
    "(NumberOfResolutions 4)\n"
    "(GridSpacingSchedule 8 4 2 1)\n" /* 64, 32, 16, 8 cells */
    "(MaximumNumberOfIterations 250)\n"
    "(ImageSampler \"RandomCoordinate\")\n"
    "(NumberOfSpatialSamples 3000)\n"
    "(NewSamplesEveryIteration \"true\")\n"
    "(RandomSeed 1)\n"
    "(AutomaticParameterEstimation \"true\")\n"
    "(WriteResultImage \"false\")\n";

static FILE *open_in(const char *folder, const char *name, const char *mode)
{
    char path[4096];
    int n = snprintf(path, sizeof path, "%s/%s", folder, name);
    return n > 0 && (size_t)n < sizeof path ? fopen(path, mode) : NULL;
}

static bool close_written(FILE *f)
{
    bool bad = !f || ferror(f);
    return !(f && fclose(f) != 0) && !bad;
}

static bool write_parameters(const char *folder)
{
    FILE *f = open_in(folder, "parameters.txt", "w");
    if (f)
        fputs(parameters, f);
    return close_written(f);
}

/* A MetaImage of the distance to O at whole cells, positive inside: NAME.mhd
 * tells of NAME.raw. */
static bool write_map(const char *folder, const char *name, const pairs_outline *o)
{
    char file[40];
    const uint16_t one = 1;
    snprintf(file, sizeof file, "%s.mhd", name);
    FILE *f = open_in(folder, file, "w");
    if (f)
        fprintf(f, "ObjectType = Image\nNDims = 2\nBinaryData = True\nBinaryDataByteOrderMSB = %s\n"
                   "Offset = 0 0\nElementSpacing = 1 1\nDimSize = %d %d\nElementType = MET_FLOAT\n"
                   "ElementDataFile = %s.raw\n",
                *(const unsigned char *)&one ? "False" : "True", PAIRS_FRAME, PAIRS_FRAME, name);
    if (!close_written(f))
        return false;
    snprintf(file, sizeof file, "%s.raw", name);
    f = open_in(folder, file, "wb");
    for (int y = 0; f && y < PAIRS_FRAME; y++)
        for (int x = 0; x < PAIRS_FRAME; x++) {
            float d = (float)judge_distance(o, x, y);
            d = judge_inside(o, x, y) ? d : -d;
            fwrite(&d, sizeof d, 1, f);
        }
    return close_written(f);
}

/* ---- what it writes ---- */

enum { MOST_TEXT = 1 << 20 }; /* of what elastix writes, some 50 kB */

/* The whole file with a terminator; null when it cannot be had. */
static char *load(const char *folder, const char *name)
{
    char *text = NULL;
    FILE *f = open_in(folder, name, "r");
    if (!f)
        return NULL;
    text = il_alloc(MOST_TEXT, 1);
    if (text)
        text[fread(text, 1, MOST_TEXT - 1, f)] = '\0';
    fclose(f);
    return text;
}

/* The N numbers behind "(KEY " in TEXT. */
static bool numbers_of(const char *text, const char *key, double *to, size_t n)
{
    char word[60];
    snprintf(word, sizeof word, "\n(%s ", key);
    const char *at = strstr(text, word);
    if (!at)
        return false;
    at += strlen(word);
    for (size_t i = 0; i < n; i++) {
        size_t used = il_number_parse(at, strcspn(at, " )\n"), &to[i]);
        if (used == 0 || (at[used] != ' ' && at[used] != ')'))
            return false;
        at += used + 1;
    }
    return at[-1] == ')';
}

/* All displacements of x, then all of y: the additive cubic B-spline that
 * elastix calls BSplineTransform is one step of il_lattice_apply. */
static bool take_lattice(const char *text, il_lattice *l)
{
    double size[2], spacing[2], origin[2];
    if (!strstr(text, "(Transform \"BSplineTransform\")") || !numbers_of(text, "GridSize", size, 2) ||
        !numbers_of(text, "GridSpacing", spacing, 2) || !numbers_of(text, "GridOrigin", origin, 2))
        return false;
    if (!(size[0] >= 1 && size[0] <= 1000 && size[1] >= 1 && size[1] <= 1000) || spacing[0] != spacing[1])
        return false;
    l->nx = (uint32_t)size[0];
    l->ny = (uint32_t)size[1];
    l->x = origin[0], l->y = origin[1], l->spacing = spacing[0];
    size_t n = (size_t)l->nx * l->ny;
    double *v = il_alloc(2 * n, sizeof *v);
    bool ok = v && numbers_of(text, "TransformParameters", v, 2 * n) && il_grow(&l->d, &l->cap, 2 * n, sizeof *l->d);
    for (size_t i = 0; ok && i < n; i++) {
        l->d[2 * i] = v[i];
        l->d[2 * i + 1] = v[n + i];
    }
    l->n = ok ? n : 0;
    il_free(v);
    return ok;
}

/* ---- a run ---- */

static void remove_folder(const char *folder)
{
    DIR *d = opendir(folder);
    for (struct dirent *e = d ? readdir(d) : NULL; e; e = readdir(d))
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
            unlinkat(dirfd(d), e->d_name, 0);
    if (d)
        closedir(d);
    rmdir(folder);
}

/* The exit status, or -1 when files cannot be written or read. */
static int match_in(const char *folder, const pairs_pair *p, peer_result *out)
{
    char *const command[] = { "elastix", "-f", "upper.mhd", "-m", "lower.mhd", "-p", "parameters.txt",
                              "-out", ".", "-threads", "1", NULL };
    if (!write_parameters(folder) || !write_map(folder, "upper", &p->upper) || !write_map(folder, "lower", &p->lower))
        return -1;
    double worked = processor_seconds(), began = seconds();
    int status = run(folder, command);
    out->clock_s = seconds() - began;
    out->processor_s = processor_seconds() - worked;
    if (status != 0)
        return status;
    char *text = load(folder, "TransformParameters.0.txt");
    bool ok = text && take_lattice(text, &out->lattice);
    il_free(text);
    return ok ? 0 : -1;
}

bool peer_match(const pairs_pair *p, peer_result *out)
{
    char folder[4096];
    const char *tmp = getenv("TMPDIR");
    *out = (peer_result){ .phi = { .global = { 1, 0, 0, 1, 0, 0 }, .steps = 1 } };
    int n = snprintf(folder, sizeof folder, "%s/bench-match.XXXXXX", tmp && *tmp ? tmp : "/tmp");
    if (n < 0 || (size_t)n >= sizeof folder || !mkdtemp(folder)) {
        perror("bench-match: no temporary folder");
        return false;
    }
    int status = match_in(folder, p, out);
    remove_folder(folder);
    if (status == INTERRUPTED)
        raise(SIGINT);
    if (status != 0)
        fprintf(stderr, "bench-match: elastix failed: %d\n", status);
    out->phi.lattice = &out->lattice;
    out->phi.n_lattices = status == 0;
    return status == 0;
}

void peer_free(peer_result *r)
{
    il_free(r->lattice.d);
    *r = (peer_result){ 0 };
}
