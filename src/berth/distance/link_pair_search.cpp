#include "berth/distance/body_pair.hpp"

#include <algorithm>
#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/link_pair_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/leaf-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// Children so little beyond the limit leave their item as well, which else had to be taken apart
/// again by each of the next requests.
constexpr float kApart_m = 0.003f;

/// Patches, each the part that its cylinder and its box have in common; z is the axis of both.
struct Pieces {
  Vectors centre, x, y, z;
  Lanes half_x, half_y, half_z, radius;
};

template <class Lane>
HWY_INLINE Pieces pieces_of(const PatchLevel& level, const Motion& X, Lane at) {
  const auto vectors = [&](const std::array<std::vector<float>, 3>& v) HWY_ATTR {
    return Vectors{at(v[0]), at(v[1]), at(v[2])};
  };
  return {
      moved(X, vectors(level.centre_m)), turned(X, vectors(level.x)), turned(X, vectors(level.y)),
      turned(X, vectors(level.axis)),    at(level.half_x_m),          at(level.half_y_m),
      at(level.half_height_m),           at(level.radius_m)};
}

HWY_INLINE Pieces load_pieces(const PatchLevel& level, int first, const Motion& X) {
  return pieces_of(level, X, [first](const std::vector<float>& values) HWY_ATTR {
    return load(values.data() + first);
  });
}

/// The same patch in every lane.
HWY_INLINE Pieces broadcast_piece(const PatchLevel& level, int index, const Motion& X) {
  return pieces_of(level, X, [index](const std::vector<float>& values) HWY_ATTR {
    return Lanes(values[static_cast<std::size_t>(index)]);
  });
}

/// Of the box alone.
template <int steps>
HWY_INLINE Vectors nearest_in(const Pieces& c, const Vectors& p) {
  const Vectors v = p - c.centre;
  const Lanes x = clamp(dot(v, c.x), -c.half_x, c.half_x);
  const Lanes y = clamp(dot(v, c.y), -c.half_y, c.half_y);
  const Lanes z = clamp(dot(v, c.z), -c.half_z, c.half_z);
  return mul_add(x, c.x, mul_add(y, c.y, mul_add(z, c.z, c.centre)));
}
/// How far it reaches from its centre along n, and along -n.
HWY_INLINE Lanes extent_along(const Pieces& c, const Vectors& n) {
  const Lanes along = abs(dot(c.z, n));
  const Lanes across = root(greatest(dot(n, n) - along * along, Lanes(0.0f)));
  const Lanes box = c.half_x * abs(dot(c.x, n)) + c.half_y * abs(dot(c.y, n));
  return mul_add(c.half_z, along, least(box, c.radius * across));
}
HWY_INLINE Lanes reach_of(const Pieces& c, const Vectors& n) {
  return dot(c.centre, n) + extent_along(c, n);
}

template <int steps>
HWY_INLINE Vectors nearest_in(const Triangles& t, const Vectors& p) {
  return nearest_in(t, p);
}
HWY_INLINE Lanes reach_of(const Triangles& t, const Vectors& n) {
  return greatest(dot(t.a, n), greatest(dot(t.b, n), dot(t.c, n)));
}

/// No point of the piece is nearer to the body than this, since a plane across n lies between them.
/// The roundings are not paid for.
template <class Bodies>
HWY_INLINE Lanes bound_along(const Pieces& piece, const Bodies& body, const Vectors& n) {
  return dot(piece.centre, n) - extent_along(piece, n) - reach_of(body, n);
}

HWY_INLINE Vectors centre_of(const Pieces& c) { return c.centre; }
HWY_INLINE Vectors centre_of(const Triangles& t) {
  const Lanes third(1.0f / 3);
  return {third * (t.a.x + t.b.x + t.c.x), third * (t.a.y + t.b.y + t.c.y),
          third * (t.a.z + t.b.z + t.c.z)};
}

/// From where a body is nearest to the piece, about; where they meet, between their middles: the
/// deeper they do, the less is the bound, and the sooner they are looked at.
template <class Bodies>
HWY_INLINE Vectors heading_of(const Pieces& piece, const Bodies& body) {
  Vectors q = nearest_in<1>(body, piece.centre);
  const Vectors p = nearest_in<1>(piece, q);
  q = nearest_in<1>(body, p);
  const Direction to = direction(p, q);
  const Direction between = direction(piece.centre, centre_of(body));
  return select(to.length > Lanes(1e-6f), to.n, between.n);
}

/// The other link's part of a search.
struct PairSearch {
  LinkSearch& link;
  const LinkPatches& other;
  SearchFrame frame;
  Motion rest;
  /// From the other link's point of the best pair to that of the link: most pieces around both
  /// have a plane across it between them. Zero while there is no pair.
  Heading best;
};

template <class Bodies>
HWY_INLINE Lanes piece_bound(const PairSearch& search, const Pieces& piece, const Bodies& body) {
  return greatest(bound_along(piece, body, heading_of(piece, body)),
                  bound_along(piece, body, broadcast(search.best))) -
         Lanes(search.frame.error_m);
}

HWY_INLINE std::uint32_t valid_of(int left) { return left >= 32 ? ~0u : (1u << left) - 1; }

/// Makes the children of the link's patch fresh that may be near enough to a body.
HWY_INLINE void part_own(const PairSearch& search, Item& item, const Pieces& body, Fresh& fresh) {
  const int below = level_of(item.patch) - 1;
  const PatchLevel& level = search.link.link->levels[static_cast<std::size_t>(below)];
  const int begin = 16 * index_of(item.patch);
  Parting parting{item, search.link.limit_m() + kApart_m};
  const int count = std::min(16, level.count - begin);
  for (int i = 0; i < count; i += kLanes) {
    const Lanes bound =
        piece_bound(search, load_pieces(level, begin + i, search.frame.motion), body);
    parting.part(bound, i, valid_of(count - i), [&](int lane, float bound_m) {
      fresh.items[fresh.count++] = {bound_m, patch_of(below, begin + i + lane), item.space};
    });
  }
  parting.end(16);
}

/// The same for the children of the other link's patch.
HWY_INLINE void part_other(const PairSearch& search, Item& item, std::uint32_t patch,
                           Fresh& fresh) {
  const int below = level_of(patch) - 1;
  const PatchLevel& level = search.other.levels[static_cast<std::size_t>(below)];
  const int begin = 16 * index_of(patch);
  const Pieces own =
      broadcast_piece(search.link.link->levels[static_cast<std::size_t>(level_of(item.patch))],
                      index_of(item.patch), search.frame.motion);
  Parting parting{item, search.link.limit_m() + kApart_m};
  const int count = std::min(16, level.count - begin);
  for (int i = 0; i < count; i += kLanes) {
    const Lanes bound = piece_bound(search, own, load_pieces(level, begin + i, search.rest));
    parting.part(bound, i, valid_of(count - i), [&](int lane, float bound_m) {
      fresh.items[fresh.count++] = {bound_m, item.patch, patch_of(below, begin + i + lane)};
    });
  }
  parting.end(16);
}

HWY_INLINE Triangles broadcast_triangle(const LinkPatches& link, int index) {
  const auto at = [&](std::size_t k) HWY_ATTR {
    return Lanes(link.corners_m[k][static_cast<std::size_t>(index)]);
  };
  return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}};
}

/// The triangles of one of the link's leaves against one of the other link.
HWY_INLINE float search_triangle(PairSearch& search, int leaf, int triangle) {
  Eigen::Vector3d corners_m[8];
  for (std::size_t i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) {
      corners_m[i][k] =
          search.other.corners_m[3 * std::min<std::size_t>(i, 2) + static_cast<std::size_t>(k)]
                                [static_cast<std::size_t>(triangle)];
    }
  }
  const float before_m = search.link.best_m;
  const LeafFound found =
      search_leaf(search.link, search.frame, leaf, broadcast_triangle(search.other, triangle),
                  corners_m, [&](const Eigen::Vector3f&) {
                    search.link.best_pixel = static_cast<std::uint64_t>(triangle);
                  });
  if (search.link.best_m < before_m) search.best = found.heading;
  return found.lower_m;
}

HWY_INLINE Heading first_lane(const Vectors& n) {
  return {hn::GetLane(n.x.v), hn::GetLane(n.y.v), hn::GetLane(n.z.v)};
}

/// In an item's `way`; 0 is none.
HWY_INLINE std::uint32_t packed(const Heading& n) {
  const auto ten_bits = [](float x) { return static_cast<std::uint32_t>(512.5f + 511 * x); };
  return ten_bits(n.x) << 20 | ten_bits(n.y) << 10 | ten_bits(n.z);
}
HWY_INLINE Heading unpacked(std::uint32_t way) {
  const auto part = [](std::uint32_t bits) { return static_cast<float>(bits & 1023) - 512; };
  const float x = part(way >> 20), y = part(way >> 10), z = part(way);
  // No longer than 1.
  const float scale = (1 - 1e-6f) / std::max(std::sqrt(x * x + y * y + z * z), 1.0f);
  return {scale * x, scale * y, scale * z};
}

/// How near two leaves do not come, by a plane across n: those of a curved surface are nearly a
/// plane, and their patches' boxes stand out from it.
HWY_INLINE float leaf_bound(const PairSearch& search, int own, int other, const Heading& n) {
  Lanes reach(-HUGE_VALF);
  for (int first = 16 * other; first < 16 * (other + 1); first += kLanes) {
    reach =
        greatest(reach, reach_of(load_triangles(search.other, first, search.rest), broadcast(n)));
  }
  return least_along(search.link, search.frame, own, n) - greatest_lane(reach) -
         search.frame.error_m;
}

/// The point of a leaf's triangles that is nearest to p, but for roundings.
HWY_INLINE Eigen::Vector3f nearest_of_leaf(const LinkPatches& link, const Motion& X, int leaf,
                                           const Eigen::Vector3f& p_m) {
  NearestPoint nearest{p_m};
  const Vectors p{Lanes(p_m.x()), Lanes(p_m.y()), Lanes(p_m.z())};
  for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
    nearest.take(p, nearest_in(load_triangles(link, first, X), p));
  }
  return nearest.point_m;
}

/// The direction between two leaves' nearest points, by going from one to the other and back.
HWY_INLINE Heading find_heading(const PairSearch& search, int own, int other) {
  const PatchLevel& level = search.other.levels[0];
  const auto at = static_cast<std::size_t>(other);
  Eigen::Vector3f q_m(level.centre_m[0][at], level.centre_m[1][at], level.centre_m[2][at]);
  Eigen::Vector3f p_m = q_m;
  for (int round = 0; round < 2; ++round) {
    p_m = nearest_of_leaf(*search.link.link, search.frame.motion, own, q_m);
    q_m = nearest_of_leaf(search.other, search.rest, other, p_m);
  }
  const Eigen::Vector3f way_m = p_m - q_m;
  const Eigen::Vector3f n = way_m / std::max(way_m.norm() * (1 + 1e-6f), 1e-12f);
  return {n.x(), n.y(), n.z()};
}

/// Two leaves: first by a plane between them, then each of the other link's triangles that may be
/// near enough.
void search_leaves(PairSearch& search, Item& item, int own, int other) {
  const Heading n = find_heading(search, own, other);
  item.way = packed(n);
  item.bound_m = std::max(item.bound_m, leaf_bound(search, own, other, n));
  if (item.bound_m >= search.link.limit_m()) return;
  const Lanes least(least_along(search.link, search.frame, own, n) - search.frame.error_m);
  const Pieces piece = broadcast_piece(search.link.link->levels[0], own, search.frame.motion);
  float lower_m = HUGE_VALF;
  for (int first = 16 * other; first < 16 * (other + 1); first += kLanes) {
    const Triangles t = load_triangles(search.other, first, search.rest);
    const Lanes bound = greatest(piece_bound(search, piece, t), least - reach_of(t, broadcast(n)));
    alignas(64) float bound_m[kLanes];
    store(bound, bound_m);
    for (int lane = 0; lane < kLanes && first + lane < search.other.triangle_count; ++lane) {
      if (bound_m[lane] < search.link.limit_m()) {
        bound_m[lane] = std::max(bound_m[lane], search_triangle(search, own, first + lane));
      }
      lower_m = std::min(lower_m, bound_m[lane]);
    }
  }
  item.bound_m = std::max(item.bound_m, lower_m);
}

HWY_INLINE float size_m(const LinkPatches& link, std::uint32_t patch) {
  const PatchLevel& level = link.levels[static_cast<std::size_t>(level_of(patch))];
  const auto index = static_cast<std::size_t>(index_of(patch));
  return std::max(level.half_height_m[index], level.radius_m[index]);
}

/// How an item is taken apart; once some of its children are gone, the rest stay of that kind.
enum PairWay : std::uint32_t { kBothWhole, kByOwn, kByOther };

void expand(PairSearch& search, Item& item, Fresh& fresh) {
  const auto other = static_cast<std::uint32_t>(item.space);
  const int own_level = level_of(item.patch);
  const int other_level = level_of(other);
  if (own_level == 0 && other_level == 0) {
    return search_leaves(search, item, index_of(item.patch), index_of(other));
  }
  if (item.way == kBothWhole) {
    const bool by_own =
        other_level == 0 ||
        (own_level > 0 && size_m(*search.link.link, item.patch) >= size_m(search.other, other));
    item.way = by_own ? kByOwn : kByOther;
  }
  if (item.way == kByOther) return part_other(search, item, other, fresh);
  part_own(search, item,
           broadcast_piece(search.other.levels[static_cast<std::size_t>(other_level)],
                           index_of(other), search.rest),
           fresh);
}

/// No point of the link is farther from the origin of its frame.
inline double reach_m(const LinkPatches& link) {
  const PatchLevel& top = link.levels.back();
  return Eigen::Vector3d(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]).norm() +
         top.half_height_m[0] + top.radius_m[0];
}

/// The least n . v of all of a link's points; only patches are taken apart that may have it.
float least_of_link(const LinkPatches& link, const Motion& X, const Heading& n) {
  constexpr int kMostOpen = 16 * 8;
  struct Open {
    float least_m;
    int level, index;
  };
  Open open[kMostOpen];
  int count = 0;
  float least_m = HUGE_VALF;
  open[count++] = {-HUGE_VALF, static_cast<int>(link.levels.size()) - 1, 0};
  while (count > 0) {
    const Open at = open[--count];
    if (at.least_m >= least_m) continue;
    if (at.level == 0) {
      Lanes along(HUGE_VALF);
      for (int first = 16 * at.index; first < 16 * (at.index + 1); first += kLanes) {
        along = least(along, least_along(load_triangles(link, first, X), broadcast(n)));
      }
      least_m = std::min(least_m, least_lane(along));
      continue;
    }
    const PatchLevel& level = link.levels[static_cast<std::size_t>(at.level - 1)];
    const int begin = 16 * at.index, children = std::min(16, level.count - begin);
    alignas(64) float bound_m[16];
    for (int i = 0; i < children; i += kLanes) {
      const Pieces pieces = load_pieces(level, begin + i, X);
      store(dot(pieces.centre, broadcast(n)) - extent_along(pieces, broadcast(n)), bound_m + i);
    }
    const int first = count;
    for (int i = 0; i < children; ++i) {
      if (bound_m[i] < least_m) open[count++] = {bound_m[i], at.level - 1, begin + i};
    }
    // The most promising one is next.
    std::sort(open + first, open + count,
              [](const Open& a, const Open& b) { return a.least_m > b.least_m; });
  }
  return least_m;
}

/// Nothing while there is no pair; no longer than 1.
inline Heading heading_of_best(const LinkSearch& link, const Pose& X_FL) {
  if (!link.is_known()) return {};
  const Eigen::Vector3d way_m = X_FL * link.robot_point_L_m - link.obstacle_point_B_m;
  const Eigen::Vector3f n = (way_m / std::max(way_m.norm() * (1 + 1e-6), 1e-12)).cast<float>();
  return {n.x(), n.y(), n.z()};
}

PairSearch make_pair_search(const LinkPatches& other, LinkSearch& link) {
  const double far_m = link.X_BL.translation().norm() + reach_m(*link.link) + reach_m(other);
  return {link, other, make_frame(link.X_BL, static_cast<float>(far_m)),
          motion_of(Pose::Identity()), heading_of_best(link, link.X_BL)};
}

float apart_along(const LinkPatches& other, const Pose& X_FL, const LinkSearch& link) {
  const Heading n = heading_of_best(link, X_FL);
  const double far_m = X_FL.translation().norm() + reach_m(*link.link) + reach_m(other);
  return least_of_link(*link.link, motion_of(X_FL), n) +
         least_of_link(other, motion_of(Pose::Identity()), {-n.x, -n.y, -n.z}) -
         rounding_m(static_cast<float>(far_m));
}

void take_pair_front(const LinkPatches& other, LinkSearch& link) {
  const PairSearch search = make_pair_search(other, link);
  for (const std::uint32_t place : link.front.find_below(link.limit_m())) {
    const Item& item = link.front.item(place);
    const auto patch = static_cast<std::uint32_t>(item.space);
    if (level_of(item.patch) == 0 && level_of(patch) == 0 && item.way != 0) {
      link.front.raise(
          place, leaf_bound(search, index_of(item.patch), index_of(patch), unpacked(item.way)));
      if (link.front.bound_m(place) >= link.limit_m()) continue;
    }
    link.front.take(place, link.items);
  }
}

void search_pair_of_links(const LinkPatches& other, int steps, LinkSearch& link) {
  PairSearch search = make_pair_search(other, link);
  search_best_first(link, steps,
                    [&](Item& item, Fresh& fresh) HWY_ATTR { expand(search, item, fresh); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(search_pair_of_links);
HWY_EXPORT(take_pair_front);
HWY_EXPORT(apart_along);

float apart_at_pair_m(const LinkPatches& other, const Pose& X_FL, const LinkSearch& search) {
  return HWY_DYNAMIC_DISPATCH(apart_along)(other, X_FL, search);
}

void take_link_pair_below(const LinkPatches& other, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(take_pair_front)(other, search);
}

void search_link_pair(const LinkPatches& other, int steps, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(search_pair_of_links)(other, steps, search);
}

void start_link_pair(const LinkPatches& other, LinkSearch& search) {
  begin_front(search);
  if (search.link->empty() || other.empty()) return;
  search.items.push({.patch = patch_of(static_cast<int>(search.link->levels.size()) - 1, 0),
                     .space = patch_of(static_cast<int>(other.levels.size()) - 1, 0)});
}

ConvexPair best_pair_of(const LinkPatches& other, const LinkSearch& search) {
  Eigen::Vector3d corners_m[3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners_m[i][static_cast<Eigen::Index>(k)] = other.corners_m[3 * i + k][search.best_pixel];
    }
  }
  return triangle_pair(search, search.X_BL, search.best_triangle, corners_m);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
