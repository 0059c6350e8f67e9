/* pair.h - all that is known between two neighbouring slices.
 *
 * The upper slice is matched onto the lower: phi takes a point of the upper
 * slice to the plane of the lower.  Places on a ring are written (ring, vertex,
 * t): the point (1 - t) v + t w on the edge from vertex v to its successor w,
 * 0 <= t < 1; rings and vertices count from 0 as in the normalised stream. */
#ifndef IL_MODEL_PAIR_H
#define IL_MODEL_PAIR_H

#include "model/ring.h"

typedef struct il_place {
    uint32_t ring, vertex;
    double t;
} il_place;

/* Negative, 0 or positive: by ring, then vertex, then t. */
int il_place_compare(const il_place *a, const il_place *b);

/* phi of the upper slice's point at PLACE, in the stack's unit. */
typedef struct il_phi_point {
    il_place at;
    double x, y;
} il_phi_point;

/* From FROM to TO along the ring's direction; FROM equal to TO is the whole ring. */
typedef struct il_arc { il_place from, to; } il_arc;

/* The arcs correspond, ends to ends; residual: distance of phi(upper arc) from
 * the lower arc, mean and largest, in the stack's unit.  as_they_lie: without
 * phi, of a group whose phi is not trusted. */
typedef struct il_match {
    il_arc lower, upper;
    double residual_mean, residual_max;
    bool as_they_lie;
} il_match;

/* What an arc without a partner was taken for: the seam along which a region
 * parts, the end of a piece, the begin or end of a hole. */
typedef enum il_event { IL_EVENT_BRANCH, IL_EVENT_CAP, IL_EVENT_HOLE } il_event;

typedef struct il_unmatched {
    bool upper;              /* whose arc it is */
    il_arc arc;
    il_event event;
} il_unmatched;

/* A point that the surface needs on a contour edge, at (x, y) in its slice's
 * plane: near its place, for a point put between two doubles lies beside them. */
typedef struct il_insertion {
    bool upper;
    il_place at;
    double x, y;
} il_insertion;

/* The line along which the region of outer ring RING is cut, because it goes over into
 * several: n points xy[2*n], unit, along the medial axis between what it goes over into,
 * in the plane of its slice; it begins and ends on the region's outline or where other cuts end,
 * or runs round the midst of the region, last point as first. */
typedef struct il_cut {
    bool upper;              /* whose region it is */
    uint32_t ring;
    double *xy;              size_t n, cap;
} il_cut;

typedef enum il_matcher { IL_MATCHER_NONE, IL_MATCHER_FFD } il_matcher;

/* How a group of corresponding rings was settled: see design "attempts". */
typedef enum il_attempt { IL_ATTEMPT_S, IL_ATTEMPT_P, IL_ATTEMPT_B, IL_N_ATTEMPTS } il_attempt;

/* Why two rings belong together: their regions overlap, or the holes that they are
 * the outlines of; they overlap, but what goes from one to the other slants, in vessels;
 * they lie close; the link makes one of two parts that nothing else holds together;
 * a hole and the ring whose outside it opens to; the user says so. */
typedef enum il_link_reason {
    IL_LINK_OVERLAP, IL_LINK_SLANT, IL_LINK_NEAR, IL_LINK_JOIN, IL_LINK_OPENING, IL_LINK_GIVEN, IL_N_LINK_REASONS
} il_link_reason;

/* "overlap", "slant", "near", "join", "opening", "given". */
const char *il_link_reason_word(il_link_reason why);

/* reach: distance of the outlines as they lie, unit. */
typedef struct il_link {
    uint32_t lower, upper;
    il_link_reason reason;
    double reach;
} il_link;

/* One step of a deformation: nx by ny nodes, spacing apart, node (0, 0) at
 * (x, y); d[2*n], n = nx * ny: the nodes' displacements, i running first. */
typedef struct il_lattice {
    uint32_t nx, ny;
    double x, y, spacing;
    double *d;               size_t n, cap;
} il_lattice;

/* How phi came out for one group.  Residuals: distance of phi(upper) from
 * lower, and of lower from phi(upper), unit.  least_jacobian > 0 when phi is
 * one-to-one; distortion: root mean square of the log stretch.  steps: lattice
 * steps that phi is composed of, after the global one, which takes (x, y) to
 * (g0 x + g1 y + g4, g2 x + g3 y + g5).  box: least x and y, greatest x and y,
 * of the padded box in the lower plane; at its corners the inverse of phi is
 * that of the global step.  lattice[]: the steps themselves, or none. */
typedef struct il_fit {
    double residual_up_mean, residual_up_max;
    double residual_down_mean, residual_down_max;
    double least_jacobian, distortion;
    uint32_t steps;
    double global[6], box[4];
    il_lattice *lattice;     size_t n_lattices, cap_lattices;
} il_fit;

/* Rings that belong together, as indices into the two slices; owned.  fitted:
 * fit says something (matcher FFD, rings on both sides). */
typedef struct il_group {
    uint32_t *lower, *upper;
    size_t n_lower, n_upper, cap_lower, cap_upper;
    il_link *link;           size_t n_links, cap_links;
    bool fitted;
    il_fit fit;
} il_group;

/* matcher NONE: phi is the identity and phi[] is empty.  Otherwise phi[] has a
 * point for every vertex of the upper slice and more where an edge bends, in
 * order of place.  Rings in no group are groups of their own; no group at all
 * (n_groups 0) means that all rings form one.
 * linked: groups and links are known, and all else is still to be found.
 * gap: nothing joins the two slices, each is closed where it lies; then there is
 * nothing else to say but private lines. */
typedef struct il_pair {
    bool gap, linked;
    il_matcher matcher;
    il_group *group;          size_t n_groups, cap_groups;
    il_phi_point *phi;        size_t n_phi, cap_phi;
    il_match *match;          size_t n_matches, cap_matches;
    il_unmatched *unmatched;  size_t n_unmatched, cap_unmatched;
    il_insertion *insertion;  size_t n_insertions, cap_insertions;
    il_cut *cut;              size_t n_cuts, cap_cuts;
    long line;
    il_extra *extra;
} il_pair;

#define IL_PAIR_INIT { 0 }
void il_pair_free(il_pair *p);
/* Whatever P said, now it is a gap; line and private lines stay. */
void il_pair_make_gap(il_pair *p);
void il_fit_free(il_fit *f);          /* with its lattices; all zero afterwards */
/* May the surface follow phi?  A small residual does not tell: a map that had to
 * stretch the rings unevenly, or to squeeze the plane beside them, takes what has
 * no partner for something else.  Bounds for the distortion, without and with a
 * global step, and for the least Jacobian over that of the global step, measured
 * on sliced solids: beyond them the slices as they lie are the better guide.
 * They are a poorer one where a global step was needed, unless it is one that
 * changes areas more than IL_GROWTH_MOST times: then something ends or opens. */
#define IL_DISTORTION_MOST 0.2
#define IL_DISTORTION_MOST_MOVED 0.4
#define IL_GROWTH_MOST 2.5
#define IL_SQUEEZE_MOST 0.25
bool il_fit_is_trusted(const il_fit *f);

/* Do the regions of G lie beside each other?  None of them on another; or one slants, or the
 * user joined some that are apart.  As the slices lie they are not one piece, or by a neck
 * that is none; so the surface follows phi, whatever it had to do.  Where a body goes on
 * upright with a twig beside it, it does not: on solids that are no vessels the body's
 * surface got worse by up to 40 %. */
bool il_group_lies_apart(const il_group *g);

/* Either, or a fit that is trusted. */
bool il_group_is_trusted(const il_group *g);
void il_fit_drop_lattices(il_fit *f); /* they alone; `steps` still says how many */

/* Does P name rings or places?  If not, it holds for any two slices. */
bool il_pair_names_rings(const il_pair *p);

#endif
