// What the search for one link's distance knows while it runs.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "berth/distance/convex_pair.hpp"
#include "berth/distance/item_heap.hpp"
#include "berth/distance/robot_patches.hpp"
#include "berth/space/cubes.hpp"
#include "berth/space/unknown_space.hpp"
#include "berth/types/closest_pair.hpp"

namespace berth::mesh {

/// A patch by its level and its place there.
inline std::uint32_t patch_of(int level, int index) {
  return static_cast<std::uint32_t>(level) << 28 | static_cast<std::uint32_t>(index);
}
inline int level_of(std::uint32_t patch) { return static_cast<int>(patch >> 28); }
inline int index_of(std::uint32_t patch) { return static_cast<int>(patch & 0xFFFFFFFu); }

/// A square of a view's image; `level` is that of DepthCells, kPixelLevel for one pixel. `half`
/// says which of a cell's two depth ranges is meant.
struct ImageCell {
  static constexpr int kPixelLevel = 15;

  int view = 0;
  int level = 0;
  int half = 0;
  int u = 0;
  int v = 0;

  std::uint64_t key() const {
    return static_cast<std::uint64_t>(view) << 56 | static_cast<std::uint64_t>(level) << 52 |
           static_cast<std::uint64_t>(half) << 51 | static_cast<std::uint64_t>(u) << 24 |
           static_cast<std::uint64_t>(v);
  }
  static ImageCell of_key(std::uint64_t key) {
    return {static_cast<int>(key >> 56), static_cast<int>(key >> 52 & 15),
            static_cast<int>(key >> 51 & 1), static_cast<int>(key >> 24 & 0xFFFFFF),
            static_cast<int>(key & 0xFFFFFF)};
  }
};

/// How far the corners of cubes are from a link, as far as a search has asked; a corner may drive
/// another one out.
class CornerStore {
 public:
  struct Corner {
    std::uint64_t key = 0;
    float squared_m2 = 0;
    /// The leaf that is nearest to it.
    int leaf = 0;
    /// LinkSearch::request, since a link that moves is at another distance.
    std::uint32_t request = 0;
  };

  CornerStore() = default;
  /// A copy asks again.
  CornerStore(const CornerStore&) {}
  CornerStore& operator=(const CornerStore&) {
    corners_.assign(corners_.size(), {});
    return *this;
  }

  Corner& at(std::uint64_t key) {
    if (corners_.empty()) corners_.resize(kCount);
    return corners_[(key * 0x9E3779B97F4A7C15u) >> 53];
  }

 private:
  static constexpr std::size_t kCount = std::size_t{1} << 11;
  std::vector<Corner> corners_;
};

struct LinkSearch {
  /// How far a link may move until its front is begun anew: what lies so far behind the range is
  /// in it, too.
  static constexpr float kRoom_m = 0.1f;

  const LinkPatches* link = nullptr;
  Pose X_BL = Pose::Identity();
  float range_m = 0;
  float tolerance_m = 0;
  /// Nothing is nearer, as is known before the search.
  float known_bound_m = 0;

  /// The length of the best pair so far; the range while there is none.
  float best_m = 0;
  int best_triangle = -1;
  /// The best pair's pixel as an ImageCell, or its point in unknown space.
  std::uint64_t best_pixel = 0;
  Eigen::Vector3f best_point_B_m;
  bool best_is_hidden = false;
  /// The points of the last request's pair, if it found one.
  Eigen::Vector3d robot_point_L_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_point_B_m = Eigen::Vector3d::Zero();

  /// Counts the requests.
  std::uint32_t request = 0;
  ItemHeap items;
  /// Nothing in it is nearer than limit_m(), but for what is in given_up_m.
  Front front;
  /// known_range_m() when it was begun.
  float front_range_m = 0;
  /// Some of that lies where there are no cubes: nothing is known of it.
  bool is_beyond_cubes = false;
  CornerStore corners;
  /// The least bound of what was too small to be searched on.
  float given_up_m = std::numeric_limits<float>::infinity();

  bool is_known() const { return best_triangle >= 0; }
  /// Of what lies farther off nothing is known.
  float known_range_m() const { return range_m + kRoom_m; }
  /// Leaves an item aside for this request.
  void put_aside(Item item) {
    item.bound_m = std::min(item.bound_m, known_range_m());
    front.put(item);
  }
  /// Nothing is looked for from here on. Without a pair, a tolerance could miss those in range.
  float limit_m() const { return is_known() ? best_m - tolerance_m : range_m; }
  bool is_done() const { return std::max(items.least_bound_m(), known_bound_m) >= limit_m(); }
  float lower_bound_m() const {
    const float found_m = std::min({limit_m(), items.least_bound_m(), given_up_m});
    return std::max({0.0f, known_bound_m, found_m});
  }
};

/// The closest points of a triangle, moved by X_FL, and the body with these corners.
ConvexPair triangle_pair(const LinkSearch& search, const Pose& X_FL, int triangle,
                         std::span<const Eigen::Vector3d> body_corners_m);

/// Searches on among the pixels of all views: for their surface layers, or with `to_shadow` for all
/// that lies behind their readings. Ends when the search is done, or after about `steps` patches.
void search_views(const UnknownSpace& space, bool to_shadow, int steps, LinkSearch& search);

/// The same among the cubes of unknown space.
void search_cubes(const UnknownSpace& space, int steps, LinkSearch& search);

/// Takes a point for the best obstacle if it is hidden and nearer than that.
void try_hidden_point(const UnknownSpace& space, const Eigen::Vector3f& p_B_m, LinkSearch& search);

/// Nothing is in heap and front, and what is put there reaches known_range_m().
inline void begin_front(LinkSearch& search) {
  search.items.clear();
  search.front.clear();
  search.front_range_m = search.known_range_m();
  search.is_beyond_cubes = false;
}

/// Goes on among cubes with the front of the request before: those of its items that may be near
/// enough to where the link is now are searched for, the others are told anew how far they are.
void take_cubes_below(LinkSearch& search);

/// Both start with the whole link and all of space, and an empty front.
void start_in_views(const UnknownSpace& space, LinkSearch& search);
void start_in_cubes(LinkSearch& search);

/// Marks a cube in Item::patch of which some children are gone. Item::way is the request of which
/// an item's bound is that of its own corners, not of the cube that it is a child of.
inline constexpr std::uint32_t kOpened = 1u << 31;

/// The level from which on down a cube's corners tell more than patches do.
inline constexpr int kGreatestByCorners = 4;

/// No point that a search asks for is farther from the origins of both frames.
inline float reach_of_cubes_m(const LinkSearch& search) {
  const PatchLevel& top = search.link->levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  return static_cast<float>(centre_L_m.norm() + search.X_BL.translation().norm()) +
         top.half_height_m[0] + top.radius_m[0] + search.known_range_m();
}

/// The best pair and how far it is certified; `is_shadow` where all behind a reading is hidden. The
/// search keeps the pair's points for the next request.
SpacePair pair_of(const UnknownSpace& space, bool is_shadow, LinkSearch& search);

/// Makes a link's two answers such that they do not contradict each other.
void reconcile(WholeLinkDistance& link);

}  // namespace berth::mesh
