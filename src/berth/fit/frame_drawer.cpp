#include "berth/fit/frame_drawer.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "berth/render/robot_renderer.hpp"

namespace berth {
namespace {

/// Half of the time over which joint speeds are measured.
constexpr double kHalfStep_s = 0.005;

/// Where the joints were `shift_s` after the frame's exposure, as it is believed to be.
bool joints_at(const CalibrationData& calibration_data, const CalibrationFrame& frame,
               double clock_offset_s, double shift_s, JointState& joints) {
  if (!calibration_data.joints || shift_s == 0) {
    joints = frame.joints;
    return true;
  }
  const double time_s = frame.joints.stamp_s + clock_offset_s + shift_s;
  return calibration_data.joints->at(time_s, kOnlyBetweenSamples, joints).status == TimeStatus::ok;
}

/// rad/s or m/s; 0 for all where the time lies at the end of the samples.
std::vector<double> joint_speeds(const CalibrationData& calibration_data,
                                 const CalibrationFrame& frame, double clock_offset_s,
                                 double shift_s) {
  JointState before;
  JointState after;
  std::vector<double> speeds(frame.joints.position.size(), 0.0);
  if (!joints_at(calibration_data, frame, clock_offset_s, shift_s - kHalfStep_s, before) ||
      !joints_at(calibration_data, frame, clock_offset_s, shift_s + kHalfStep_s, after)) {
    return speeds;
  }
  for (std::size_t j = 0; j < speeds.size(); ++j) {
    speeds[j] = (after.position[j] - before.position[j]) / (2 * kHalfStep_s);
  }
  return speeds;
}

/// Of what hangs on the joint of this link, in B.
Twist joint_twist_B(const Link& link, const RobotPose& pose) {
  const Pose X_BJ = pose.X_BL[*link.parent] * link.joint.X_PJ;
  const Eigen::Vector3d axis_B = X_BJ.linear() * link.joint.axis_J;
  if (link.joint.type == JointType::prismatic) return {Eigen::Vector3d::Zero(), axis_B};
  return {axis_B, -axis_B.cross(X_BJ.translation())};
}

std::vector<std::vector<Twist>> twists_B(const RobotModel& model, const RobotPose& pose) {
  std::vector<std::vector<Twist>> twists(model.links.size());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    twists[i] =
        link.parent ? twists[*link.parent] : std::vector<Twist>(model.joints.size(), Twist{});
    if (const auto joint = link.joint.position_index) {
      twists[i][*joint] += joint_twist_B(link, pose) * link.joint.multiplier;
    }
  }
  return twists;
}

/// As the camera sees it, which is carried along by its own link.
Twist seen_from(const Pose& X_BC, const Twist& twist_B, const Twist& camera_B) {
  const Eigen::Matrix3d R_CB = X_BC.linear().transpose();
  const Eigen::Vector3d turn_B = twist_B.turn - camera_B.turn;
  const Eigen::Vector3d move_B = twist_B.move - camera_B.move;
  return {R_CB * turn_B, R_CB * (turn_B.cross(X_BC.translation()) + move_B)};
}

}  // namespace

std::optional<PosedRobot> pose_robot(const CalibrationData& calibration_data,
                                     std::size_t camera_index, const CalibrationFrame& frame,
                                     const CalibrationEstimate& estimate,
                                     const PosedRobotRequest& request) {
  const RobotModel& model = *calibration_data.model;
  const CalibrationCamera& camera = *calibration_data.cameras[camera_index];
  const CameraEstimate& believed = estimate.cameras[camera_index];
  JointState joints;
  if (!joints_at(calibration_data, frame, camera.clock_offset_s, believed.clock_shift_s, joints)) {
    return std::nullopt;
  }
  for (std::size_t j = 0; j < joints.position.size(); ++j) {
    joints.position[j] += estimate.joint_shift[j];
  }
  PosedRobot posed;
  forward_kinematics(model, joints.position, posed.pose);
  posed.X_BC = posed.pose.X_BL[camera.parent] * believed.X_PC;
  if (!request.per_joint && !request.per_second) return posed;

  posed.per_joint = twists_B(model, posed.pose);
  const std::vector<Twist> of_camera = posed.per_joint[camera.parent];
  for (std::vector<Twist>& link : posed.per_joint) {
    for (std::size_t j = 0; j < link.size(); ++j) {
      link[j] = seen_from(posed.X_BC, link[j], of_camera[j]);
    }
  }
  if (request.per_second) {
    const std::vector<double> speeds =
        joint_speeds(calibration_data, frame, camera.clock_offset_s, believed.clock_shift_s);
    posed.per_second.resize(model.links.size());
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      for (std::size_t j = 0; j < speeds.size(); ++j) {
        posed.per_second[i] += posed.per_joint[i][j] * speeds[j];
      }
    }
  }
  return posed;
}

namespace {

struct Drawing {
  RobotRenderer renderer;
  RobotImage image;
};
/// By step and camera.
using Drawings = std::map<std::pair<int, std::size_t>, Drawing>;

}  // namespace

struct FrameDrawer::Scratch {
  tbb::enumerable_thread_specific<Drawings> drawings;
};

FrameDrawer::FrameDrawer(const CalibrationData& calibration_data, const std::vector<int>& steps)
    : data_(calibration_data), scratch_(std::make_unique<Scratch>()) {
  for (const int step : steps) {
    if (levels_.count(step) > 0) continue;
    for (const CalibrationCamera* camera : calibration_data.cameras) {
      levels_[step].push_back(make_level(*camera, step));
    }
  }
}

FrameDrawer::~FrameDrawer() = default;

void FrameDrawer::draw(int step, const CalibrationEstimate& estimate,
                       const PosedRobotRequest& request, FrameChoice choice,
                       const std::function<void(const DrawnFrame&)>& take) {
  const std::vector<ImageLevel>& levels = levels_.at(step);
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  for (std::size_t c = 0; c < levels.size(); ++c) {
    for (std::size_t f = 0; f < levels[c].depth_m.size(); ++f) {
      if (is_chosen(choice, f)) chosen.emplace_back(c, f);
    }
  }
  const auto draw_one = [&](const std::pair<std::size_t, std::size_t>& which) {
    const auto [c, f] = which;
    const auto posed = pose_robot(data_, c, data_.cameras[c]->frames[f], estimate, request);
    if (!posed) return;
    Drawings& drawings = scratch_->drawings.local();
    auto found = drawings.find({step, c});
    if (found == drawings.end()) {
      Drawing fresh{RobotRenderer(data_.meshes, levels[c].camera), {}};
      found = drawings.emplace(std::pair(step, c), std::move(fresh)).first;
    }
    Drawing& drawing = found->second;
    drawing.renderer.render(posed->pose, posed->X_BC, drawing.image);
    take({c, f, step, levels[c].camera, levels[c].depth_m[f], *posed, drawing.image});
  };
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
    // Else a thread that waits inside could take a second frame, and draw it into the same image.
    tbb::this_task_arena::isolate([&] { draw_one(chosen[i]); });
  });
}

namespace {

/// The pixel that stands for the block of step x step pixels lies in its middle.
int middle_of(int step) { return step / 2; }

Camera thinned(const Camera& camera, int step) {
  const double middle = middle_of(step);
  return {camera.width_px / step, camera.height_px / step,        camera.fx_px / step,
          camera.fy_px / step,    (camera.cx_px - middle) / step, (camera.cy_px - middle) / step};
}

DepthImage thinned(const DepthImage& depth_m, int step) {
  DepthImage out(depth_m.width() / step, depth_m.height() / step);
  for (int v = 0; v < out.height(); ++v) {
    const float* from = depth_m.row(v * step + middle_of(step)) + middle_of(step);
    for (int u = 0; u < out.width(); ++u) out(u, v) = from[u * step];
  }
  return out;
}

}  // namespace

ImageLevel make_level(const CalibrationCamera& camera, int step) {
  ImageLevel level{step, thinned(camera.camera, step), {}};
  for (const CalibrationFrame& frame : camera.frames) {
    level.depth_m.push_back(thinned(frame.depth_m, step));
  }
  return level;
}

}  // namespace berth
