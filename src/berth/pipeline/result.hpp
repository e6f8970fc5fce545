// What a request gives: the one shape of a result, and the one list of its fields.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/closest_pair.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/separation.hpp"
#include "berth/types/setting.hpp"
#include "berth/types/status.hpp"

namespace berth {

class MountedCamera;

/// One link's part in a result. The pair to what is occupied or unknown is the link's own: its
/// distance, points in the robot's root frame B, camera and pixel. Where no pair is known, lengths
/// and points are NaN: never 0, never a large number, never those of the result before.
struct LinkResult : ToldPair {
  LinkId id = kNoLink;
  /// The link's name.
  std::string link;
  /// Whether a joint moves it. The others stand where they stand, as near as they always do.
  bool is_moved = true;
  LinkStatus status = LinkStatus::stale;
  /// What lies on the link, or on environment near it, and is thinner than this may be taken for
  /// that surface by every camera: an assumption of the distances, and not told by them. Of the
  /// camera that looks at the place best; NaN where none does.
  float assumed_thinner_m = std::numeric_limits<float>::quiet_NaN();
  /// The pair to what is occupied alone; its distance is never below that of the link.
  ToldPair occupied;
  /// The pair to the environment, the robot's own other links and other robots, by their meshes:
  /// no camera has to see them. Of links that a joint moves.
  KnownPair known;
  /// Further pairs to what is occupied or unknown and within 0.5 m, nearest first: each the nearest
  /// of an eighth of the link, and 5 cm apart on the link from its own pair and from each other. At
  /// most EvaluationSettings::candidates less one.
  std::vector<ToldPair> candidates;
  /// The points of the link's own pair in the optical frame C of its camera.
  Eigen::Vector3f robot_point_C_m = unset_point();
  Eigen::Vector3f obstacle_point_C_m = unset_point();
  /// Mean of the unit vectors to the mean_count readings within the range (Hirt 2.2.5), in frame
  /// B; its length is at most 1. NaN where mean_count is 0.
  Eigen::Vector3f mean_direction_B = unset_point();
  /// The same in frame C of its camera.
  Eigen::Vector3f mean_direction_C = unset_point();
  std::int64_t mean_count = 0;
  /// Nothing is known unless EvaluationSettings::visibility is set.
  LinkVisibility visibility;

  /// Of the three pairs that each link has: ToldPair::gradient, KnownPair::gradient.
  std::array<std::vector<float>*, 3> gradients() {
    return {&gradient, &occupied.gradient, &known.gradient};
  }
  bool has_distance() const { return !std::isnan(distance_m); }
  /// To what is occupied, unknown or known; NaN where none of them is within the range.
  float distance_to_all_m() const { return std::fmin(distance_m, known.distance_m); }
  /// Nothing of all that is nearer, certified; NaN where that is not known.
  float lower_bound_to_all_m() const {
    return known.lower_bound_m < lower_bound_m ? known.lower_bound_m : lower_bound_m;
  }
};

/// One camera's part in a result.
struct CameraResult : CameraState {
  /// The camera's name.
  std::string camera;
  /// The number of its newest image among its images; -1 where nobody counts them.
  int frame = -1;
  /// Whether it has given an image.
  bool has_frame = false;
  /// Where the optical frame C was at that image's exposure, in the robot's root frame B: where
  /// that root stands in the request, if the image is used.
  Pose X_BC = unset_pose();
  /// Frame::unread_share of that image, and whether the camera reports what gives no reading.
  double unread_share = std::numeric_limits<double>::quiet_NaN();
  bool tells_unread = false;
  /// Pixels of that image by PixelFate.
  std::array<std::int64_t, kPixelFateCount> self_filter = {};
  /// The camera with its settings; null where it has given no image.
  std::shared_ptr<const MountedCamera> mounted;
};

/// Many poses that the robot may take, against what the cameras see now.
struct LookAhead {
  /// poses[i][k] is the link with the id k + 1 at the i-th joint angles of the request; empty where
  /// the result is stale.
  std::vector<std::vector<WholeLinkDistance>> poses;
  /// The first pose at which some link may be nearer than the request's limit: its lower bound is.
  std::optional<std::size_t> first_nearer;
};

/// How long a request took, so often: from images or frames in memory to the result.
struct RequestTiming {
  int repeat = 0;
  double min_us = 0;
  double p50_us = 0;
  double p99_us = 0;
  double max_us = 0;
};

/// Of at least one time.
RequestTiming timing_of(std::vector<double> times_us);

/// How distances are found, as results name it: the whole robot's surface against what all cameras
/// see.
inline constexpr std::string_view kMethodName = "mesh";

/// All that a request gives. It owns what it reports.
struct Result {
  ResultStatus status = ResultStatus::stale;
  /// Unless its status is ok, the result is stale.
  Timeliness time;
  /// Lines of a scene are counted; 0 elsewhere.
  int frame = 0;
  /// The newest exposure that is used; NaN where none is.
  double stamp_s = std::numeric_limits<double>::quiet_NaN();
  /// Of the joints that were asked about.
  double joints_stamp_s = std::numeric_limits<double>::quiet_NaN();
  /// The pose of each link of the model that was asked about; empty where the result is stale.
  RobotPose pose;
  double range_m = 0;
  /// Whether visibility was asked for.
  bool has_visibility = false;
  /// Whether more than one pair of each link was asked for.
  bool has_candidates = false;
  /// In the order of the request's frames.
  std::vector<CameraResult> cameras;
  /// links[i] has the id i + 1.
  std::vector<LinkResult> links;
  /// The name of each of RobotModel::links; null without KnownPairs.
  std::shared_ptr<const std::vector<std::string>> link_names;
  /// The place in `links` of the nearest: it has a distance, and a joint moves it. -1: there is
  /// none.
  int nearest = -1;
  LookAhead ahead;
  /// Where it is monitored.
  std::optional<Separation> separation;
  /// In JSON under this name: evaluate_us or ask_us.
  std::string timing_name = "ask_us";
  std::optional<RequestTiming> timing;

  const LinkResult* nearest_link() const { return nearest < 0 ? nullptr : &links[nearest]; }
  /// The moved link with the least distance_to_all_m(); null where none has one.
  const LinkResult* nearest_to_all() const;
  /// The name of the other link of a pair; empty where no pair is known.
  std::string_view known_link_of(const KnownPair& pair) const {
    return pair.is_known() ? std::string_view((*link_names)[pair.link]) : std::string_view();
  }
  /// The name of the camera of a pair; empty where no pair is known.
  std::string_view camera_of(const SpacePair& pair) const {
    return pair.is_known() ? std::string_view(cameras[pair.camera].camera) : std::string_view();
  }
};

/// Sets Result::nearest, by the one rule for it.
void find_nearest(Result& result);

/// Makes it stale: no link has anything from before.
void withhold(Result& result);

/// A camera by its place in Result::cameras, told by its name.
struct CameraPlace {
  int place = -1;
};

/// A monitor's part, told with the names of its result.
struct SeparationOf {
  const Result& result;
};

/// What an obstacle's point is, where there is one.
struct ObstacleOf {
  const SpacePair& pair;
};

/// The other link of a known pair by its place in Result::link_names, written as its name.
struct KnownLink {
  int place = -1;
};

/// The field of a pair where gradients are asked for.
template <class Pair, class Visitor>
void visit_gradient(const Pair& p, Visitor&& visit) {
  if (p.gradient.empty()) return;
  visit({"gradient", "how the distance changes with each joint of the model, in m/rad or m/m"},
        p.gradient);
}

/// The fields of a pair to what is known.
template <class Visitor>
void visit_fields(const KnownPair& p, Visitor&& visit) {
  visit({"distance_m",
         "the distance from the link to the nearest environment link, own link or other robot"},
        p.distance_m);
  visit({"lower_bound_m", "none of them is nearer than this, certified"}, p.lower_bound_m);
  visit({"robot_point_base_m", "the link's closest point, in the robot's root frame"},
        p.robot_point_B_m);
  visit({"obstacle_point_base_m", "the other link's closest point, in the robot's root frame"},
        p.obstacle_point_B_m);
  visit({"link", "the other link"}, KnownLink{p.link});
  visit_gradient(p, visit);
}

/// The fields of a closest pair, but what it leads to.
template <class Visitor>
void visit_fields(const SpacePair& p, Visitor&& visit) {
  visit({"distance_m", "the distance from the link to the nearest obstacle of this kind"},
        p.distance_m);
  visit({"lower_bound_m", "no obstacle of this kind is nearer than this, certified"},
        p.lower_bound_m);
  visit({"robot_point_base_m", "the link's closest point, in the robot's root frame"},
        p.robot_point_B_m);
  visit({"obstacle_point_base_m", "the obstacle's closest point, in the robot's root frame"},
        p.obstacle_point_B_m);
  visit({"camera", "the camera that measured the obstacle's point, or what hides it"},
        CameraPlace{p.camera});
  visit({"obstacle_pixel", "column and row of the obstacle's point in that camera's image"},
        p.obstacle_pixel);
}

template <class Visitor>
void visit_fields(const ToldPair& p, Visitor&& visit) {
  visit_fields(static_cast<const SpacePair&>(p), visit);
  visit_gradient(p, visit);
}

template <class Visitor>
void visit_fields(const SightShares& s, Visitor&& visit) {
  visit({"seen", "the share that is seen"}, s.seen);
  visit({"hidden_by_obstacles", "the share that obstacles hide"}, s.hidden_by_obstacles);
  visit({"hidden_by_robot", "the share that the robot hides"}, s.hidden_by_robot);
  visit({"no_reading", "the share whose pixels have no reading"}, s.no_reading);
  visit({"outside_image", "the share outside of every image"}, s.outside_image);
}

template <class Visitor>
void visit_fields(const LinkVisibility& v, Visitor&& visit) {
  visit({"surface", "how much of the link's surface is seen"}, v.surface);
  visit({"space", "how much of the space around the link, up to its distance, is seen"}, v.space);
  visit({"space_unknown",
         "the share of the space around the link of which no camera can tell anything"},
        v.space_unknown);
  visit({"rejected_distance_m",
         "the distance to readings that a rule rejected, where they are nearer"},
        v.rejected_distance_m);
  visit({"rejected_pixel", "the pixel of the nearest reading that a rule rejected"},
        v.rejected_pixel);
}

/// The fields of one link. `result` is the one that it belongs to.
template <class Visitor>
void visit_fields(const LinkResult& l, const Result& result, Visitor&& visit) {
  visit({"id", "the link's number, from 1"}, l.id);
  visit({"link", "the link's name"}, l.link);
  visit({"is_moved", "whether a joint moves the link"}, l.is_moved);
  visit({"status", "what is known of the link"}, l.status);
  visit_fields(static_cast<const ToldPair&>(l), visit);
  visit(
      {"obstacle_is",
       "whether the obstacle's point is occupied, unknown: hidden, and seen free by no camera, or "
       "unobserved: in no image"},
      ObstacleOf{l});
  visit({"occupied", "the closest pair to surfaces that a camera measured, alone"}, l.occupied);
  if (result.link_names) {
    visit({"known",
           "the closest pair to the environment, the robot's own other links and other robots, by "
           "their meshes: no camera has to see them"},
          l.known);
  }
  if (result.has_candidates) {
    visit(
        {"candidates",
         "further closest pairs, nearest first, at least 5 cm apart on the link, up to 0.5 m away"},
        l.candidates);
  }
  visit({"assumed_thinner_m",
         "what lies on the link or on environment near it, and is thinner than this, is taken for "
         "that surface: an assumption"},
        l.assumed_thinner_m);
  visit({"mean_direction_base", "the mean of the unit vectors to what is near"},
        l.mean_direction_B);
  visit({"mean_count", "how many readings the mean direction is taken over"}, l.mean_count);
  if (result.cameras.size() == 1) {
    visit({"robot_point_camera_m", "the link's closest point, in the camera's optical frame"},
          l.robot_point_C_m);
    visit(
        {"obstacle_point_camera_m", "the obstacle's closest point, in the camera's optical frame"},
        l.obstacle_point_C_m);
    visit({"mean_direction_camera", "the mean direction, in the camera's optical frame"},
          l.mean_direction_C);
  }
  if (result.has_visibility) {
    visit({"visibility", "how much of the link and around it the cameras see"}, l.visibility);
  }
  if (result.separation && l.is_moved) {
    visit({"separation", "how fast the link lets the robot go on"},
          result.separation->links[l.id - 1]);
  }
}

template <class Visitor>
void visit_fields(const Timeliness& t, Visitor&& visit) {
  visit({"status", "whether stamps and ages allow an answer, or why not"}, t.status);
  visit({"frame_age_s", "the age of the newest image at the request"}, t.frame_age_s);
  visit({"joints_age_s", "the age of the joints at the request"}, t.joints_age_s);
  visit({"skew_s", "from the newest image to the joint sample nearest to it"}, t.skew_s);
}

template <class Visitor>
void visit_fields(const CameraResult& c, Visitor&& visit) {
  visit({"camera", "the camera's name"}, c.camera);
  visit({"frame", "the number of its newest image"}, c.frame);
  visit({"stamp_s", "when the newest image was exposed"}, c.stamp_s);
  visit({"age_s", "how old the newest image is at the request"}, c.age_s);
  visit({"status", "whether the newest image is used, or why not"},
        static_cast<const CameraState&>(c));
  visit({"seen_through", "the share of the robot's pixels that show what is behind it"},
        c.watch.seen_through);
  visit({"displacement_m", "by how much the robot must be moved to fit the image"},
        c.watch.displacement_m);
  visit({"at_robot", "the share of the robot's readings that lie at its surface"},
        c.watch.at_robot);
  visit({"unread_share",
         "the share of the newest image without a reading where the empty cell has one; where that "
         "is not known, of all that has none beside the robot"},
        c.unread_share);
  visit({"self_filter", "pixels of the newest image by what became of them"}, c.self_filter);
}

/// The fields of a whole result; cameras and links have lists of their own.
template <class Visitor>
void visit_fields(const Result& r, Visitor&& visit) {
  visit({"frame", "the number of the line"}, r.frame);
  visit({"stamp_s", "the newest exposure"}, r.stamp_s);
  visit({"joints_stamp_s", "the time of the joints that were asked about"}, r.joints_stamp_s);
  visit({"status", "whether the result is complete, lacks a camera, or is no answer"}, r.status);
  visit({"time", "how the result stands in time"}, r.time);
  visit({"method", "how the distances were found"}, kMethodName);
  visit({"range_m", "distances were looked for up to here"}, r.range_m);
  const LinkResult* nearest = r.nearest_link();
  visit({"nearest", "the nearest link that a joint moves"},
        nearest ? std::optional<std::string_view>(nearest->link) : std::nullopt);
  if (r.separation) visit({"separation", "how fast the robot may go on"}, SeparationOf{r});
  visit({"cameras", "each camera's part"}, r.cameras);
  visit({"links", "each link's part"}, r.links);
}

}  // namespace berth
