#include "berth/reports/calibration_report.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

#include "berth/files/json_schema.hpp"
#include "berth/scene/scene_schema.hpp"

namespace berth {
namespace {

constexpr double kPerUnit = 1e6;
constexpr double kPerQuaternionUnit = 1e9;

/// A value of the calibration, and what such a value may be in any calibration, as JSON Schema.
struct DescribedValue {
  Json value;
  Json schema;
};

struct DescribedField {
  DescribedField(const char* its_name, const char* sentence, const DescribedValue& of)
      : name(its_name), is{of.value, schema::told(sentence, of.schema)} {}
  DescribedField(const char* its_name, const DescribedValue& of) : name(its_name), is(of) {}

  const char* name;
  DescribedValue is;
};
using DescribedFields = std::vector<DescribedField>;

/// Null where it is not known.
Json rounded(double value, double per_unit = kPerUnit) {
  if (!std::isfinite(value)) return Json();
  // Adding 0 makes a 0 of -0.
  return Json(std::round(value * per_unit) / per_unit + 0.0);
}

DescribedValue number(double value) { return {rounded(value), schema::number()}; }
DescribedValue number_or_null(double value) { return {rounded(value), schema::number_or_null()}; }
DescribedValue count(std::int64_t value) { return {value, schema::count()}; }
DescribedValue text(const std::string& value) { return {value, schema::text()}; }
/// Null where it is empty.
DescribedValue text_or_null(const std::string& value) {
  return {value.empty() ? Json() : Json(value), schema::text_or_null()};
}

DescribedValue three(const Eigen::Vector3d& v) {
  return {{rounded(v.x()), rounded(v.y()), rounded(v.z())}, schema::list_of(schema::number(), 3)};
}

DescribedValue null_unless(bool is_known, const DescribedValue& of) {
  return {is_known ? of.value : Json(), schema::or_null(of.schema)};
}

/// An empty one tells what each of them may be.
template <class One, class Describe>
DescribedValue list_of(const std::vector<One>& all, Describe describe) {
  Json values = Json::array();
  for (const One& one : all) values.push_back(describe(one).value);
  return {values, schema::list_of(describe(One()).schema)};
}
DescribedValue texts(const std::vector<std::string>& all) { return list_of(all, text); }

DescribedValue map_of(const DescribedFields& fields) {
  DescribedValue all;
  for (const auto& [name, is] : fields) {
    all.value[name] = is.value;
    all.schema[name] = is.schema;
  }
  return {all.value, schema::map_of_all(all.schema)};
}

/// Of a rotation's two quaternions the one with w >= 0.
DescribedValue quaternion(const Pose& X) {
  Eigen::Quaterniond q(X.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  Json values;
  for (const double value : q.coeffs()) values.push_back(rounded(value, kPerQuaternionUnit));
  return {values, schema::list_of(schema::number(), 4)};
}

DescribedValue spread_of(const ResidualSpread& spread) {
  return map_of({{"median", number_or_null(spread.median_m)},
                 {"p90", number_or_null(spread.p90_m)},
                 {"p99", number_or_null(spread.p99_m)}});
}

/// Some of these settings. What was found is no default.
template <class Settings>
DescribedValue some_of(const std::vector<ProposedSetting>& found) {
  Json values = Json::object();
  for (const auto& [key, value, why] : found) {
    values[key] = key.ends_with("_px") ? Json(std::llround(value)) : rounded(value);
  }
  const Settings defaults;
  Json settings = setting_properties(setting_refs(defaults));
  for (auto& [name, schema] : settings.items()) schema.erase("default");
  return {values, schema::map_of(settings, {})};
}

DescribedValue smallest_of(const SmallestObstacle& obstacle) {
  return map_of({{"depth_m", number(obstacle.depth_m)},
                 {"rod_width_m", number_or_null(obstacle.rod_width_m)},
                 {"finger_width_m", number_or_null(obstacle.finger_width_m)}});
}

/// The settings that fit the camera.
DescribedFields proposal_fields(const FilterProposal& p) {
  return {
      {"self_filter", "the settings that are proposed", some_of<SelfFilterSettings>(p.self_filter)},
      {"sensor", "the settings that are proposed", some_of<SensorSettings>(p.sensor)},
      {"bias_m", "how far readings of the robot lie behind its surface", number_or_null(p.bias_m)},
      {"leftover_px", "how many pixels of the robot the filter leaves", count(p.leftover_px)},
      {"largest_leftover_px", "the most of them in one piece", count(p.largest_leftover_px)},
      {"smallest_obstacle", "the thinnest rod and finger that are seen, at these depths",
       list_of(p.smallest, smallest_of)},
      {"rod_gap_m", "how near to the arm a thin rod is seen", number_or_null(p.rod_gap_m)}};
}

/// Of the balls that are drawn, over all places in view. Null where not even the largest is enough,
/// or nothing is in view.
DescribedFields detection_fields(const DetectedDiameters& detected) {
  return {
      {"median", "the diameter that half of the places need", number_or_null(detected.median_m())},
      {"worst", "the diameter that is detected at all of them",
       number_or_null(detected.worst_m())}};
}

/// By all cameras together.
DescribedValue cell_detection(const DetectionMap& map) {
  const int in_view = map.cell.in_view();
  const Eigen::Vector3d worst_at_B_m =
      in_view > 0 ? map.places_B_m[map.cell.worst_place()] : Eigen::Vector3d(0, 0, 0);
  DescribedFields fields = detection_fields(map.cell);
  fields.insert(fields.end(),
                {{"worst_at_base_m", "where that is, in the base frame",
                  null_unless(in_view > 0, three(worst_at_B_m))},
                 {"places", "of the robot's reach", count(map.places_B_m.size())},
                 {"in_view", "how many of them some camera has in view", count(in_view)},
                 {"step_m", "from one to the next", number(map.step_m)},
                 {"reach", "a ball that the moving links stay in",
                  map_of({{"center_base_m", three(map.reach.center_B_m)},
                          {"radius_m", number(map.reach.radius_m)}})}});
  return null_unless(!map.empty(), map_of(fields));
}

DescribedFields pose_fields(const CameraCalibration& found) {
  const bool is_good = found.refused.empty();
  const bool has_clock = is_good && found.is_determined("clock_offset_s");
  return {
      {"xyz", "its optical frame's position in that link's frame", three(found.X_PC.translation())},
      {"quaternion_xyzw", "its rotation there, x, y, z, w with w >= 0", quaternion(found.X_PC)},
      {"sigma_xyz_m", "standard deviations of the position",
       null_unless(is_good, three(found.sigma_xyz_m))},
      {"sigma_rotation_rad", "and of the rotation",
       null_unless(is_good, three(found.sigma_rotation_rad))},
      {"clock_offset_s", "what is added to its stamps to get the clock of the joints",
       number(found.clock_offset_s)},
      {"sigma_clock_s", "its standard deviation; null where it was not determined",
       number_or_null(has_clock ? found.sigma_clock_s : std::nan(""))},
      {"depth", "a reading z shows a surface at offset_m + scale z",
       map_of({{"offset_m", number(found.depth.offset_m)}, {"scale", number(found.depth.scale)}})}};
}

DescribedFields fit_fields(const CameraCalibration& found) {
  return {{"dilation_px", "by how many pixels it sees the robot wider than it is",
           number_or_null(found.dilation_px)},
          {"moved_m", "how far the robot's points lie from where the scene's pose put them",
           number_or_null(found.moved_m)},
          {"halves_m", "how far they lie apart between fits of the even and of the odd frames",
           number_or_null(found.halves_m)},
          {"residual_m", "from readings to the robot's surface",
           map_of({{"before", spread_of(found.before)}, {"after", spread_of(found.after)}})},
          {"score", "how well the images agree with the robot; 2 is perfect",
           map_of({{"before", number_or_null(found.score_before)},
                   {"after", number_or_null(found.score_after)}})},
          {"not_determined", "what the frames do not tell; it stayed as it was",
           texts(found.not_determined)},
          {"refused", "why the pose is the scene's own; null where it was found",
           text_or_null(found.refused)},
          {"frames", "the numbers of its images that were used", list_of(found.frames, count)}};
}

DescribedValue calibrated_camera(const CalibrationReport& report, std::size_t index) {
  const CameraCalibration& found = report.result->cameras[index];
  const std::size_t parent = report.calibration_data->cameras[index]->parent;
  const DetectionMap& map = report.detection;
  DescribedFields fields{{"camera", "the camera's name", text(found.camera)},
                         {"parent", "the link that it is fixed to",
                          text(report.calibration_data->model->links[parent].name)}};
  const DescribedFields detected =
      detection_fields(map.empty() ? DetectedDiameters() : map.cameras[index]);
  const DescribedField detection{"detection_m",
                                 "the smallest ball that it detects; null where nobody measured it",
                                 null_unless(!map.empty(), map_of(detected))};
  for (const DescribedFields& more : {pose_fields(found),
                                      fit_fields(found),
                                      {detection},
                                      proposal_fields(report.proposals[index])}) {
    fields.insert(fields.end(), more.begin(), more.end());
  }
  return map_of(fields);
}

DescribedValue attached_part(const AttachedPart& part, const CalibrationResult& result) {
  const auto sight = [&](const AttachedPart::Sight& at) {
    return map_of({{"camera", text(result.cameras[at.camera].camera)}, {"frame", count(at.frame)}});
  };
  return map_of(
      {{"name", "what results call it", text(part.name)},
       {"link", "the link that carries it", text(part.link)},
       {"size_m", "its three lengths", three(part.size_m)},
       {"padding_m", "by how much it was made larger", number_or_null(part.padding_m)},
       {"hidden_share", "the share of its surface that no image shows",
        number_or_null(part.hidden_share)},
       {"places", "at how many places of the room it was seen", count(part.places)},
       {"seen_in", "the images that show it", list_of(part.seen_in, sight)},
       {"explained_share", "its share of the readings that come and go",
        number_or_null(part.explained_share)},
       {"triangles", "of its mesh", count(part.mesh_L.triangles.size())},
       {"is_taken", "whether the new scene has it", {part.is_taken, {{"type", "boolean"}}}}});
}

DescribedValue joint_offsets_of(const CalibrationResult& result) {
  Json offsets = Json::object();
  for (const auto& [name, offset] : result.joint_offsets) offsets[name] = rounded(offset);
  return {offsets, {{"type", "object"}, {"additionalProperties", schema::number()}}};
}

DescribedValue described(const CalibrationReport& report) {
  const CalibrationResult& result = *report.result;
  std::vector<std::size_t> cameras;
  for (std::size_t i = 0; i < result.cameras.size(); ++i) cameras.push_back(i);
  const auto camera = [&](const std::size_t& index) { return calibrated_camera(report, index); };
  const auto part = [&](const AttachedPart& one) { return attached_part(one, result); };
  const char* const name = "berth/calibration/1";
  return map_of(
      {{"schema", {name, {{"const", name}}}},
       {"frames_used", "how many images were used, of all cameras", count(frames_used(report))},
       {"cameras", list_of(cameras, camera)},
       {"detection_m",
        "the smallest ball that the cameras detect together; null where nobody measured it",
        cell_detection(report.detection)},
       {"joint_offsets", "what is to be added to joints' positions, in rad or m",
        joint_offsets_of(result)},
       {"joints_not_determined", "joints whose zeros the frames do not tell",
        texts(result.joints_not_determined)},
       {"attached", "what the robot carries and its URDF does not have",
        list_of(report.attached.parts, part)},
       {"attached_refused", "why nothing that it carries was found; null where that is not so",
        text_or_null(report.attached.refused)},
       {"warnings", "for people", texts(report.warnings)}});
}

}  // namespace

std::string calibration_json(const CalibrationReport& report) {
  return described(report).value.dump();
}

std::string calibration_schema() {
  RobotModel model;
  model.links.resize(1);
  const CalibrationCamera camera;
  const CalibrationData data{&model, nullptr, nullptr, {&camera}};
  const CalibrationResult result{{{}}, {}, {}};
  const CalibrationReport like{&data, &result, {{}}, false, {}};
  return schema::text_of("calibration:1", "berth/calibration/1",
                         "What `berth calibrate` writes with --format json. Lengths in metres, "
                         "angles in rad, times in seconds. What is not known is null.",
                         described(like).schema);
}

}  // namespace berth
