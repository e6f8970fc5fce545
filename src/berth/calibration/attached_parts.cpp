#include "berth/calibration/attached_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/calibration/closed_surface.hpp"
#include "berth/calibration/part_solid.hpp"

namespace berth {
namespace {

/// More parts than these nobody carries.
constexpr int kMostParts = 8;
/// Of two groups that explain nearly as much, the one nearer to the tip carries the part.
constexpr double kAlike = 0.9;
/// Of what comes and goes near the robot, the parts have to explain so much. Else something moves
/// there on its own, and some of it may fit a link by chance.
constexpr double kLeastExplained = 0.5;
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

/// A surface that is known to the views' uncertainty lies half of that farther out, as a rule.
double padding_of(const std::vector<EvidenceView>& views) {
  const double worst_m = std::ranges::max(views, {}, &EvidenceView::uncertainty_m).uncertainty_m;
  return std::max(kLeastSurfacePadding_m, worst_m / 2);
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

AttachedPart part_of(const CarriedCells& piece, const SolidCells& solid, double padding_m,
                     const std::vector<EvidenceView>& views, const RobotModel& model) {
  AttachedPart part;
  part.link = model.links[piece.group.link].name;
  part.padding_m = padding_m;
  part.mesh_L = closed_surface(solid, padding_m);
  part.size_m = part.mesh_L.bounding_box_m().sizes().cast<double>();
  const auto hidden = std::ranges::count_if(part.mesh_L.vertices_m, [&](const auto& p_L_m) {
    return is_hidden(p_L_m.template cast<double>(), piece.group.link, views);
  });
  part.hidden_share =
      static_cast<double>(hidden) / static_cast<double>(part.mesh_L.vertices_m.size());
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
  const auto all = static_cast<double>(std::ranges::count_if(readings, &MovingReading::is_left));
  const double padding_m = padding_of(views);
  double explained_share = 0;
  for (int i = 0; i < kMostParts; ++i) {
    const std::optional<CarriedCells> piece = best_piece(groups, views, readings, pause);
    if (!piece) break;
    const SolidCells solid = solid_of(*piece, views, readings, padding_m);
    AttachedPart part = part_of(*piece, solid, padding_m, views, model);
    part.name = new_name(model, part.link, result.parts);
    part.explained_share = explain(piece->group, solid, views, readings) / all;
    explained_share += part.explained_share;
    result.parts.push_back(std::move(part));
  }
  if (!result.parts.empty() && explained_share < kLeastExplained) {
    result.parts.clear();
    result.refused = fmt::format(
        "what the robot carries was not found: {:.0f} % of the readings that come and go near it "
        "fit none of its links; expected images in which nothing else moves",
        100 * (1 - explained_share));
  }
  return result;
}

}  // namespace berth
