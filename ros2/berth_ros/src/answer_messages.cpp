#include "answer_messages.hpp"

#include <cmath>
#include <limits>

namespace berth_ros {
namespace {

using berth_msgs::msg::LinkDistance;
using berth_msgs::msg::LinkDistances;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The constants of the messages are the enumerators.
static_assert(static_cast<int>(berth::LinkStatus::not_seen) == LinkDistance::NOT_SEEN);
static_assert(static_cast<int>(berth::LinkStatus::untimely) == LinkDistance::UNTIMELY);
static_assert(static_cast<int>(berth::TimeStatus::camera_moved) == LinkDistances::CAMERA_MOVED);
static_assert(static_cast<int>(berth::TimeStatus::camera_implausible) ==
              LinkDistances::CAMERA_IMPLAUSIBLE);
static_assert(static_cast<int>(berth::TimeStatus::stale_frame) == LinkDistances::STALE_FRAME);
static_assert(berth::kTimeStatusCount == LinkDistances::NO_ROBOT);
static_assert(static_cast<int>(berth::CameraStatus::moved) == berth_msgs::msg::CameraState::MOVED);
static_assert(static_cast<int>(berth::CameraStatus::hidden) == berth_msgs::msg::CameraState::HIDDEN);

geometry_msgs::msg::Point point_of(const Eigen::Vector3d& p) {
  geometry_msgs::msg::Point point;
  point.x = p.x(), point.y = p.y(), point.z = p.z();
  return point;
}

geometry_msgs::msg::Vector3 vector_of(const Eigen::Vector3d& v) {
  geometry_msgs::msg::Vector3 vector;
  vector.x = v.x(), vector.y = v.y(), vector.z = v.z();
  return vector;
}

geometry_msgs::msg::Point no_point() { return point_of(Eigen::Vector3d::Constant(kNaN)); }

void to_message(const berth::CameraState& state, const std::string& name, const StampClock& clock,
                berth_msgs::msg::CameraState& out) {
  out.camera = name;
  out.status = static_cast<std::uint8_t>(state.status);
  out.time_status = static_cast<std::uint8_t>(state.time);
  out.stamp = clock.stamp(state.stamp_s);
  out.age_s = state.age_s;
  out.seen_through = state.watch.seen_through;
  out.displacement_m = state.watch.displacement_m;
}

/// A pair in the root frame: method mesh tells it there, image methods in the camera's.
void add_pair(const berth::LinkDistance& link, const AnswerContext& context, LinkDistance& out) {
  const bool in_base = link.view >= 0;
  const std::size_t camera = in_base ? link.view : 0;
  out.camera = context.camera_names[camera];
  out.obstacle_pixel = {link.obstacle_pixel.u, link.obstacle_pixel.v};
  out.obstacle_is = static_cast<std::uint8_t>(link.obstacle_kind);
  if (in_base) {
    out.robot_point = point_of(link.robot_point_B_m.cast<double>());
    out.obstacle_point = point_of(link.obstacle_point_B_m.cast<double>());
    return;
  }
  const berth::Pose& X_BC = context.frames[camera]->X_BC;
  out.robot_point = point_of(X_BC * link.robot_point_C_m.cast<double>());
  out.obstacle_point = point_of(X_BC * link.obstacle_point_C_m.cast<double>());
}

void add_no_pair(LinkDistance& out) {
  out.camera.clear();
  out.obstacle_pixel = {-1, -1};
  out.obstacle_is = LinkDistance::READING;
  out.robot_point = out.obstacle_point = no_point();
}

void to_message(const berth::LinkDistance& link, const AnswerContext& context, LinkDistance& out) {
  const berth::RobotModel& model = context.robot.model();
  const std::size_t index = model.evaluated_links[link.id - 1];
  const bool is_mesh = context.robot.settings().method == berth::Method::mesh;
  out.id = link.id;
  out.link = model.links[index].name;
  out.is_moved = model.is_moved(index);
  out.status = static_cast<std::uint8_t>(link.status);
  out.distance_m = link.distance_m;
  out.lower_bound_m = link.lower_bound_m;
  if (link.has_distance()) {
    add_pair(link, context, out);
  } else {
    add_no_pair(out);
  }
  out.reading_distance_m = is_mesh ? link.reading.distance_m : link.distance_m;
  out.mean_count = link.has_distance() ? link.mean_count : 0;
  Eigen::Vector3d mean_B = Eigen::Vector3d::Constant(kNaN);
  if (out.mean_count > 0) {
    mean_B = is_mesh ? Eigen::Vector3d(link.mean_direction_B.cast<double>())
                     : context.frames[0]->X_BC.linear() * link.mean_direction_C.cast<double>();
  }
  out.mean_direction = vector_of(mean_B);
}

void add_visibility(const berth::Answer& answer, std::size_t i, LinkDistance& out) {
  const berth::LinkVisibility none;
  const berth::LinkVisibility& visibility =
      i < answer.visibility.size() ? answer.visibility[i] : none;
  out.surface_seen = visibility.surface.seen;
  out.space_unknown = visibility.space_unknown;
  out.doubtful_distance_m = visibility.doubtful_distance_m;
}

}  // namespace

void to_message(const berth::Answer& answer, const AnswerContext& context, LinkDistances& out) {
  const auto& settings = context.robot.settings();
  const bool has_frame = std::isfinite(answer.frame_stamp_s) &&
                         answer.time.status != berth::TimeStatus::no_frame;
  out.header.frame_id = context.robot.model().links.front().name;
  out.question_stamp = context.now;
  out.header.stamp = has_frame ? context.clock.stamp(answer.frame_stamp_s) : out.question_stamp;
  out.status = static_cast<std::uint8_t>(answer.time.status);
  const bool has_joints = answer.time.status != berth::TimeStatus::no_joints && has_frame;
  out.joints_stamp = context.clock.stamp(has_joints ? answer.joints_stamp_s : kNaN);
  out.frame_age_s = answer.time.frame_age_s;
  out.joints_age_s = answer.time.joints_age_s;
  out.method = name_of(settings.method);
  out.range_m = static_cast<float>(settings.distance.range_m);
  out.cameras.resize(context.cameras.size());
  for (std::size_t c = 0; c < context.cameras.size(); ++c) {
    to_message(context.cameras[c], context.camera_names[c], context.clock, out.cameras[c]);
  }
  out.links.resize(answer.distances.links.size());
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    to_message(answer.distances.links[i], context, out.links[i]);
    add_visibility(answer, i, out.links[i]);
  }
}

void say_no_robot(const std::vector<std::string>& camera_names, const rclcpp::Time& now,
                  LinkDistances& out) {
  out = LinkDistances();
  out.header.stamp = out.question_stamp = now;
  out.status = LinkDistances::NO_ROBOT;
  out.frame_age_s = out.joints_age_s = kNaN;
  for (const std::string& name : camera_names) {
    to_message(berth::CameraState(), name, StampClock(), out.cameras.emplace_back());
  }
}

void to_message(const LinkDistances& distances, berth_msgs::msg::Separation& out) {
  out.header = distances.header;
  out.status = distances.status;
  out.has_distance = false;
  out.distance_m = static_cast<float>(kNaN);
  out.link.clear();
  out.link_status = LinkDistance::UNTIMELY;
  out.obstacle_is = LinkDistance::READING;
  out.robot_point = out.obstacle_point = no_point();
  out.frame_age_s = kNaN;
  for (const auto& camera : distances.cameras) {
    const auto status = static_cast<berth::CameraStatus>(camera.status);
    if (berth::is_used(status)) out.frame_age_s = std::fmax(out.frame_age_s, camera.age_s);
  }
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
    if (!nearest || link.lower_bound_m < nearest->lower_bound_m) nearest = &link;
  }
  if (!nearest) return;
  out.has_distance = true;
  out.distance_m = nearest->lower_bound_m;
  out.link = nearest->link;
  out.link_status = nearest->status;
  out.obstacle_is = nearest->obstacle_is;
  out.robot_point = nearest->robot_point;
  out.obstacle_point = nearest->obstacle_point;
}

}  // namespace berth_ros
