// How far some points are from a link's mesh, and the nearest points of it.
#if defined(BERTH_MESH_NEAREST_POINT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_NEAREST_POINT_INL_HPP
#undef BERTH_MESH_NEAREST_POINT_INL_HPP
#else
#define BERTH_MESH_NEAREST_POINT_INL_HPP
#endif

#include <algorithm>

#include "berth/distance/convex_pair.hpp"
#include "berth/distance/patches-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// lower_m <= true distance <= upper_m, that of the point and one of `triangle`.
struct MeshDistance {
  float lower_m = HUGE_VALF;
  float upper_m = HUGE_VALF;
  int triangle = -1;
};

/// Some points near each other and their distances, in the link's own frame L.
struct NearPoints {
  static constexpr int kMost = 8;
  int count = 0;
  Eigen::Vector3f p_L_m[kMost];
  MeshDistance distance[kMost];
};

/// Goes through a link's patches for all points at once, so that the processor has several of
/// them to work on, the nearest patches first.
class NearestPointSearch {
 public:
  /// error_m: what the roundings of a distance may add up to.
  NearestPointSearch(const LinkPatches& link, float error_m) : link_(link), error_m_(error_m) {}

  /// Begins with the triangles of the leaf `hint`. The distances' bounds are at most `slack_m` and
  /// some roundings apart. Without slack they are the same for any hint, and beside any other
  /// points: the least of all triangles, whose roundings are their own.
  void find(int hint, float slack_m, NearPoints& points) const {
    Query query{slack_m, hint, points, {}};
    const std::uint32_t all = (1u << points.count) - 1;
    visit_leaf(query, hint, all);
    const int top = static_cast<int>(link_.levels.size()) - 1;
    if (top > 0) visit_patch(query, top, 0, all);
    for (int i = 0; i < points.count; ++i) {
      const Found& found = query.found[i];
      const float upper_m = std::sqrt(found.upper2_m2);
      const float lower_m = std::min(std::sqrt(found.skipped2_m2), upper_m);
      points.distance[i] = {std::max(lower_m - error_m_, 0.0f), upper_m + error_m_,
                            std::min(found.triangle, link_.triangle_count - 1)};
    }
  }

  /// The point of a leaf's triangles that is nearest to p, but for roundings.
  Eigen::Vector3f nearest_of_leaf(int leaf, const Eigen::Vector3f& p_L_m) const {
    NearestPoint nearest{p_L_m};
    const Vectors p = broadcast(p_L_m);
    for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
      nearest.take(p, nearest_in(load_leaf(first), p));
    }
    return nearest.point_m;
  }

 private:
  static constexpr int kChildren = LinkPatches::kChildren;

  /// Squares of distances: of the nearest point so far, of the one that is nearer than that by more
  /// than the slack, and of the nearest patch that was not gone into.
  struct Found {
    float upper2_m2 = HUGE_VALF;
    float wanted2_m2 = HUGE_VALF;
    float skipped2_m2 = HUGE_VALF;
    int triangle = -1;
  };

  struct Query {
    float slack_m;
    int visited_leaf;
    NearPoints& points;
    Found found[NearPoints::kMost];

    void take(int point, float squared_m2, int triangle) {
      const float wanted_m = std::max(std::sqrt(squared_m2) - slack_m, 0.0f);
      found[point].upper2_m2 = squared_m2;
      found[point].wanted2_m2 = slack_m > 0 ? wanted_m * wanted_m : squared_m2;
      found[point].triangle = triangle;
    }
  };

  void visit_patch(Query& query, int level, int index, std::uint32_t which) const {
    const PatchLevel& children = link_.levels[level - 1];
    const int begin = kChildren * index;
    const int count = std::min(kChildren, children.count - begin);
    alignas(64) float bound2_m2[NearPoints::kMost][kChildren];
    alignas(64) float least2_m2[kChildren];
    // The children that are near to some point, the nearest first.
    int order[kChildren];
    int ordered = 0;
    for (int first = 0; first < count; first += kLanes) {
      const Hulls hulls = load_hulls(children, begin + first);
      Lanes least_bound(HUGE_VALF);
      std::uint64_t near = 0;
      for (std::uint32_t left = which; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const Lanes bound = squared_distance_to(hulls, broadcast(query.points.p_L_m[i]));
        store(bound, bound2_m2[i] + first);
        least_bound = least(least_bound, bound);
        near |= bits_of(bound < Lanes(query.found[i].upper2_m2));
      }
      store(least_bound, least2_m2 + first);
      for (near &= (std::uint64_t{1} << (count - first)) - 1; near != 0; near &= near - 1) {
        const int child = first + __builtin_ctzll(near);
        int place = ordered++;
        for (; place > 0 && least2_m2[order[place - 1]] > least2_m2[child]; --place) {
          order[place] = order[place - 1];
        }
        order[place] = child;
      }
    }
    for (int k = 0; k < ordered; ++k) {
      std::uint32_t wanted = 0;
      for (std::uint32_t left = which; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const float bound = bound2_m2[i][order[k]];
        if (bound < query.found[i].wanted2_m2) {
          wanted |= 1u << i;
        } else {
          query.found[i].skipped2_m2 = std::min(query.found[i].skipped2_m2, bound);
        }
      }
      if (wanted == 0) continue;
      const int child = begin + order[k];
      if (level > 1) {
        visit_patch(query, level - 1, child, wanted);
      } else if (child != query.visited_leaf) {
        visit_leaf(query, child, wanted);
      }
    }
  }

  /// The boxes of some patches.
  struct Hulls {
    Vectors centre, x, y, z;
    Lanes half_x, half_y, half_z;
  };

  static HWY_INLINE Vectors broadcast(const Eigen::Vector3f& p) {
    return {Lanes(p.x()), Lanes(p.y()), Lanes(p.z())};
  }

  HWY_INLINE Hulls load_hulls(const PatchLevel& level, int first) const {
    const auto at = [&](const std::vector<float>& values)
                        HWY_ATTR { return load(values.data() + first); };
    const auto vectors = [&](const std::array<std::vector<float>, 3>& v) HWY_ATTR {
      return Vectors{at(v[0]), at(v[1]), at(v[2])};
    };
    // Larger by what the distance's roundings may hide.
    const Lanes error(error_m_);
    return {vectors(level.centre_m),
            vectors(level.x),
            vectors(level.y),
            vectors(level.axis),
            at(level.half_x_m) + error,
            at(level.half_y_m) + error,
            at(level.half_height_m) + error};
  }

  HWY_INLINE Lanes squared_distance_to(const Hulls& hulls, const Vectors& p) const {
    const Vectors v = p - hulls.centre;
    const Lanes zero(0.0f);
    const Lanes x = greatest(abs(dot(v, hulls.x)) - hulls.half_x, zero);
    const Lanes y = greatest(abs(dot(v, hulls.y)) - hulls.half_y, zero);
    const Lanes z = greatest(abs(dot(v, hulls.z)) - hulls.half_z, zero);
    return mul_add(x, x, mul_add(y, y, z * z));
  }

  HWY_INLINE Triangles load_leaf(int first) const {
    const auto at = [&](int k) HWY_ATTR { return load(link_.corners_m[k].data() + first); };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}};
  }

  HWY_INLINE void visit_leaf(Query& query, int leaf, std::uint32_t which) const {
    for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
      const Triangles t = load_leaf(first);
      for (std::uint32_t left = which; left != 0; left &= left - 1) {
        visit_triangles(query, t, first, __builtin_ctz(left));
      }
    }
  }

  HWY_INLINE void visit_triangles(Query& query, const Triangles& t, int first, int point) const {
    // A plane through the nearest point of a triangle has all of it behind it. Of a needle,
    // roundings may give another point than the nearest one; then it has not.
    constexpr float kBehind = 1 - 4e-6f;
    Found& found = query.found[point];
    const Vectors p = broadcast(query.points.p_L_m[point]);
    const Vectors v = p - nearest_in(t, p);
    const Lanes length2 = dot(v, v);
    const Lanes behind = least(dot(p - t.a, v), least(dot(p - t.b, v), dot(p - t.c, v)));
    const float least2_m2 = least_lane(length2);
    if (least2_m2 < found.upper2_m2) {
      query.take(point, least2_m2, first + __builtin_ctzll(bits_of(length2 <= Lanes(least2_m2))));
    }
    std::uint64_t open = bits_of(behind < length2 * Lanes(kBehind));
    if (open == 0) return;
    const Lanes length = root(length2);
    open &= bits_of(behind < length2 * Lanes(kBehind) - length * Lanes(0.25f * error_m_));
    // Whose plane is beyond what is known need not be looked at.
    const float upper_m = std::sqrt(found.upper2_m2);
    open &= bits_of(behind * Lanes(kBehind) < length * Lanes(upper_m));
    for (; open != 0; open &= open - 1) {
      visit_triangle(query, first + __builtin_ctzll(open), point);
    }
  }

  /// In doubles.
  void visit_triangle(Query& query, int triangle, int point) const {
    Eigen::Vector3d corners_m[3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) corners_m[i][k] = link_.corners_m[3 * i + k][triangle];
    }
    const Eigen::Vector3d p_m = query.points.p_L_m[point].cast<double>();
    const auto distance_m = static_cast<float>(closest_points(corners_m, {&p_m, 1}).distance_m);
    if (distance_m * distance_m < query.found[point].upper2_m2) {
      query.take(point, distance_m * distance_m, triangle);
    }
  }

  const LinkPatches& link_;
  float error_m_;
};

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
