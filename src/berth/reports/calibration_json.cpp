#include "berth/reports/calibration_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace berth {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPerUnit = 1e6;
constexpr double kPerQuaternionUnit = 1e9;

/// Null where it is not known.
Json rounded(double value, double per_unit = kPerUnit) {
  if (!std::isfinite(value)) return Json();
  // Adding 0 makes a 0 of -0.
  return Json(std::round(value * per_unit) / per_unit + 0.0);
}

Json rounded(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

/// Of a rotation's two quaternions the one with w >= 0.
Json quaternion_json(const Pose& X) {
  Eigen::Quaterniond q(X.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return {rounded(q.x(), kPerQuaternionUnit), rounded(q.y(), kPerQuaternionUnit),
          rounded(q.z(), kPerQuaternionUnit), rounded(q.w(), kPerQuaternionUnit)};
}

Json spread_json(const ResidualSpread& spread) {
  return {{"median", rounded(spread.median_m)},
          {"p90", rounded(spread.p90_m)},
          {"p99", rounded(spread.p99_m)}};
}

Json settings_json(const std::vector<ProposedSetting>& settings) {
  Json json = Json::object();
  for (const ProposedSetting& setting : settings) {
    const bool is_count = setting.key.ends_with("_px");
    json[setting.key] = is_count ? Json(std::llround(setting.value)) : rounded(setting.value);
  }
  return json;
}

Json smallest_json(const std::vector<SmallestObstacle>& smallest) {
  Json json = Json::array();
  for (const SmallestObstacle& obstacle : smallest) {
    json.push_back({{"depth_m", rounded(obstacle.depth_m)},
                    {"rod_width_m", rounded(obstacle.rod_width_m)},
                    {"finger_width_m", rounded(obstacle.finger_width_m)}});
  }
  return json;
}

void add_proposal(const FilterProposal& proposal, Json& json) {
  json["self_filter"] = settings_json(proposal.self_filter);
  json["sensor"] = settings_json(proposal.sensor);
  json["bias_m"] = rounded(proposal.bias_m);
  json["leftover_px"] = proposal.leftover_px;
  json["largest_leftover_px"] = proposal.largest_leftover_px;
  json["smallest_obstacle"] = smallest_json(proposal.smallest);
  json["rod_gap_m"] = rounded(proposal.rod_gap_m);
}

Json detection_json(const DetectedDiameters& detected) {
  return {{"median", rounded(detected.median_m())}, {"worst", rounded(detected.worst_m())}};
}

/// Of all cameras together.
Json cell_detection_json(const DetectionMap& map) {
  Json json = detection_json(map.cell);
  const bool has_worst = map.cell.in_view() > 0;
  json["worst_at_base_m"] = has_worst ? rounded(map.places_B_m[map.cell.worst_place()]) : Json();
  json["places"] = map.places_B_m.size();
  json["in_view"] = map.cell.in_view();
  json["step_m"] = rounded(map.step_m);
  json["reach"] = {{"center_base_m", rounded(map.reach.center_B_m)},
                   {"radius_m", rounded(map.reach.radius_m)}};
  return json;
}

Json calibrated_camera_json(const CalibrationReport& report, std::size_t index) {
  const CameraCalibration& found = report.result->cameras[index];
  const CalibrationCamera& source = *report.calibration_data->cameras[index];
  const bool is_good = found.refused.empty();
  const bool has_clock =
      is_good && std::find(found.not_determined.begin(), found.not_determined.end(),
                           "clock_offset_s") == found.not_determined.end();
  Json json;
  json["camera"] = found.camera;
  json["parent"] = report.calibration_data->model->links[source.parent].name;
  json["xyz"] = rounded(Eigen::Vector3d(found.X_PC.translation()));
  json["quaternion_xyzw"] = quaternion_json(found.X_PC);
  json["sigma_xyz_m"] = is_good ? rounded(found.sigma_xyz_m) : Json();
  json["sigma_rotation_rad"] = is_good ? rounded(found.sigma_rotation_rad) : Json();
  json["clock_offset_s"] = rounded(found.clock_offset_s);
  json["sigma_clock_s"] = has_clock ? rounded(found.sigma_clock_s) : Json();
  json["depth"] = {{"offset_m", rounded(found.depth.offset_m)},
                   {"scale", rounded(found.depth.scale)}};
  json["dilation_px"] = rounded(found.dilation_px);
  json["moved_m"] = rounded(found.moved_m);
  json["halves_m"] = rounded(found.halves_m);
  json["residual_m"] = {{"before", spread_json(found.before)}, {"after", spread_json(found.after)}};
  json["score"] = {{"before", rounded(found.score_before)}, {"after", rounded(found.score_after)}};
  json["not_determined"] = found.not_determined;
  json["refused"] = is_good ? Json() : Json(found.refused);
  json["frames"] = found.frames;
  const DetectionMap& map = report.detection;
  json["detection_m"] = map.empty() ? Json() : detection_json(map.cameras[index]);
  add_proposal(report.proposals[index], json);
  return json;
}

Json part_json(const AttachedPart& part, const CalibrationResult& result) {
  Json seen_in = Json::array();
  for (const AttachedPart::Sight& sight : part.seen_in) {
    seen_in.push_back({{"camera", result.cameras[sight.camera].camera}, {"frame", sight.frame}});
  }
  return {{"name", part.name},
          {"link", part.link},
          {"size_m", rounded(part.size_m)},
          {"padding_m", rounded(part.padding_m)},
          {"hidden_share", rounded(part.hidden_share)},
          {"places", part.places},
          {"seen_in", seen_in},
          {"explained_share", rounded(part.explained_share)},
          {"triangles", part.mesh_L.triangles.size()},
          {"is_taken", part.is_taken}};
}

}  // namespace

std::string calibration_json(const CalibrationReport& report) {
  Json json;
  json["schema"] = "berth/calibration/1";
  json["frames_used"] = frames_used(report);
  json["cameras"] = Json::array();
  for (std::size_t i = 0; i < report.result->cameras.size(); ++i) {
    json["cameras"].push_back(calibrated_camera_json(report, i));
  }
  const DetectionMap& map = report.detection;
  json["detection_m"] = map.empty() ? Json() : cell_detection_json(map);
  json["joint_offsets"] = Json::object();
  for (const auto& [name, offset] : report.result->joint_offsets) {
    json["joint_offsets"][name] = rounded(offset);
  }
  json["joints_not_determined"] = report.result->joints_not_determined;
  json["attached"] = Json::array();
  for (const AttachedPart& part : report.attached.parts) {
    json["attached"].push_back(part_json(part, *report.result));
  }
  const std::string& refused = report.attached.refused;
  json["attached_refused"] = refused.empty() ? Json() : Json(refused);
  json["warnings"] = report.warnings;
  return json.dump();
}

}  // namespace berth
