#include "berth/calibration/evidence_view.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "berth/fit/frame_drawer.hpp"
#include "berth/fit/robot_pixels.hpp"
#include "berth/self_filter/drop_soft.hpp"
#include "berth/self_filter/self_filter.hpp"

namespace berth {
namespace {

/// The link that all of its group hang on, by fixed joints: the first of them.
std::size_t first_of_group(const RobotModel& model, std::size_t link) {
  while (model.links[link].parent && model.links[link].joint.type == JointType::fixed) {
    link = *model.links[link].parent;
  }
  return link;
}

int joints_above(const RobotModel& model, std::size_t link) {
  int joints = 0;
  for (std::optional<std::size_t> at = link; at; at = model.links[*at].parent) {
    joints += model.links[*at].joint.type != JointType::fixed;
  }
  return joints;
}

/// X_FL: the pose of a link in the frame F of the first of its group.
Pose pose_in_group(const RobotModel& model, std::size_t link, std::size_t first) {
  Pose X_FL = Pose::Identity();
  for (; link != first; link = *model.links[link].parent) {
    X_FL = model.links[link].joint.X_PJ * X_FL;
  }
  return X_FL;
}

/// Neighbouring pixels that are looked at lie about so far apart on what is 1 m away.
constexpr double kPixel_m = 0.003;
/// The uncertainty, of the median of what readings are off.
constexpr double kSpread = 2.5;
constexpr double kLeastUncertainty_m = 0.010;
constexpr double kMostUncertainty_m = 0.025;
/// The most pixels to each side of a point that are looked at.
constexpr int kSamplesToASide = 3;
/// Nearer to the camera nothing is looked at.
constexpr double kLeastDepth_m = 0.1;
/// What padding has to leave of the robot, where a camera sees it wider than it is.
constexpr double kEvidencePadding_m = 0.03;

ReadingKind kind_of(PixelFate fate, float z_m, float robot_m, float tolerance_m) {
  if (is_kept(fate)) return ReadingKind::fixed;
  if (fate == PixelFate::no_reading || fate == PixelFate::robot || fate == PixelFate::environment) {
    return ReadingKind::robot;
  }
  return std::abs(z_m - robot_m) < tolerance_m ? ReadingKind::robot : ReadingKind::beside;
}

EvidenceView take_view(const DrawnFrame& drawn, const RobotModel& model,
                       const CalibrationCamera& source, const CameraCalibration& found) {
  const CalibrationFrame& frame = source.frames[drawn.frame_index];
  const DepthImage depth_m = corrected(frame.depth_m, found.depth);
  SelfFilterSettings filter;
  filter.padding_m = kEvidencePadding_m;
  SelfFilterWorkspace workspace;
  ObstacleImage filtered;
  self_filter(source.camera, depth_m, drawn.robot, filter, workspace, filtered);
  std::vector<PosedSoftBody> soft;
  pose_soft_bodies(model, drawn.posed.pose, drawn.posed.X_BC, soft);
  drop_soft(source.camera, soft, filtered);

  const int step = std::max(1, static_cast<int>(std::lround(kPixel_m * source.camera.fx_px)));
  CalibrationCamera no_frames;
  no_frames.camera = source.camera;
  const ImageLevel level = make_level(no_frames, step);
  EvidenceView view;
  view.frame_number = frame.number;
  view.camera = level.camera;
  view.X_BC = drawn.posed.X_BC;
  view.X_CB = view.X_BC.inverse();
  view.pose = drawn.posed.pose;
  view.depth_m.resize(level.camera.width_px, level.camera.height_px, kNoDepth);
  view.kind.resize(level.camera.width_px, level.camera.height_px, ReadingKind::robot);
  for (int v = 0; v < view.depth_m.height(); ++v) {
    for (int u = 0; u < view.depth_m.width(); ++u) {
      const float z_m = depth_m(step * u, step * v);
      view.depth_m(u, v) = z_m;
      view.kind(u, v) =
          kind_of(filtered.fate(step * u, step * v), z_m, drawn.robot.depth_m(step * u, step * v),
                  static_cast<float>(filter.tolerance_m));
    }
  }
  // Of readings of the robot itself, which a joint that is off moves as it does what is carried.
  const double spread_m = std::isnan(found.after.median_m) ? 0 : kSpread * found.after.median_m;
  view.uncertainty_m = std::clamp(spread_m, kLeastUncertainty_m, kMostUncertainty_m);
  return view;
}

/// The pixels within a length of a point, as samples, and the point in C.
struct Window {
  Eigen::Vector3d p_C_m;
  PixelRect rect;
  Pixel middle;
  int stride = 1;
};

std::optional<Window> window_at(const EvidenceView& view, const Eigen::Vector3d& p_B_m,
                                double reach_m) {
  Window window{view.X_CB * p_B_m, {}, {}, 1};
  if (window.p_C_m.z() < kLeastDepth_m) return std::nullopt;
  const std::optional<Pixel> middle = pixel_of(view.camera, window.p_C_m);
  if (!middle) return std::nullopt;
  window.middle = *middle;
  const int reach_px =
      std::max(1, static_cast<int>(std::ceil(view.camera.fx_px * reach_m / window.p_C_m.z())));
  window.stride = (reach_px + kSamplesToASide - 1) / kSamplesToASide;
  const int half_px = reach_px / window.stride * window.stride;
  window.rect = {middle->u - half_px, middle->v - half_px, middle->u + half_px + 1,
                 middle->v + half_px + 1};
  return window;
}

/// Whether all of test(u, v) hold, in the image.
template <class Test>
bool all_of(const EvidenceView& view, const Window& window, const Test& test) {
  for (int v = window.rect.v_begin; v < window.rect.v_end; v += window.stride) {
    if (v < 0 || v >= view.camera.height_px) continue;
    for (int u = window.rect.u_begin; u < window.rect.u_end; u += window.stride) {
      if (u >= 0 && u < view.camera.width_px && !test(u, v)) return false;
    }
  }
  return true;
}

bool is_within_reach(const std::vector<RigidGroup>& groups, const std::vector<Pose>& X_LB,
                     const Eigen::Vector3d& p_B_m) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].reach_L_m.contains(X_LB[g] * p_B_m)) return true;
  }
  return false;
}

/// Whether the same camera ever sees the place free: to another one, whose pose is as uncertain,
/// what stands still could seem to have moved.
bool is_free_elsewhere(const std::vector<EvidenceView>& views, std::size_t own,
                       const Eigen::Vector3d& p_B_m) {
  for (std::size_t other = 0; other < views.size(); ++other) {
    if (other == own || views[other].camera_index != views[own].camera_index) continue;
    if (sees_free(views[other], p_B_m)) return true;
  }
  return false;
}

void find_moving_in(const std::vector<RigidGroup>& groups, std::size_t own,
                    std::vector<EvidenceView>& views) {
  EvidenceView& view = views[own];
  std::vector<Pose> X_LB;
  for (const RigidGroup& group : groups) X_LB.push_back(view.pose.X_BL[group.link].inverse());
  for (int v = 0; v < view.kind.height(); ++v) {
    for (int u = 0; u < view.kind.width(); ++u) {
      ReadingKind& kind = view.kind(u, v);
      if (kind == ReadingKind::robot) continue;
      const Eigen::Vector3d p_B_m = view.point_B_m(u, v);
      if (!is_within_reach(groups, X_LB, p_B_m) || !is_free_elsewhere(views, own, p_B_m)) continue;
      kind = kind == ReadingKind::beside ? ReadingKind::moving_beside : ReadingKind::moving;
    }
  }
}

}  // namespace

Eigen::Vector3d EvidenceView::point_B_m(int u, int v) const {
  return X_BC * point_at(camera, u, v, depth_m(u, v));
}

std::vector<EvidenceView> make_evidence_views(const CalibrationData& calibration_data,
                                              const CalibrationResult& found) {
  std::vector<EvidenceView> views;
  for (std::size_t c = 0; c < calibration_data.cameras.size(); ++c) {
    if (!found.cameras[c].is_found) continue;
    CalibrationData one = calibration_data;
    one.cameras = {calibration_data.cameras[c]};
    std::vector<EvidenceView> taken(one.cameras[0]->frames.size());
    FrameDrawer(one, {1}).draw(1, found_estimate(one, found.cameras[c], found), {},
                               FrameChoice::all, [&](const DrawnFrame& drawn) {
                                 taken[drawn.frame_index] = take_view(
                                     drawn, *one.model, *one.cameras[0], found.cameras[c]);
                               });
    for (EvidenceView& view : taken) {
      if (view.pose.X_BL.empty()) continue;
      view.camera_index = c;
      views.push_back(std::move(view));
    }
  }
  return views;
}

bool sees_free(const EvidenceView& view, const Eigen::Vector3d& p_B_m) {
  const std::optional<Window> window = window_at(view, p_B_m, view.uncertainty_m);
  if (!window) return false;
  const auto far_m = static_cast<float>(window->p_C_m.z() + view.uncertainty_m);
  // No reading at the point itself says nothing, one beside it neither yes nor no.
  if (!(view.depth_m(window->middle.u, window->middle.v) > far_m)) return false;
  return all_of(view, *window, [&](int u, int v) { return !(view.depth_m(u, v) <= far_m); });
}

bool may_hide(const EvidenceView& view, const Eigen::Vector3d& p_B_m) {
  const Eigen::Vector3d p_C_m = view.X_CB * p_B_m;
  if (p_C_m.z() < kLeastDepth_m) return true;
  const std::optional<Pixel> at = pixel_of(view.camera, p_C_m);
  if (!at) return true;
  const double behind_m = view.depth_m(at->u, at->v) - p_C_m.z();
  if (view.kind(at->u, at->v) != ReadingKind::fixed) return !(behind_m > 0);
  return !(behind_m > -view.uncertainty_m);
}

bool sees_moving(const EvidenceView& view, const Eigen::Vector3d& p_B_m) {
  const std::optional<Window> window = window_at(view, p_B_m, view.uncertainty_m);
  if (!window) return false;
  const double most_m2 = view.uncertainty_m * view.uncertainty_m;
  return !all_of(view, *window, [&](int u, int v) {
    if (view.kind(u, v) < ReadingKind::moving_beside) return true;
    const Eigen::Vector3d read_C_m = point_at(view.camera, u, v, view.depth_m(u, v));
    return (read_C_m - window->p_C_m).squaredNorm() > most_m2;
  });
}

void find_moving(const std::vector<RigidGroup>& groups, std::vector<EvidenceView>& views) {
  tbb::parallel_for(std::size_t{0}, views.size(),
                    [&](std::size_t own) { find_moving_in(groups, own, views); });
}

std::vector<RigidGroup> moved_groups(const RobotModel& model) {
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    if (model.links[link].role != LinkRole::evaluated) continue;
    if (model.is_moved(link)) members[first_of_group(model, link)].push_back(link);
  }
  std::vector<RigidGroup> groups;
  for (const auto& [first, links] : members) {
    RigidGroup group{links.back(), joints_above(model, first), {}};
    const Pose X_LF = pose_in_group(model, group.link, first).inverse();
    for (const std::size_t link : links) {
      const Pose X_LM = X_LF * pose_in_group(model, link, first);
      for (const Eigen::Vector3f& p_M_m : model.links[link].mesh_L.vertices_m) {
        group.reach_L_m.extend(X_LM * p_M_m.cast<double>());
      }
    }
    if (group.reach_L_m.isEmpty()) continue;
    group.reach_L_m.extend(group.reach_L_m.min() - Eigen::Vector3d::Constant(kReach_m));
    group.reach_L_m.extend(group.reach_L_m.max() + Eigen::Vector3d::Constant(kReach_m));
    groups.push_back(group);
  }
  return groups;
}

}  // namespace berth
