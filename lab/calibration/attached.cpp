#include "lab/calibration/attached.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "berth/fit/robot_pixels.hpp"
#include "lab/measure/stopwatch.hpp"
#include "sim/nearest_on_mesh.hpp"
#include "sim/winding_number.hpp"

namespace berth::lab {
namespace {

constexpr double kGrid_m = 0.01;
constexpr double kNear_m = 0.01;
/// So much of the room may lie in what pads a thing.
constexpr double kPadding_m = 0.02;
constexpr int kRoomStep_px = 4;
/// So the cells are other ones.
constexpr std::uint32_t kCompanySeed = 1000;
constexpr double kCompanyOffset_m = 0.005;
constexpr double kCompanyOffset_rad = 0.005;

bool is_inside(const TriangleMesh& mesh, const Eigen::Vector3d& p_m) {
  return sim::winding_number(mesh, p_m) > 0.5;
}

/// Calls visit(p) at the points of a grid in the box.
template <class Visit>
void each_point(const Eigen::AlignedBox3f& box, const Visit& visit) {
  for (double z = box.min().z(); z <= box.max().z(); z += kGrid_m) {
    for (double y = box.min().y(); y <= box.max().y(); y += kGrid_m) {
      for (double x = box.min().x(); x <= box.max().x(); x += kGrid_m) visit({x, y, z});
    }
  }
}

/// Of the part's points, those within 1 cm of the thing.
double precision_of(const TriangleMesh& part_L, const sim::DrawnThing& thing) {
  int all = 0;
  int near = 0;
  each_point(part_L.bounding_box_m(), [&](const Eigen::Vector3d& p_L_m) {
    if (!is_inside(part_L, p_L_m)) return;
    ++all;
    near += thing.distance_m(p_L_m) <= kNear_m;
  });
  return static_cast<double>(near) / all;
}

/// Of the thing's points, those within 1 cm of the part.
double recall_of(const TriangleMesh& part_L, const sim::DrawnThing& thing) {
  const sim::NearestOnMesh to_part(part_L);
  int all = 0;
  int near = 0;
  each_point(thing.mesh_L().bounding_box_m(), [&](const Eigen::Vector3d& p_L_m) {
    if (thing.distance_m(p_L_m) > 0) return;
    ++all;
    near += to_part(p_L_m, kNear_m).distance_m <= kNear_m || is_inside(part_L, p_L_m);
  });
  return static_cast<double>(near) / all;
}

int count_room_points(const RobotModel& model, const sim::DrawnCarryingCell& cell,
                      const AttachedPart& part) {
  const std::size_t link = *model.find_link(part.link);
  const Eigen::AlignedBox3d box_L_m = part.mesh_L.bounding_box_m().cast<double>();
  const Camera& camera = cell.settings.camera;
  int count = 0;
  for (const Pose& X_BC : cell.settings.X_BC) {
    const DepthImage room_m = sim::cast_obstacles(cell.settings.room, camera, X_BC);
    for (const std::vector<double>& positions : cell.settings.positions) {
      RobotPose pose;
      forward_kinematics(model, positions, pose);
      for (int v = 0; v < camera.height_px; v += kRoomStep_px) {
        for (int u = 0; u < camera.width_px; u += kRoomStep_px) {
          const Eigen::Vector3d p_B_m = X_BC * point_at(camera, u, v, room_m(u, v));
          const Eigen::Vector3d p_L_m = pose.X_BL[link].inverse() * p_B_m;
          if (!box_L_m.contains(p_L_m) || !is_inside(part.mesh_L, p_L_m)) continue;
          const bool is_own = link == cell.thing.link && cell.thing.distance_m(p_L_m) < kPadding_m;
          count += !is_own;
        }
      }
    }
  }
  return count;
}

bool is_shown(const RobotModel& model, const sim::DrawnThing& thing, const Pose& X_BC,
              const CalibrationCamera& camera, const CalibrationFrame& frame) {
  RobotPose pose;
  forward_kinematics(model, frame.joints.position, pose);
  const Pose X_LC = pose.X_BL[thing.link].inverse() * X_BC;
  int shown_px = 0;
  for (int v = 0; v < camera.camera.height_px; v += 2) {
    for (int u = 0; u < camera.camera.width_px; u += 2) {
      if (std::isnan(frame.depth_m(u, v))) continue;
      const Eigen::Vector3d p_L_m = X_LC * point_at(camera.camera, u, v, frame.depth_m(u, v));
      shown_px += thing.distance_m(p_L_m) <= kNear_m;
    }
  }
  return shown_px >= kShown_px;
}

int count_poses_shown(const RobotModel& model, const sim::DrawnCarryingCell& cell,
                      const sim::CarryingRobot& drawn) {
  if (cell.thing.pieces.empty()) return 0;
  int count = 0;
  for (std::size_t k = 0; k < cell.settings.positions.size(); ++k) {
    bool is_shown_by_any = false;
    for (std::size_t c = 0; c < drawn.cameras.size(); ++c) {
      is_shown_by_any |= is_shown(model, cell.thing, cell.settings.X_BC[c], *drawn.cameras[c],
                                  drawn.cameras[c]->frames[k]);
    }
    count += is_shown_by_any;
  }
  return count;
}

}  // namespace

AttachedTrial try_attached(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                           sim::DrawnKind kind, int poses, int cameras, std::uint32_t seed) {
  const sim::DrawnCarryingCell cell = sim::draw_carrying_cell(model, kind, poses, cameras, seed);
  const sim::CarryingRobot drawn =
      sim::draw_carrying_robot(model, std::move(meshes), cell.settings, seed);
  for (std::size_t c = 0; c < drawn.cameras.size(); ++c) {
    drawn.cameras[c]->X_PC =
        sim::miscalibrated(cell.settings.X_BC[c], 0.02, 2 * std::numbers::pi / 180,
                           seed + static_cast<std::uint32_t>(c));
  }
  const CalibrationResult found = calibrate(drawn.calibration_data, {.is_near = true});
  const Stopwatch stopwatch;
  const AttachedParts attached = find_attached_parts(drawn.calibration_data, found);
  AttachedTrial trial;
  trial.time_s = stopwatch.ms() / 1000;
  trial.parts = static_cast<int>(attached.parts.size());
  trial.poses_shown = count_poses_shown(model, cell, drawn);
  trial.precision = trial.recall = std::numeric_limits<double>::quiet_NaN();
  for (const AttachedPart& part : attached.parts) {
    trial.room_points += count_room_points(model, cell, part);
    trial.explained_share += part.explained_share;
    const bool is_own =
        !cell.thing.pieces.empty() && part.link == model.links[cell.thing.link].name;
    const double precision = is_own ? precision_of(part.mesh_L, cell.thing) : 0;
    if (!(precision >= 0.5)) {
      ++trial.false_parts;
    } else if (!trial.is_found) {
      trial.is_found = true;
      trial.precision = precision;
      trial.recall = recall_of(part.mesh_L, cell.thing);
    }
  }
  return trial;
}

AttachedParts try_company(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                          sim::DrawnCompany company, int poses, int cameras, std::uint32_t seed) {
  sim::DrawnCarryingCell cell =
      sim::draw_carrying_cell(model, sim::DrawnKind::bare, poses, cameras, kCompanySeed + seed);
  sim::Random random(seed);
  sim::add_company(random, model, company, cell.settings);
  sim::CarryingRobot drawn =
      sim::draw_carrying_robot(model, std::move(meshes), cell.settings, seed);
  for (std::size_t c = 0; c < drawn.cameras.size(); ++c) {
    Pose& X_PC = drawn.found.cameras[c].X_PC;
    X_PC = sim::miscalibrated(X_PC, kCompanyOffset_m, kCompanyOffset_rad,
                              seed + static_cast<std::uint32_t>(c));
  }
  return find_attached_parts(drawn.calibration_data, drawn.found);
}

}  // namespace berth::lab
