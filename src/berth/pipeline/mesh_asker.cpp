#include "berth/pipeline/mesh_asker.hpp"

#include "berth/pipeline/view.hpp"

namespace berth {
namespace {

constexpr double kDefaultTolerance_m = 0.001;

MeshQuestion question_of(const DistanceSettings& settings) {
  return {.range_m = settings.range_m,
          .tolerance_m = settings.tolerance_m.value_or(kDefaultTolerance_m),
          .deadline_us = settings.deadline_us};
}

LinkStatus status_of(const SpacePair& nearest, double range_m) {
  if (nearest.is_known()) return LinkStatus::ok;
  return nearest.lower_bound_m >= static_cast<float>(range_m) ? LinkStatus::none_in_range
                                                              : LinkStatus::cut_short;
}

/// The place of a view among all frames of the question.
SpacePair in_frames(SpacePair pair, const FrameSet& frames) {
  if (pair.is_known()) pair.view = frames.used()[pair.view];
  return pair;
}

}  // namespace

MeshAsker::MeshAsker(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {}

void MeshAsker::ask(const FrameSet& frames, const RobotPose& pose,
                    std::vector<WholeLinkDistance>& out) {
  mesh_distances(*robot_->patches(), pose, frames.space(),
                 question_of(robot_->settings().distance), workspace_, out);
}

void MeshAsker::ask(const FrameSet& frames, const RobotPose& pose, Answer& out) {
  ask(frames, pose, found_);
  tell_distances(frames, out.distances);
  if (robot_->settings().distance.mean_direction) tell_mean_directions(frames, out.distances);
  tell_visibility(frames, pose, out);
}

void MeshAsker::forget() {
  workspace_.forget();
  found_.clear();
  doubtful_workspace_.forget();
  doubtful_.clear();
}

void MeshAsker::tell_distances(const FrameSet& frames, LinkDistances& out) const {
  out.pairs = 0;
  out.links.resize(found_.size());
  for (std::size_t i = 0; i < found_.size(); ++i) {
    LinkDistance& link = out.links[i];
    link = {};
    link.id = found_[i].id;
    link.status = status_of(found_[i].nearest, robot_->settings().distance.range_m);
    link.reading = in_frames(found_[i].reading, frames);
    const SpacePair pair = in_frames(found_[i].nearest, frames);
    link.lower_bound_m = pair.lower_bound_m;
    if (!pair.is_known()) continue;
    link.distance_m = pair.distance_m;
    link.view = pair.view;
    link.obstacle_kind = pair.kind;
    link.obstacle_pixel = pair.obstacle_pixel;
    link.robot_point_B_m = pair.robot_point_B_m;
    link.obstacle_point_B_m = pair.obstacle_point_B_m;
    const Pose X_CB = frames.frames()[pair.view]->X_BC.inverse();
    link.robot_point_C_m = (X_CB * pair.robot_point_B_m.cast<double>()).cast<float>();
    link.obstacle_point_C_m = (X_CB * pair.obstacle_point_B_m.cast<double>()).cast<float>();
  }
}

void MeshAsker::tell_mean_directions(const FrameSet& frames, LinkDistances& out) {
  direction_views_.clear();
  for (const int k : frames.used()) {
    const Frame& frame = *frames.frames()[k];
    direction_views_.push_back(
        {frame.view->camera(), frame.obstacles.depth_m, frame.reading_tiles, frame.X_BC});
  }
  for (LinkDistance& link : out.links) {
    if (!link.has_distance()) continue;
    const MeanDirection mean =
        mean_direction(direction_views_, link.robot_point_B_m.cast<double>(),
                       robot_->settings().distance.range_m);
    link.mean_count = mean.count;
    if (mean.count == 0) continue;
    link.mean_direction_B = mean.direction_B;
    const Frame& frame = *frames.frames()[link.view];
    link.mean_direction_C =
        (frame.X_BC.linear().transpose() * mean.direction_B.cast<double>()).cast<float>();
  }
}

void MeshAsker::tell_visibility(const FrameSet& frames, const RobotPose& pose, Answer& out) {
  views_.clear();
  for (const int k : frames.used()) {
    const Frame& frame = *frames.frames()[k];
    const View& view = *frame.view;
    views_.push_back({{view.camera(), frame.robot, frame.obstacles,
                       tolerance_of(view.settings().self_filter)},
                      frame.space.sensor_depth_m,
                      frame.X_BC.inverse()});
  }
  const DistanceSettings& settings = robot_->settings().distance;
  const SamplePoints& points = robot_->sample_points();
  const RobotModel& model = robot_->model();
  for (std::size_t i = 0; i < out.distances.links.size(); ++i) {
    const Pose& X_BL = pose.X_BL[model.evaluated_links[i]];
    if (is_seen(views_, points.surface[i], X_BL, settings.min_seen_share)) continue;
    out.distances.links[i].status = LinkStatus::not_seen;
  }
  if (!robot_->settings().visibility) return;
  find_whole_robot_visibility(model, points, pose, views_, out.distances, out.visibility);
  tell_doubtful(frames, pose, out);
}

void MeshAsker::tell_doubtful(const FrameSet& frames, const RobotPose& pose, Answer& out) {
  if (frames.doubtful().views().empty()) return;
  MeshQuestion question = question_of(robot_->settings().distance);
  question.hidden = false;
  mesh_distances(*robot_->patches(), pose, frames.doubtful(), question, doubtful_workspace_,
                 doubtful_);
  for (std::size_t i = 0; i < doubtful_.size(); ++i) {
    const SpacePair& dropped = doubtful_[i].reading;
    const LinkDistance& kept = out.distances.links[i];
    if (!dropped.is_known() || (kept.has_distance() && kept.distance_m <= dropped.distance_m)) {
      continue;
    }
    out.visibility[i].doubtful_distance_m = dropped.distance_m;
    out.visibility[i].doubtful_pixel = dropped.obstacle_pixel;
  }
}

}  // namespace berth
