#include "berth/distance/body_pair.hpp"

#include <algorithm>
#include <limits>

#include "berth/distance/last_request.hpp"

namespace berth::mesh {
namespace {

constexpr int kWholeSearch = 1 << 30;
/// Nearer than a search can tell, two links touch.
constexpr float kContact_m = kFinestTolerance_m;

/// A point of the other link's frame at which one of the two has a whole part within the other.
std::optional<Eigen::Vector3d> find_inside(const KnownBody& link, const KnownBody& other,
                                           const Pose& X_FL) {
  for (const Eigen::Vector3f& corner_L_m : link.parts.corners_m()) {
    const Eigen::Vector3d p_F_m = X_FL * corner_L_m.cast<double>();
    if (other.parts.enclose(p_F_m)) return p_F_m;
  }
  const Pose X_LF = X_FL.inverse();
  for (const Eigen::Vector3f& corner_F_m : other.parts.corners_m()) {
    const Eigen::Vector3d p_F_m = corner_F_m.cast<double>();
    if (link.parts.enclose(X_LF * p_F_m)) return p_F_m;
  }
  return std::nullopt;
}

}  // namespace

// A front grows for seconds, and would allocate as long. Of what is reserved here, only the pages
// that are written to take memory.
BodyPair::BodyPair() {
  search_.items.reserve(kMostItems);
  search_.front.reserve(kMostItems);
}

void BodyPair::forget() {
  has_begun_ = false;
  inside_F_m_.reset();
  search_.best_triangle = -1;
  room_m_ = 0;
  lower_bound_m_ = 0;
}

void BodyPair::search_on(const LinkPatches& other) {
  if (search_.known_bound_m >= search_.limit_m()) return;
  take_link_pair_below(other, search_);
  search_link_pair(other, kWholeSearch, search_);
}

bool BodyPair::follow(const KnownBody& link, const KnownBody& other, const RobotPose& pose,
                      float needed_m, float tolerance_m) {
  if (!has_begun_ || inside_F_m_) return false;
  const Pose& X_BF = pose.X_BL[other.link];
  const Pose X_FL = X_BF.inverse() * pose.X_BL[link.link];
  lower_bound_m_ =
      std::max(0.0f, known_bound_m_ - moved_at_most_m(*link.patches, known_X_FL_, X_FL));
  if (!search_.is_known()) return lower_bound_m_ >= needed_m;
  link_point_B_m_ = X_BF * (X_FL * search_.robot_point_L_m);
  other_point_B_m_ = X_BF * search_.obstacle_point_B_m;
  distance_m_ = static_cast<float>((link_point_B_m_ - other_point_B_m_).norm());
  // Nearer than the tolerance, it has to be decided whether they touch.
  const auto is_enough = [&] {
    return lower_bound_m_ >= needed_m ||
           (distance_m_ > tolerance_m && distance_m_ - lower_bound_m_ <= tolerance_m);
  };
  if (is_enough()) return true;
  if (!(distance_m_ > tolerance_m)) return false;
  const float apart_m = apart_at_pair_m(*other.patches, X_FL, search_);
  if (!(apart_m > lower_bound_m_)) return false;
  lower_bound_m_ = known_bound_m_ = apart_m;
  known_X_FL_ = X_FL;
  return is_enough();
}

void BodyPair::find(const KnownBody& link, const KnownBody& other, const RobotPose& pose,
                    const MeshRequest& request, float known_bound_m) {
  const Pose& X_BF = pose.X_BL[other.link];
  const Pose X_FL = X_BF.inverse() * pose.X_BL[link.link];
  const float moved_m = has_begun_ ? moved_at_most_m(*link.patches, search_.X_BL, X_FL)
                                   : std::numeric_limits<float>::infinity();
  start(*link.patches, X_FL, request, search_);
  search_.known_bound_m = std::clamp(known_bound_m, 0.0f, search_.range_m);
  if (!keep_front(moved_m, search_)) start_link_pair(*other.patches, search_);
  keep_pair(search_);
  // Searched more finely than it has to be reported, it serves more requests.
  if (search_.known_bound_m < search_.limit_m()) search_.tolerance_m /= 2;
  search_on(*other.patches);
  if (search_.best_m <= request.tolerance_m) {
    // Decides whether they touch.
    search_.tolerance_m = kFinestTolerance_m;
    search_on(*other.patches);
  }
  room_m_ -= moved_m;
  has_begun_ = true;
  const float apart_m = search_.lower_bound_m();
  if (!(room_m_ > 0)) inside_F_m_ = find_inside(link, other, X_FL);
  room_m_ = std::max(room_m_, apart_m);
  lower_bound_m_ = known_bound_m_ = inside_F_m_ ? 0 : apart_m;
  known_X_FL_ = X_FL;
  tell(other, X_BF);
}

void BodyPair::tell(const KnownBody& other, const Pose& X_BF) {
  distance_m_ = std::numeric_limits<float>::infinity();
  if (search_.is_known()) {
    const ConvexPair found = best_pair_of(*other.patches, search_);
    search_.robot_point_L_m = search_.X_BL.inverse() * found.a_m;
    search_.obstacle_point_B_m = found.b_m;
    link_point_B_m_ = X_BF * found.a_m;
    other_point_B_m_ = X_BF * found.b_m;
    const auto apart_m = static_cast<float>(found.distance_m);
    distance_m_ = apart_m < kContact_m ? 0 : apart_m;
  }
  if (!inside_F_m_) return;
  distance_m_ = 0;
  link_point_B_m_ = other_point_B_m_ = X_BF * *inside_F_m_;
}

bool TouchSearch::is_touching(const KnownBody& link, const KnownBody& other,
                              const RobotPose& pose) {
  constexpr double kTouch_m = 1e-4;
  const Pose X_FL = pose.X_BL[other.link].inverse() * pose.X_BL[link.link];
  start(*link.patches, X_FL, {.range_m = kTouch_m}, search_);
  search_.best_m = search_.range_m;
  search_.best_triangle = -1;
  begin_front(search_);
  for (const Item& place : places_) search_.items.push(place);
  search_link_pair(*other.patches, kWholeSearch, search_);
  if (search_.is_known()) return true;
  start_link_pair(*other.patches, search_);
  search_link_pair(*other.patches, kWholeSearch, search_);
  if (!search_.is_known()) return find_inside(link, other, X_FL).has_value();
  places_.push_back(
      {.patch = patch_of(0, search_.best_triangle / LinkPatches::kChildren),
       .space = patch_of(0, static_cast<int>(search_.best_pixel) / LinkPatches::kChildren)});
  return true;
}

}  // namespace berth::mesh
