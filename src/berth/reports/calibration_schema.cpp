#include "berth/reports/calibration_report.hpp"

#include "berth/files/json_schema.hpp"
#include "berth/scene/scene_schema.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"

namespace berth {
namespace {

using schema::count, schema::list_of, schema::map_of_all, schema::number, schema::number_or_null,
    schema::text, schema::text_or_null, schema::told;

/// Null for a camera whose pose was refused.
Json three_or_null() { return schema::or_null(list_of(number(), 3)); }

/// Some of these settings. What was found is no default.
template <class Settings>
Json some_of() {
  const Settings defaults;
  Json settings = setting_properties(setting_refs(defaults));
  for (auto& [name, schema] : settings.items()) schema.erase("default");
  return schema::map_of(settings, {});
}

/// A quantity with the scene's values and with those that were found.
Json before_and_after(const Json& schema) {
  return map_of_all({{"before", schema}, {"after", schema}});
}

/// Of the balls that are drawn, over all places in view. Null where not even the largest is enough,
/// or nothing is in view.
Json detection_fields() {
  return {{"median", told("the diameter that half of the places need", number_or_null())},
          {"worst", told("the diameter that is detected at all of them", number_or_null())}};
}

/// By all cameras together.
Json cell_detection_schema() {
  Json fields = detection_fields();
  fields.update({{"worst_at_base_m", told("where that is, in the base frame", three_or_null())},
                 {"places", told("of the robot's reach", count())},
                 {"in_view", told("how many of them some camera has in view", count())},
                 {"step_m", told("from one to the next", number())},
                 {"reach", told("a ball that the moving links stay in",
                                map_of_all({{"center_base_m", list_of(number(), 3)},
                                            {"radius_m", number()}}))}});
  return told("the smallest ball that the cameras detect together; null where nobody measured it",
              schema::or_null(map_of_all(fields)));
}

Json camera_fields() {
  const Json spread = map_of_all(
      {{"median", number_or_null()}, {"p90", number_or_null()}, {"p99", number_or_null()}});
  return {
      {"camera", told("the camera's name", text())},
      {"parent", told("the link that it is fixed to", text())},
      {"xyz", told("its optical frame's position in that link's frame", list_of(number(), 3))},
      {"quaternion_xyzw", told("its rotation there, x, y, z, w with w >= 0", list_of(number(), 4))},
      {"sigma_xyz_m", told("standard deviations of the position", three_or_null())},
      {"sigma_rotation_rad", told("and of the rotation", three_or_null())},
      {"clock_offset_s",
       told("what is added to its stamps to get the clock of the joints", number())},
      {"sigma_clock_s",
       told("its standard deviation; null where it was not determined", number_or_null())},
      {"depth", told("a reading z shows a surface at offset_m + scale z",
                     map_of_all({{"offset_m", number()}, {"scale", number()}}))},
      {"dilation_px",
       told("by how many pixels it sees the robot wider than it is", number_or_null())},
      {"moved_m", told("how far the robot's points lie from where the scene's pose put them",
                       number_or_null())},
      {"halves_m", told("how far they lie apart between fits of the even and of the odd frames",
                        number_or_null())},
      {"residual_m", told("from readings to the robot's surface", before_and_after(spread))},
      {"score", told("how well the images agree with the robot; 2 is perfect",
                     before_and_after(number_or_null()))},
      {"not_determined", told("what the frames do not tell; it stayed as it was", list_of(text()))},
      {"refused", told("why the pose is the scene's own; null where it was found", text_or_null())},
      {"frames", told("the numbers of its images that were used", list_of(count()))},
      {"detection_m", told("the smallest ball that it detects; null where nobody measured it",
                           schema::or_null(map_of_all(detection_fields())))}};
}

/// What goes on to the settings that fit the camera.
Json proposal_fields() {
  const Json smallest = map_of_all({{"depth_m", number()},
                                    {"rod_width_m", number_or_null()},
                                    {"finger_width_m", number_or_null()}});
  return {
      {"self_filter", told("the settings that are proposed", some_of<SelfFilterSettings>())},
      {"sensor", told("the settings that are proposed", some_of<SensorSettings>())},
      {"bias_m", told("how far readings of the robot lie behind its surface", number_or_null())},
      {"leftover_px", told("how many pixels of the robot the filter leaves", count())},
      {"largest_leftover_px", told("the most of them in one piece", count())},
      {"smallest_obstacle",
       told("the thinnest rod and finger that are seen, at these depths", list_of(smallest))},
      {"rod_gap_m", told("how near to the arm a thin rod is seen", number_or_null())}};
}

Json attached_schema() {
  return map_of_all(
      {{"name", told("what results call it", text())},
       {"link", told("the link that carries it", text())},
       {"size_m", told("its three lengths", list_of(number(), 3))},
       {"padding_m", told("by how much it was made larger", number_or_null())},
       {"hidden_share", told("the share of its surface that no image shows", number_or_null())},
       {"places", told("at how many places of the room it was seen", count())},
       {"seen_in", told("the images that show it",
                        list_of(map_of_all({{"camera", text()}, {"frame", count()}})))},
       {"explained_share", told("its share of the readings that come and go", number_or_null())},
       {"triangles", told("of its mesh", count())},
       {"is_taken", told("whether the new scene has it", {{"type", "boolean"}})}});
}

}  // namespace

std::string calibration_schema() {
  Json camera = camera_fields();
  camera.update(proposal_fields());
  const Json all = map_of_all(
      {{"schema", {{"const", "berth/calibration/1"}}},
       {"frames_used", told("how many images were used, of all cameras", count())},
       {"cameras", list_of(map_of_all(camera))},
       {"detection_m", cell_detection_schema()},
       {"joint_offsets", told("what is to be added to joints' positions, in rad or m",
                              {{"type", "object"}, {"additionalProperties", number()}})},
       {"joints_not_determined",
        told("joints whose zeros the frames do not tell", list_of(text()))},
       {"attached",
        told("what the robot carries and its URDF does not have", list_of(attached_schema()))},
       {"attached_refused",
        told("why nothing that it carries was found; null where that is not so", text_or_null())},
       {"warnings", told("for people", list_of(text()))}});
  return schema::text_of("calibration:1", "berth/calibration/1",
                         "What `berth calibrate` writes with --format json. Lengths in metres, "
                         "angles in rad, times in seconds. What is not known is null.",
                         all);
}

}  // namespace berth
