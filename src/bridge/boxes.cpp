/* boxes.cpp - bridge/boxes.h on CGAL's box intersection. */
#include "config.h"
#include "bridge/guard.h"
#include "bridge/boxes.h"
extern "C" {
#include "base/alloc.h"
}

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

typedef CGAL::Box_intersection_d::Box_with_info_d<double, 2, uint32_t> Box;
typedef CGAL::Box_intersection_d::Box_traits_d<Box> Traits; /* closed boxes by default */
typedef std::vector<std::pair<uint32_t, uint32_t>> Pairs;

namespace {
struct TooMany {};
}

/* Below this many boxes CGAL scans along one axis instead of dividing, which
 * suits contour edges: they are short and meet few others in a scan. */
static const std::ptrdiff_t SCAN_BELOW = 2000;

static std::vector<Box> boxes_of(const double *box, size_t n)
{
    std::vector<Box> boxes;
    boxes.reserve(n);
    for (size_t i = 0; i < n; i++)
        boxes.emplace_back(CGAL::Bbox_2(box[4 * i], box[4 * i + 1], box[4 * i + 2], box[4 * i + 3]), uint32_t(i));
    return boxes;
}

static il_status hand_over(Pairs &found, uint32_t **pair, size_t *n_pairs, il_error *err)
{
    std::sort(found.begin(), found.end());
    *pair = static_cast<uint32_t *>(il_alloc(2 * found.size(), sizeof **pair));
    if (!*pair)
        return il_fail_nomem(err);
    for (size_t i = 0; i < found.size(); i++)
        (*pair)[2 * i] = found[i].first, (*pair)[2 * i + 1] = found[i].second;
    *n_pairs = found.size();
    return IL_OK;
}

template <class Search>
static il_status collect(size_t limit, uint32_t **pair, size_t *n_pairs, il_error *err, Search &&search)
{
    *pair = nullptr;
    *n_pairs = 0;
    return guarded(err, [&] {
        Pairs found;
        try {
            search([&](uint32_t i, uint32_t j) {
                if (found.size() >= limit)
                    throw TooMany();
                found.emplace_back(i, j);
            });
        } catch (const TooMany &) {
            return il_fail(err, IL_E_INPUT, 0, "more than %zu pairs of edges meet or nearly meet", limit);
        }
        return hand_over(found, pair, n_pairs, err);
    });
}

il_status il_box_pairs(const double *box, size_t n, size_t limit,
                       uint32_t **pair, size_t *n_pairs, il_error *err)
{
    return collect(limit, pair, n_pairs, err, [&](auto &&add) {
        std::vector<Box> boxes = boxes_of(box, n);
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
            [&](const Box &a, const Box &b) { add(std::min(a.info(), b.info()), std::max(a.info(), b.info())); },
            Traits(), SCAN_BELOW);
    });
}

il_status il_box_pairs_between(const double *a, size_t n_a, const double *b, size_t n_b, size_t limit,
                               uint32_t **pair, size_t *n_pairs, il_error *err)
{
    return collect(limit, pair, n_pairs, err, [&](auto &&add) {
        std::vector<Box> boxes_a = boxes_of(a, n_a), boxes_b = boxes_of(b, n_b);
        CGAL::box_intersection_d(boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(),
            [&](const Box &p, const Box &q) { add(p.info(), q.info()); },
            Traits(), SCAN_BELOW);
    });
}
