#include "config.h"
#include "cli/oddities.h"

#include <math.h>
#include <stdio.h>

/* Spacings that differ by no more than this share are even: files write heights
 * with few decimals. */
static const double EVEN = 0.01;

/* One and several of what a repair is about.  Null: nothing unusual. */
static const char *const repair_words[IL_N_REPAIRS][2] = {
    [IL_REPAIR_REPEATED_POINT]  = { "repeated point", "repeated points" },
    [IL_REPAIR_DUPLICATE_RING]  = { "duplicate ring", "duplicate rings" },
    [IL_REPAIR_DEGENERATE_RING] = { "degenerate ring", "degenerate rings" },
    [IL_REPAIR_CROSSING]        = { "crossing", "crossings" },
    [IL_REPAIR_TOUCH]           = { "touch", "touches" },
    [IL_REPAIR_KEYHOLE]         = { "keyhole", "keyholes" },
    [IL_REPAIR_KEYHOLE_EDGE]    = { "cancelled edge", "cancelled edges" },
    [IL_REPAIR_PINCH]           = { "pinch", "pinches" },
    [IL_REPAIR_REORDERED_SLICE] = { "reordered slice", "reordered slices" },
    [IL_REPAIR_MERGED_SLICE]    = { "merged slice", "merged slices" },
    [IL_REPAIR_POINT_COUNT]     = { "wrong point count", "wrong point counts" },
    [IL_REPAIR_FLATTENED_POINT] = { "flattened point", "flattened points" },
    [IL_REPAIR_MOVED_CONTOUR]   = { "moved contour", "moved contours" },
    [IL_REPAIR_XOR_PAIR]        = { "cancelled XOR pair", "cancelled XOR pairs" },
    [IL_REPAIR_POINT_LINE]      = { "line of one point", "lines of one point" },
    [IL_REPAIR_SPIKE]           = { "edge of a dead end", "edges of dead ends" },
    [IL_REPAIR_DUPLICATE_LINE]  = { "duplicate line", "duplicate lines" },
    [IL_REPAIR_SHARED_EDGE]     = { "duplicate edge", "duplicate edges" },
    [IL_REPAIR_JOINED_LINE]     = { "joint", "joints" },
    [IL_REPAIR_BRIDGED_GAP]     = { "bridged gap", "bridged gaps" },
    [IL_REPAIR_KNOT]            = { "knot", "knots" },
    [IL_REPAIR_CRUMB]           = { "line of two points", "lines of two points" },
};

typedef struct teller {
    void (*each)(void *self, const char *words);
    void *self;
} teller;

static void tell(const teller *t, const char *words)
{
    t->each(t->self, words);
}

/* Nothing for none. */
static void tell_count(const teller *t, size_t n, const char *one, const char *several)
{
    char words[80];
    if (n == 0)
        return;
    snprintf(words, sizeof words, "%zu %s", n, n == 1 ? one : several);
    tell(t, words);
}

static bool differs(double a, double b)
{
    return fabs(a - b) > EVEN * fmax(fabs(a), fabs(b));
}

/* A gap is told as that: what is uneven is the rest. */
static void tell_spacing(const teller *t, const il_stack_account *s)
{
    if (s->points > 0 && s->slices == 1)
        tell(t, "single slice");
    else
        tell_count(t, s->report.repair[IL_REPAIR_THICKENED_SLICE], "slice alone beside a gap", "slices alone beside gaps");
    tell_count(t, s->n_gaps, "gap", "gaps");
    bool short_ones = differs(s->spacing.least, s->spacing.usual);
    bool long_ones = s->n_gaps == 0 && differs(s->spacing.largest, s->spacing.usual);
    if (s->slices > 2 && (short_ones || long_ones))
        tell(t, "uneven spacing");
    if (s->slices > 1 && s->set_spacing > 0 && differs(s->spacing.usual, s->set_spacing))
        tell(t, "spacing unlike the others'");
}

static void tell_levels(const teller *t, const il_stack_account *s)
{
    if (s->points > 0 && s->slices == 1)
        tell(t, "single level");
    else if (s->slices > 1 && !(s->terrain.interval > 0))
        tell(t, "uneven interval");
    tell_count(t, s->terrain.n_missing, "missing level", "missing levels");
    tell_count(t, s->terrain.n_inside, "open end inside the map", "open ends inside the map");
}

void il_oddities_each(const il_stack_account *s, void (*each)(void *self, const char *words), void *self)
{
    teller t = { each, self };
    char words[40];
    if (s->status == IL_OK && s->points == 0)
        tell(&t, "empty");
    tell_count(&t, s->report.n_skipped, "part skipped", "parts skipped");
    if (s->planes) {
        snprintf(words, sizeof words, "planes %s", s->planes);
        tell(&t, words);
    }
    s->is_terrain ? tell_levels(&t, s) : tell_spacing(&t, s);
    for (int k = 0; k < IL_N_REPAIRS; k++)
        if (repair_words[k][0])
            tell_count(&t, s->report.repair[k], repair_words[k][0], repair_words[k][1]);
}
