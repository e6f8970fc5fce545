#include "berth/calibration/attached_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/calibration/closed_surface.hpp"

namespace berth {
namespace {

/// More parts than these nobody carries.
constexpr int kMostParts = 8;
/// Of two groups that explain nearly as much, the one nearer to the tip carries the part.
constexpr double kAlike = 0.9;
/// Two frames show different poses where a group moves by this: a point 30 cm beside its frame.
constexpr double kOtherPose_m = 0.04;
constexpr double kLever_m = 0.3;

double apart_m(const RobotPose& a, const RobotPose& b, const std::vector<RigidGroup>& groups) {
  double farthest_m = 0;
  for (const RigidGroup& group : groups) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d p_L_m = kLever_m * Eigen::Vector3d::Unit(axis);
      farthest_m =
          std::max(farthest_m, (a.X_BL[group.link] * p_L_m - b.X_BL[group.link] * p_L_m).norm());
    }
  }
  return farthest_m;
}

std::size_t count_poses(const std::vector<EvidenceView>& views,
                        const std::vector<RigidGroup>& groups) {
  std::vector<const RobotPose*> poses;
  for (const EvidenceView& view : views) {
    const bool is_known = std::any_of(poses.begin(), poses.end(), [&](const RobotPose* other) {
      return apart_m(view.pose, *other, groups) < kOtherPose_m;
    });
    if (!is_known) poses.push_back(&view.pose);
  }
  return poses.size();
}

/// The piece that explains most, of the group nearest to the tip where several explain it alike;
/// none where no piece is proven.
std::optional<CarriedCells> best_piece(const std::vector<RigidGroup>& groups,
                                       const std::vector<EvidenceView>& views,
                                       const std::vector<MovingReading>& readings,
                                       const std::function<void()>& pause) {
  std::vector<CarriedCells> pieces;
  for (const RigidGroup& group : groups) {
    pause();
    for (CarriedCells& piece : find_carried_cells(group, views, readings)) {
      pieces.push_back(std::move(piece));
    }
  }
  if (pieces.empty()) return std::nullopt;
  const int most = std::ranges::max(pieces, {}, [](const CarriedCells& piece) {
                     return piece.explains;
                   }).explains;
  std::erase_if(pieces, [&](const CarriedCells& piece) { return piece.explains < kAlike * most; });
  return std::ranges::max(pieces, {}, [](const CarriedCells& piece) {
    return std::pair(piece.group.joints, piece.explains);
  });
}

/// Marks the readings of the body, and returns how many of them the self filter leaves.
int explain(const RigidGroup& group, const SolidCells& solid,
            const std::vector<EvidenceView>& views, std::vector<MovingReading>& readings) {
  int count = 0;
  for (MovingReading& reading : readings) {
    if (reading.is_explained) continue;
    const Eigen::Vector3d p_L_m =
        views[reading.view].pose.X_BL[group.link].inverse() * reading.p_B_m;
    const int reach = static_cast<int>(views[reading.view].uncertainty_m / kCell_m);
    bool is_near = false;
    each_cell_around(cell_of(p_L_m), reach,
                     [&](const Cell& cell) { is_near = is_near || solid.contains(cell); });
    if (!is_near) continue;
    reading.is_explained = true;
    count += reading.is_left;
  }
  return count;
}

double worst_uncertainty_m(const std::vector<EvidenceView>& views) {
  return std::ranges::max(views, {}, &EvidenceView::uncertainty_m).uncertainty_m;
}

std::string new_name(const RobotModel& model, const std::string& link,
                     const std::vector<AttachedPart>& others) {
  const auto is_known = [&](const std::string& name) {
    return model.find_link(name).has_value() ||
           std::ranges::find(others, name, &AttachedPart::name) != others.end();
  };
  const std::string first = link + "_attached";
  std::string name = first;
  for (int i = 2; is_known(name); ++i) name = fmt::format("{}_{}", first, i);
  return name;
}

AttachedPart part_of(const CarriedCells& piece, const SolidCells& solid,
                     const std::vector<EvidenceView>& views, const RobotModel& model) {
  AttachedPart part;
  part.link = model.links[piece.group.link].name;
  part.padding_m = std::max(kLeastSurfacePadding_m, worst_uncertainty_m(views) / 2);
  part.mesh_L = closed_surface(solid, part.padding_m);
  part.size_m = kCell_m * solid.size.cast<double>();
  part.places = piece.places;
  for (const std::size_t k : piece.seen_in) {
    part.seen_in.push_back({views[k].camera_index, views[k].frame_number});
  }
  return part;
}

}  // namespace

Attachment attachment_of(const AttachedPart& part) {
  return {part.name, part.link, part.mesh_L, Pose::Identity(), true};
}

AttachedParts find_attached_parts(const CalibrationData& calibration_data,
                                  const CalibrationResult& found,
                                  const std::function<void()>& pause) {
  AttachedParts result;
  const RobotModel& model = *calibration_data.model;
  const std::vector<RigidGroup> groups = moved_groups(model);
  std::vector<EvidenceView> views = make_evidence_views(calibration_data, found);
  const std::size_t poses = count_poses(views, groups);
  if (poses < kLeastPosesForAttached) {
    result.refused = fmt::format(
        "what the robot carries was not looked for: {} different {} of the arm; expected {} or "
        "more",
        poses, poses == 1 ? "pose" : "poses", kLeastPosesForAttached);
    return result;
  }
  find_moving(groups, views);
  std::vector<MovingReading> readings = moving_readings(views);
  const auto all = std::ranges::count_if(readings, &MovingReading::is_left);
  for (int i = 0; i < kMostParts; ++i) {
    const std::optional<CarriedCells> piece = best_piece(groups, views, readings, pause);
    if (!piece) break;
    const SolidCells solid = solid_of(*piece, views, readings);
    AttachedPart part = part_of(*piece, solid, views, model);
    part.name = new_name(model, part.link, result.parts);
    part.explained_share = static_cast<double>(explain(piece->group, solid, views, readings)) /
                           static_cast<double>(all);
    result.parts.push_back(std::move(part));
  }
  return result;
}

}  // namespace berth
