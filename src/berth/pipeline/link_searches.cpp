#include "berth/pipeline/link_searches.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/self_filter/surface_things.hpp"

namespace berth {
namespace {

constexpr double kDefaultTolerance_m = 0.001;
/// A link near so much that is in no image is not observed.
constexpr double kMostUnobserved = 0.5;

MeshRequest request_of(const DistanceSettings& settings) {
  return {.range_m = settings.range_m,
          .tolerance_m = settings.tolerance_m.value_or(kDefaultTolerance_m),
          .deadline_us = settings.deadline_us};
}

LinkStatus status_of(const SpacePair& nearest, double range_m) {
  if (nearest.is_known()) return LinkStatus::ok;
  return nearest.lower_bound_m >= static_cast<float>(range_m) ? LinkStatus::none_in_range
                                                              : LinkStatus::cut_short;
}

/// Its camera by its place among all frames of the request.
SpacePair in_frames(SpacePair pair, const FrameSet& frames) {
  if (pair.is_known()) pair.camera = frames.used()[pair.camera];
  return pair;
}

/// Whether the robot stands before this place in the image.
bool is_behind_robot(const Frame& frame, const Eigen::Vector3d& place_C_m) {
  constexpr double kBehind_m = 0.03;
  const auto pixel = pixel_of(frame.mounted->camera(), place_C_m);
  return pixel && frame.robot.depth_m(pixel->u, pixel->v) < place_C_m.z() - kBehind_m;
}

/// How thick a thing at z may be that lies on a surface and is not told, in this image.
double untold_m(const Frame& frame, double z_m, float SurfaceTolerance::*tolerance) {
  // A thing is found from a little more than the tolerance on, as its edges are round.
  constexpr double kFoundFrom = 1.05;
  const double found_m =
      kFoundFrom * frame.obstacles.surface_tolerance.*tolerance * surface_growth(z_m);
  const Tolerance along_ray = tolerance_of(frame.mounted->settings().self_filter);
  // Without the rule for surfaces `found_m` is NaN.
  return std::fmin(found_m, z_m - along_ray.least_reading_m(static_cast<float>(z_m)));
}

/// The same of the camera that looks at the place best; NaN where none does. What the robot hides
/// of a surface from all cameras stands beside what some see, and so the worst camera counts.
double untold_m(const FrameSet& frames, const Eigen::Vector3d& place_B_m,
                float SurfaceTolerance::*tolerance, bool may_be_hidden) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  double least_m = kNaN, most_m = kNaN;
  for (const int k : frames.used()) {
    const Frame& frame = *frames.frames()[k];
    const Eigen::Vector3d place_C_m = frames.X_BC(k).inverse() * place_B_m;
    if (!project_into_image(frame.mounted->camera(), place_C_m)) continue;
    const double in_image_m = untold_m(frame, place_C_m.z(), tolerance);
    most_m = std::fmax(most_m, in_image_m);
    const bool is_hidden = may_be_hidden && is_behind_robot(frame, place_C_m);
    if (!is_hidden) least_m = std::fmin(least_m, in_image_m);
  }
  return std::isnan(least_m) ? most_m : least_m;
}

double us_since(LinkSearches::Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(LinkSearches::Clock::now() - begin).count();
}

}  // namespace

LinkSearches::LinkSearches(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), gradient_(robot_->model()) {
  if (robot_->settings().candidates > 1) candidates_.emplace(robot_);
  const RobotModel& model = robot_->model();
  for (const std::size_t index : model.evaluated_links) {
    const Eigen::AlignedBox3f box_L_m = model.links[index].mesh_L.bounding_box_m();
    middles_L_m_.push_back(box_L_m.isEmpty() ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                             : box_L_m.center().cast<double>());
  }
  for (std::size_t index = 0; index < model.links.size(); ++index) {
    const Link& link = model.links[index];
    if (link.role != LinkRole::environment || link.mesh_L.empty()) continue;
    environment_.push_back(index);
    environment_boxes_m_.push_back(link.mesh_L.bounding_box_m().cast<double>());
  }
}

float LinkSearches::assumed_thinner_m(const FrameSet& frames, const RobotPose& pose,
                                      std::size_t i) const {
  const Eigen::Vector3d middle_B_m =
      pose.X_BL[robot_->model().evaluated_links[i]] * middles_L_m_[i];
  // Its middle lies behind its own surface.
  double most_m = untold_m(frames, middle_B_m, &SurfaceTolerance::links_m, false);
  for (std::size_t k = 0; k < environment_.size(); ++k) {
    const Pose& X_BE = pose.X_BL[environment_[k]];
    const Eigen::AlignedBox3d& box_m = environment_boxes_m_[k];
    const Eigen::Vector3d middle_E_m = X_BE.inverse() * middle_B_m;
    const Eigen::Vector3d place_E_m = middle_E_m.cwiseMax(box_m.min()).cwiseMin(box_m.max());
    if ((place_E_m - middle_E_m).norm() > robot_->settings().distance.range_m) continue;
    most_m = std::fmax(most_m,
                       untold_m(frames, X_BE * place_E_m, &SurfaceTolerance::environment_m, true));
  }
  return static_cast<float>(most_m);
}

void LinkSearches::search(const FrameSet& frames, const RobotPose& pose, const MeshRequest& request,
                          std::vector<WholeLinkDistance>& out) {
  mesh_distances(*robot_->patches(), pose, frames.space(), request, workspace_, out);
  if (!frames.undecided().views().empty()) add_undecided(frames, pose, request, out);
}

void LinkSearches::add_undecided(const FrameSet& frames, const RobotPose& pose, MeshRequest request,
                                 std::vector<WholeLinkDistance>& out) {
  request.unknown = false;
  // They are few: a part of the time is enough.
  if (request.deadline_us) request.deadline_us = *request.deadline_us / 8;
  mesh_distances(*robot_->patches(), pose, frames.undecided(), request, undecided_workspace_,
                 undecided_);
  for (std::size_t i = 0; i < out.size(); ++i) {
    SpacePair& nearest = out[i].nearest;
    SpacePair undecided = undecided_[i].occupied;
    const float lower_bound_m = std::min(nearest.lower_bound_m, undecided.lower_bound_m);
    if (undecided.is_known() && !(nearest.distance_m <= undecided.distance_m)) {
      undecided.obstacle_is = ObstacleKind::unknown;
      undecided.camera = frames.place_of_undecided(undecided.camera);
      nearest = undecided;
    }
    nearest.lower_bound_m = lower_bound_m;
  }
}

void LinkSearches::ask(const FrameSet& frames, const RobotPose& pose,
                       const DistanceSettings& settings, std::vector<WholeLinkDistance>& out) {
  search(frames, pose, request_of(settings), out);
}

void LinkSearches::ask(const FrameSet& frames, const RobotPose& pose, Clock::time_point begin,
                       const std::stop_token& stop, Result& out) {
  tell_known(pose, out);
  MeshRequest request = request_of(robot_->settings().distance);
  request.stop = &stop;
  // What follows the search takes about as long as it did the last time.
  if (request.deadline_us) {
    request.deadline_us = std::max(0.0, *request.deadline_us - us_since(begin) - after_search_us_);
  }
  if (candidates_) search_candidates(frames, pose, request);
  search(frames, pose, request, found_);
  const Clock::time_point searched = Clock::now();
  tell_distances(frames, pose, out);
  if (candidates_) candidates_->tell(frames, out);
  if (robot_->settings().gradient) gradient_.tell(out);
  if (robot_->settings().distance.mean_direction) tell_mean_directions(frames, out);
  tell_visibility(frames, pose, out);
  constexpr double kForgotten = 0.95;
  after_search_us_ = std::max(us_since(searched), kForgotten * after_search_us_);
}

void LinkSearches::search_candidates(const FrameSet& frames, const RobotPose& pose,
                                     MeshRequest& request) {
  MeshRequest of_candidates = request;
  // Each link's own pair has the most of the time.
  if (request.deadline_us) {
    of_candidates.deadline_us = *request.deadline_us / 4;
    request.deadline_us = *request.deadline_us - *of_candidates.deadline_us;
  }
  candidates_->search(frames, pose, of_candidates);
}

void LinkSearches::tell_known(const RobotPose& pose, Result& out) {
  known_distances(robot_->known(), pose, request_of(robot_->settings().distance), known_workspace_,
                  known_);
  for (std::size_t i = 0; i < out.links.size(); ++i) out.links[i].known = known_[i];
}

void LinkSearches::forget() {
  known_workspace_.forget();
  workspace_.forget();
  found_.clear();
  if (candidates_) candidates_->forget();
  undecided_workspace_.forget();
  undecided_.clear();
  rejected_workspace_.forget();
  rejected_.clear();
}

void LinkSearches::prepare(const FrameSet& frames, const RobotPose& pose) {
  MeshRequest request = request_of(robot_->settings().distance);
  request.deadline_us.reset();
  search(frames, pose, request, found_);
  if (candidates_) candidates_->search(frames, pose, request);
  if (robot_->settings().visibility) search_rejected(frames, pose);
}

void LinkSearches::go_on_from(const LinkSearches& prepared) {
  workspace_ = prepared.workspace_;
  found_ = prepared.found_;
  candidates_ = prepared.candidates_;
  undecided_workspace_ = prepared.undecided_workspace_;
  undecided_ = prepared.undecided_;
  rejected_workspace_ = prepared.rejected_workspace_;
  rejected_ = prepared.rejected_;
}

void LinkSearches::tell_distances(const FrameSet& frames, const RobotPose& pose,
                                  Result& out) const {
  for (std::size_t i = 0; i < found_.size(); ++i) {
    LinkResult& link = out.links[i];
    static_cast<SpacePair&>(link) = in_frames(found_[i].nearest, frames);
    link.occupied = in_frames(found_[i].occupied, frames);
    link.status = status_of(link, robot_->settings().distance.range_m);
    link.assumed_thinner_m = assumed_thinner_m(frames, pose, i);
    link.robot_point_C_m = link.obstacle_point_C_m = unset_point();
    link.mean_direction_B = link.mean_direction_C = unset_point();
    link.mean_count = 0;
    if (!link.is_known()) continue;
    const Pose X_CB = frames.X_BC(link.camera).inverse();
    link.robot_point_C_m = (X_CB * link.robot_point_B_m.cast<double>()).cast<float>();
    link.obstacle_point_C_m = (X_CB * link.obstacle_point_B_m.cast<double>()).cast<float>();
  }
}

void LinkSearches::tell_mean_directions(const FrameSet& frames, Result& out) {
  direction_views_.clear();
  for (const int k : frames.used()) {
    const Frame& frame = *frames.frames()[k];
    direction_views_.push_back({frame.mounted->camera(), frame.obstacles.depth_m,
                                frame.space->reading_tiles, frames.X_BC(k)});
  }
  for (LinkResult& link : out.links) {
    if (!link.has_distance()) continue;
    const MeanDirection mean = mean_direction(direction_views_, link.robot_point_B_m.cast<double>(),
                                              robot_->settings().distance.range_m);
    link.mean_count = mean.count;
    if (mean.count == 0) continue;
    link.mean_direction_B = mean.direction_B;
    const Pose& X_BC = frames.X_BC(link.camera);
    link.mean_direction_C =
        (X_BC.linear().transpose() * mean.direction_B.cast<double>()).cast<float>();
  }
}

void LinkSearches::tell_visibility(const FrameSet& frames, const RobotPose& pose, Result& out) {
  views_.clear();
  for (const int k : frames.used()) {
    const Frame& frame = *frames.frames()[k];
    const MountedCamera& mounted = *frame.mounted;
    views_.push_back({{mounted.camera(), frame.robot, frame.obstacles,
                       tolerance_of(mounted.settings().self_filter)},
                      frame.space->seen.sensor_depth,
                      frames.X_BC(k).inverse()});
  }
  const DistanceSettings& settings = robot_->settings().distance;
  const SamplePoints& points = robot_->sample_points();
  const RobotModel& model = robot_->model();
  const bool tells = robot_->settings().visibility;
  const bool is_unobserved_told = std::ranges::none_of(frames.used(), [&](int k) {
    return frames.frames()[k]->mounted->settings().space.unobserved.has_value();
  });
  if (tells) find_whole_robot_visibility(model, points, pose, views_, found_, visibility_);
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    if (tells) out.links[i].visibility = visibility_[i];
    const bool has_seen =
        tells ? visibility_[i].surface.seen >= settings.min_seen_share
              : is_seen(views_, points.surface_lanes[i], pose.X_BL[model.evaluated_links[i]],
                        settings.min_seen_share);
    if (!has_seen) {
      out.links[i].status = LinkStatus::not_seen;
      continue;
    }
    if (!is_unobserved_told || out.links[i].status == LinkStatus::cut_short) continue;
    // Shares that are told already need no second look where they are small.
    if (tells && !(visibility_[i].space.outside_image > kMostUnobserved)) continue;
    const double share =
        unobserved_share(views_, model.guarded, out.links[i], points.surface_lanes[i],
                         pose.X_BL[model.evaluated_links[i]], points.unit_ball_lanes);
    if (share > kMostUnobserved) out.links[i].status = LinkStatus::not_observed;
  }
  if (tells) tell_rejected(frames, pose, out);
}

void LinkSearches::search_rejected(const FrameSet& frames, const RobotPose& pose) {
  rejected_.clear();
  if (frames.rejected().views().empty()) return;
  MeshRequest request = request_of(robot_->settings().distance);
  request.unknown = false;
  // Few readings are rejected: a part of the time is enough.
  if (request.deadline_us) request.deadline_us = *request.deadline_us / 8;
  mesh_distances(*robot_->patches(), pose, frames.rejected(), request, rejected_workspace_,
                 rejected_);
}

void LinkSearches::tell_rejected(const FrameSet& frames, const RobotPose& pose, Result& out) {
  search_rejected(frames, pose);
  const double tolerance_m = request_of(robot_->settings().distance).tolerance_m;
  for (std::size_t i = 0; i < rejected_.size(); ++i) {
    const SpacePair& dropped = rejected_[i].occupied;
    LinkResult& kept = out.links[i];
    // A flying patch is unknown space, too: both searches find it, give or take the tolerance.
    const bool is_no_nearer =
        kept.has_distance() && kept.distance_m - tolerance_m <= dropped.distance_m;
    if (!dropped.is_known() || is_no_nearer) continue;
    kept.visibility.rejected_distance_m = dropped.distance_m;
    kept.visibility.rejected_pixel = dropped.obstacle_pixel;
  }
}

struct LookAheadSearch::Workers {
  explicit Workers(const std::shared_ptr<const Robot>& robot)
      : searches([robot] { return LinkSearches(robot); }) {}
  tbb::enumerable_thread_specific<LinkSearches> searches;
};

LookAheadSearch::LookAheadSearch(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), workers_(std::make_unique<Workers>(robot_)) {}

LookAheadSearch::~LookAheadSearch() = default;

void LookAheadSearch::ask(const FrameSet& frames, std::span<const JointState> joints,
                          const DistanceSettings& settings,
                          std::vector<std::vector<WholeLinkDistance>>& out) {
  poses_.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    forward_kinematics(robot_->model(), joints[i].position, poses_[i]);
  }
  out.resize(joints.size());
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
    // Else a waiting thread would begin another pose on top of this one, with its search.
    tbb::this_task_arena::isolate(
        [&] { workers_->searches.local().ask(frames, poses_[i], settings, out[i]); });
  });
}

}  // namespace berth
