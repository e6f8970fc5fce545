// The 16 triangles of a patch against one convex body.
#if defined(BERTH_MESH_LEAF_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_LEAF_INL_HPP
#undef BERTH_MESH_LEAF_INL_HPP
#else
#define BERTH_MESH_LEAF_INL_HPP
#endif

#include "berth/distance/link_search.hpp"
#include "berth/distance/patches-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// Where something is searched for: X_FL, and what the roundings of a distance there may add up to.
struct SearchFrame {
  Pose X_FL;
  Motion motion;
  float error_m;
};

/// For points up to `reach_m` from the origins of both frames: a point is moved with four
/// roundings, a bound adds three products of two.
inline float rounding_m(float reach_m) {
  return 16 * std::numeric_limits<float>::epsilon() * reach_m;
}
HWY_INLINE SearchFrame make_frame(const Pose& X_FL, float reach_m) {
  return {X_FL, motion_of(X_FL), rounding_m(reach_m)};
}

/// One triangle against a body in doubles; returns how near it does not come.
template <class Found>
float search_pair(LinkSearch& search, const Pose& X_FL, int triangle, float error_m,
                  const Eigen::Vector3d (&body_corners_m)[8], Found found) {
  const ConvexPair pair = triangle_pair(search, X_FL, triangle, body_corners_m);
  const float distance_m = static_cast<float>(pair.distance_m) + error_m;
  const float lower_m = static_cast<float>(pair.distance_m) - error_m;
  if (!(distance_m < search.best_m)) return lower_m;
  search.best_m = distance_m;
  search.best_triangle = std::min(triangle, search.link->triangle_count - 1);
  found(Eigen::Vector3f(pair.b_m.cast<float>()));
  return lower_m;
}

/// The direction from a body to the triangle that came nearest to it.
struct Heading {
  float x = 0, y = 0, z = 0;
};

HWY_INLINE Vectors broadcast(const Heading& n) { return {Lanes(n.x), Lanes(n.y), Lanes(n.z)}; }

/// What came of a leaf's triangles against a body: the direction from where they came nearest, and
/// how near none of them comes.
struct LeafFound {
  Heading heading;
  float lower_m = HUGE_VALF;
};

/// The least n . v of all points of a leaf's triangles.
HWY_INLINE float least_along(const LinkSearch& search, const SearchFrame& frame, int leaf,
                             const Heading& n) {
  Lanes along(HUGE_VALF);
  for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
    const Triangles t = load_triangles(*search.link, first, frame.motion);
    along = least(along, least_along(t, broadcast(n)));
  }
  return least_lane(along);
}

/// Searches the triangles of leaf `index` against a body, the same in all lanes, by going to and
/// fro between nearest points; each pair on the way gives a plane that bounds the distance from
/// below. Pairs for which that does not end the search are left to closest_points(). Calls
/// found(triangle, distance, point of the body) for each pair that is better than the best.
template <class Bodies, class Found>
HWY_INLINE LeafFound search_leaf(LinkSearch& search, const SearchFrame& frame, int index,
                                 const Bodies& body, const Eigen::Vector3d (&body_corners_m)[8],
                                 Found found) {
  constexpr int kRounds = 4;
  const Lanes third(1.0f / 3);
  LeafFound leaf;
  float heading_m = HUGE_VALF;
  for (int first = 16 * index; first < 16 * (index + 1); first += kLanes) {
    const Triangles t = load_triangles(*search.link, first, frame.motion);
    Vectors p{third * (t.a.x + t.b.x + t.c.x), third * (t.a.y + t.b.y + t.c.y),
              third * (t.a.z + t.b.z + t.c.z)};
    Vectors q = nearest_in<3>(body, p);
    Lanes lower(0.0f);
    std::uint32_t open = 0;
    for (int round = 0; round < kRounds; ++round) {
      p = nearest_in(t, q);
      q = nearest_in<3>(body, p);
      const Direction to = direction(p, q);
      lower = greatest(lower, least_along(t, to.n) - reach_of(body, to.n) - Lanes(frame.error_m));
      const float least_m = least_lane(to.length);
      if (least_m < heading_m) {
        heading_m = least_m;
        const int lane = __builtin_ctz(bits_of(to.length <= Lanes(least_m)));
        alignas(64) float n[3][kLanes];
        store(to.n.x, n[0]);
        store(to.n.y, n[1]);
        store(to.n.z, n[2]);
        leaf.heading = {n[0][lane], n[1][lane], n[2][lane]};
      }
      if (least_m + frame.error_m < search.best_m) {
        const std::uint32_t bits = bits_of(to.length <= Lanes(least_m));
        alignas(64) float x[kLanes], y[kLanes], z[kLanes];
        store(q.x, x);
        store(q.y, y);
        store(q.z, z);
        const int lane = __builtin_ctz(bits);
        search.best_m = least_m + frame.error_m;
        search.best_triangle = std::min(first + lane, search.link->triangle_count - 1);
        found(Eigen::Vector3f(x[lane], y[lane], z[lane]));
      }
      open = bits_of(lower < Lanes(search.limit_m()));
      if (open == 0) break;
    }
    alignas(64) float lower_m[kLanes];
    store(lower, lower_m);
    for (; open != 0; open &= open - 1) {
      const int lane = __builtin_ctz(open);
      lower_m[lane] = std::max(lower_m[lane], search_pair(search, frame.X_FL, first + lane,
                                                          frame.error_m, body_corners_m, found));
    }
    leaf.lower_m = std::min(leaf.lower_m, least_lane(load(lower_m)));
  }
  return leaf;
}

/// Makes `children` of an item, all with bounds below the limit, wait their turn; the best of them
/// is searched on at once while nothing else is known, or where nothing is more promising.
struct Fresh {
  Item items[128];
  int count = 0;
  /// The item itself has its turn again, with the bound that it has now.
  bool again = false;
  void add(float bound_m, std::uint32_t patch, std::uint64_t space) {
    items[count++] = {bound_m > 0 ? bound_m : 0, patch, space};
  }
};

/// An item that is being taken apart: those children whose bounds are below the limit leave it, and
/// the rest bound it.
struct Parting {
  Item& item;
  float limit_m;
  float least_left_m = HUGE_VALF;

  /// Children first to first + kLanes - 1, of which there are those that are `valid`.
  template <class Add>
  HWY_INLINE void part(Lanes bound, int first, std::uint32_t valid, Add add) {
    constexpr std::uint64_t kAll = kLanes >= 64 ? ~0ull : (1ull << kLanes) - 1;
    const std::uint32_t there = valid & static_cast<std::uint32_t>(item.left >> first & kAll);
    std::uint32_t below = bits_of(bound < Lanes(limit_m)) & there;
    item.left &= ~((kAll & ~static_cast<std::uint64_t>(there & ~below)) << first);
    if (there == 0) return;
    alignas(64) float bound_m[kLanes];
    store(bound, bound_m);
    for (std::uint32_t rest = there & ~below; rest != 0; rest &= rest - 1)
      least_left_m = std::min(least_left_m, bound_m[__builtin_ctz(rest)]);
    for (; below != 0; below &= below - 1) {
      const int lane = __builtin_ctz(below);
      add(lane, bound_m[lane]);
    }
  }
  /// There are `count` children.
  HWY_INLINE void end(int count) {
    if (count < 64) item.left &= (std::uint64_t{1} << count) - 1;
    item.bound_m = std::max(item.bound_m, least_left_m);
  }
};

/// Makes the children of an item's patch fresh that may be near enough to a body.
template <class Bodies>
HWY_INLINE void part_patch(const LinkSearch& search, const SearchFrame& frame, Item& item,
                           const Bodies& body, Fresh& fresh) {
  const int below = level_of(item.patch) - 1;
  const PatchLevel& level = search.link->levels[below];
  const int begin = 16 * index_of(item.patch);
  Parting parting{item, search.limit_m()};
  const int count = std::min(16, level.count - begin);
  for (int i = 0; i < count; i += kLanes) {
    const Lanes bound =
        patch_bound(load_patches(level, begin + i, frame.motion), body) - Lanes(frame.error_m);
    const int left = count - i;
    const std::uint32_t valid = left >= 32 ? ~0u : (1u << left) - 1;
    parting.part(bound, i, valid, [&](int lane, float bound_m) {
      fresh.add(bound_m, patch_of(below, begin + i + lane), item.space);
    });
  }
  parting.end(16);
}

/// Takes items until the search is done, at most `steps`. expand(item, fresh) leaves in the item
/// what did not become fresh, with a bound that holds for it.
template <class Expand>
HWY_INLINE void search_best_first(LinkSearch& search, int steps, Expand expand) {
  bool has_next = false;
  Item next{};
  // Outside, since making its items takes as long as taking one apart.
  Fresh fresh;
  for (; steps > 0; --steps) {
    if (!has_next) {
      if (search.is_done()) return;
      next = search.items.pop();
    }
    fresh.count = 0;
    fresh.again = false;
    expand(next, fresh);
    if (fresh.again) {
      search.items.push(next);
    } else if (next.left != 0) {
      search.put_aside(next);
    }
    int best = -1;
    for (int i = 0; i < fresh.count; ++i) {
      if (best < 0 || fresh.items[i].bound_m < fresh.items[best].bound_m) best = i;
    }
    has_next = best >= 0 && fresh.items[best].bound_m < search.limit_m() &&
               (!search.is_known() || fresh.items[best].bound_m <= search.items.least_bound_m());
    for (int i = 0; i < fresh.count; ++i) {
      if (i == best && has_next) continue;
      if (fresh.items[i].bound_m < search.limit_m()) {
        search.items.push(fresh.items[i]);
      } else {
        search.put_aside(fresh.items[i]);
      }
    }
    if (has_next) next = fresh.items[best];
  }
  if (has_next) search.items.push(next);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
