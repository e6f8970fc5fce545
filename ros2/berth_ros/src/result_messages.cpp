#include "result_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth_ros {
namespace {

using berth_msgs::msg::LinkDistance;
using berth_msgs::msg::LinkDistances;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The other constants are held against the enumerators without ROS (message_fields_test).
static_assert(berth::kTimeStatusCount == LinkDistances::TIME_NO_ROBOT);

template <class Enum>
std::uint8_t constant_of(Enum value) {
  return static_cast<std::uint8_t>(value);
}

template <class Vector>
geometry_msgs::msg::Point point_of(const Vector& p) {
  geometry_msgs::msg::Point point;
  point.x = p.x(), point.y = p.y(), point.z = p.z();
  return point;
}

geometry_msgs::msg::Vector3 vector_of(const Eigen::Vector3f& v) {
  geometry_msgs::msg::Vector3 vector;
  vector.x = v.x(), vector.y = v.y(), vector.z = v.z();
  return vector;
}

/// `out` is a SpacePair or a LinkDistance, which has the same fields.
template <class Message>
void copy_pair(const berth::SpacePair& pair, const berth::Result& result, Message& out) {
  out.distance_m = pair.distance_m;
  out.lower_bound_m = pair.lower_bound_m;
  out.robot_point_base_m = point_of(pair.robot_point_B_m);
  out.obstacle_point_base_m = point_of(pair.obstacle_point_B_m);
  out.camera = result.camera_of(pair);
  out.obstacle_pixel = {pair.obstacle_pixel.u, pair.obstacle_pixel.v};
}

void copy(const berth::KnownPair& pair, const berth::Result& result,
          berth_msgs::msg::KnownPair& out) {
  out.distance_m = pair.distance_m;
  out.lower_bound_m = pair.lower_bound_m;
  out.robot_point_base_m = point_of(pair.robot_point_B_m);
  out.obstacle_point_base_m = point_of(pair.obstacle_point_B_m);
  out.link = result.known_link_of(pair);
}

void copy(const berth::SightShares& shares, berth_msgs::msg::SightShares& out) {
  out.seen = shares.seen;
  out.hidden_by_obstacles = shares.hidden_by_obstacles;
  out.hidden_by_robot = shares.hidden_by_robot;
  out.no_reading = shares.no_reading;
  out.outside_image = shares.outside_image;
}

void copy(const berth::LinkVisibility& visibility, berth_msgs::msg::LinkVisibility& out) {
  copy(visibility.surface, out.surface);
  copy(visibility.space, out.space);
  out.space_unknown = visibility.space_unknown;
  out.rejected_distance_m = visibility.rejected_distance_m;
  out.rejected_pixel = {visibility.rejected_pixel.u, visibility.rejected_pixel.v};
}

void copy(const berth::LinkResult& link, const berth::Result& result, LinkDistance& out) {
  out.id = link.id;
  out.link = link.link;
  out.is_moved = link.is_moved;
  out.status = constant_of(link.status);
  copy_pair(link, result, out);
  out.obstacle_is = constant_of(link.obstacle_is);
  copy_pair(link.occupied, result, out.occupied);
  copy(link.known, result, out.known);
  out.candidates.resize(link.candidates.size());
  for (std::size_t k = 0; k < out.candidates.size(); ++k) {
    copy_pair(link.candidates[k], result, out.candidates[k]);
  }
  out.assumed_thinner_m = link.assumed_thinner_m;
  out.mean_direction_base = vector_of(link.mean_direction_B);
  out.mean_count = link.mean_count;
  copy(link.visibility, out.visibility);
}

void copy(const berth::CameraResult& camera, const StampClock& clock,
          berth_msgs::msg::CameraState& out) {
  out.camera = camera.camera;
  out.stamp = clock.stamp(camera.stamp_s);
  out.age_s = camera.age_s;
  out.status = constant_of(camera.status);
  out.time_status = constant_of(camera.time);
  out.seen_through = camera.watch.seen_through;
  out.displacement_m = camera.watch.displacement_m;
  out.at_robot = camera.watch.at_robot;
  out.unread_share = camera.unread_share;
}

}  // namespace

void to_message(const berth::Result& result, const std::string& base_frame, const rclcpp::Time& now,
                const StampClock& clock, LinkDistances& out) {
  out.header.frame_id = base_frame;
  out.question_stamp = now;
  out.header.stamp =
      std::isfinite(result.stamp_s) ? clock.stamp(result.stamp_s) : out.question_stamp;
  out.joints_stamp = clock.stamp(result.joints_stamp_s);
  out.status = constant_of(result.status);
  out.time_status = constant_of(result.time.status);
  out.frame_age_s = result.time.frame_age_s;
  out.joints_age_s = result.time.joints_age_s;
  out.skew_s = result.time.skew_s;
  out.method = berth::kMethodName;
  out.range_m = static_cast<float>(result.range_m);
  const berth::LinkResult* nearest = result.nearest_link();
  out.nearest = nearest ? nearest->link : std::string();
  out.cameras.resize(result.cameras.size());
  for (std::size_t c = 0; c < out.cameras.size(); ++c) {
    copy(result.cameras[c], clock, out.cameras[c]);
  }
  out.links.resize(result.links.size());
  for (std::size_t i = 0; i < out.links.size(); ++i) copy(result.links[i], result, out.links[i]);
}

void say_no_robot(const std::vector<std::string>& camera_names, const rclcpp::Time& now,
                  LinkDistances& out) {
  out = LinkDistances();
  out.header.stamp = out.question_stamp = now;
  out.status = LinkDistances::STALE;
  out.time_status = LinkDistances::TIME_NO_ROBOT;
  out.frame_age_s = out.joints_age_s = out.skew_s = kNaN;
  berth::CameraResult camera;
  for (const std::string& name : camera_names) {
    camera.camera = name;
    copy(camera, StampClock(), out.cameras.emplace_back());
  }
}

void to_message(const LinkDistances& distances, bool may_be_degraded,
                berth_msgs::msg::Separation& out) {
  out.header = distances.header;
  out.status = distances.status;
  out.time_status = distances.time_status;
  out.has_distance = false;
  out.distance_m = static_cast<float>(kNaN);
  out.link.clear();
  out.link_status = LinkDistance::STALE;
  out.obstacle_is = LinkDistance::OCCUPIED;
  out.robot_point_base_m = out.obstacle_point_base_m = point_of(berth::unset_point());
  out.frame_age_s = kNaN;
  for (const auto& camera : distances.cameras) {
    const auto status = static_cast<berth::CameraStatus>(camera.status);
    if (berth::is_used(status)) out.frame_age_s = std::fmax(out.frame_age_s, camera.age_s);
  }
  // Distances may be larger than with the camera that is lost.
  if (distances.status == LinkDistances::DEGRADED && !may_be_degraded) return;
  float bound_m = std::numeric_limits<float>::infinity();
  const LinkDistance* nearest = nullptr;
  for (const LinkDistance& link : distances.links) {
    if (!link.is_moved) continue;
    const bool is_known =
        link.status == LinkDistance::OK || link.status == LinkDistance::NONE_IN_RANGE;
    // Also a bound that is not there, or certifies nothing, is not known.
    if (!is_known || std::isnan(link.lower_bound_m)) {
      out.link = link.link;
      out.link_status = link.status;
      return;
    }
    bound_m = std::min(bound_m, link.lower_bound_m);
    if (link.link == distances.nearest) nearest = &link;
  }
  if (std::isinf(bound_m)) return;
  out.has_distance = true;
  out.distance_m = bound_m;
  out.link_status = LinkDistance::NONE_IN_RANGE;
  if (!nearest) return;
  out.link = nearest->link;
  out.link_status = nearest->status;
  out.obstacle_is = nearest->obstacle_is;
  out.robot_point_base_m = nearest->robot_point_base_m;
  out.obstacle_point_base_m = nearest->obstacle_point_base_m;
}

}  // namespace berth_ros
