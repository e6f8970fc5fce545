#include "berth/scene/scene_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "berth/files/setting_json.hpp"
#include "berth/pipeline/request.hpp"
#include "berth/scene/former_settings.hpp"
#include "berth/scene/settings_text.hpp"

namespace berth {
namespace {

/// 1 and not 1.0 for a whole number.
Json number_json(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

/// The numbers of a domain that a file can have: it has no infinite ones.
Json range_schema(const Domain& domain, bool is_whole) {
  Json range;
  // Files have no whole number below 0.
  const double least = is_whole ? std::max(domain.least, 0.0) : domain.least;
  if (std::isfinite(least))
    range[domain.is_open ? "exclusiveMinimum" : "minimum"] = number_json(least);
  if (std::isfinite(domain.most)) range["maximum"] = number_json(domain.most);
  return domain.has_off ? Json{{"anyOf", {{{"const", 0}}, range}}} : range;
}

/// What it may be.
Json value_schema(const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return {{"type", "boolean"}};
  if (setting.kind == SettingKind::choice) return {{"enum", setting.choices}};
  const bool is_whole = setting.kind == SettingKind::whole;
  Json schema{{"type", is_whole ? "integer" : "number"}};
  schema.update(range_schema(setting.domain, is_whole));
  return schema;
}

}  // namespace

Json setting_properties(const std::vector<SettingRef>& settings) {
  Json properties = Json::object();
  for (const SettingRef& setting : settings) {
    Json& property = properties[setting.name] =
        schema::told(std::string(setting.sentence), value_schema(setting));
    // No file can say that a number is infinite.
    const Json standing = setting_json(setting.value, [](double value) {
      return std::isfinite(value) ? number_json(value) : Json();
    });
    if (!standing.is_null()) property["default"] = standing;
  }
  return properties;
}

namespace {

using schema::list_of, schema::map_of, schema::number, schema::told;

/// A map with keys of the user's choice.
Json map_to(const Json& value) { return {{"type", "object"}, {"additionalProperties", value}}; }

/// Exactly one of these keys.
Json one_of(const std::vector<std::string>& keys) {
  Json choices = Json::array();
  for (const std::string& key : keys) choices.push_back({{"required", {key}}});
  return choices;
}

Json not_below_0() { return {{"type", "number"}, {"minimum", 0}}; }
Json above_0() { return {{"type", "number"}, {"exclusiveMinimum", 0}}; }
/// It may look like a number.
Json name() { return {{"type", {"string", "number"}}, {"minLength", 1}}; }
Json path() { return {{"type", "string"}, {"minLength", 1}}; }

Json shared(std::string_view name) { return {{"$ref", fmt::format("#/$defs/{}", name)}}; }

/// `deprecationMessage` is no word of JSON Schema: editors mark such a key with it, and propose it
/// no more.
Json deprecated(std::string_view sentence, const Json& schema) {
  Json all = told(sentence, schema);
  all["deprecated"] = true;
  all["deprecationMessage"] = sentence;
  return all;
}

/// What the reader takes in this map besides its settings.
Json others_of(std::string_view group) {
  Json others = Json::object();
  if (group == "self_filter") {
    others["link_padding_m"] =
        told("padding of single links in place of padding_m", map_to(not_below_0()));
  }
  if (group == "separation") {
    const Json row{{"speed_m_s", told("from this speed", above_0())},
                   {"time_s", told("the robot stands still after this time", not_below_0())},
                   {"distance_m", told("and this way", not_below_0())}};
    others["stopping"] = told("the robot maker's table of stops, by increasing speed",
                              list_of(map_of(row, {"speed_m_s", "time_s", "distance_m"})));
  }
  for (const std::string_view ended : ended_settings(group)) {
    others[ended] = deprecated("is no setting any more, and has no effect", Json::object());
  }
  return others;
}

Json group_schemas() {
  Json groups;
  visit_scene_groups([&](std::string_view name, const auto& settings) {
    Json properties = setting_properties(setting_refs(settings));
    properties.update(others_of(name));
    groups[name] = map_of(properties, {});
  });
  return groups;
}

/// Keys of a pose; a camera and another robot have a `parent`.
Json pose_schema(bool has_parent) {
  const Json coordinate{{"type", "number"}, {"minimum", -1e5}, {"maximum", 1e5}};
  Json keys;
  if (has_parent) keys["parent"] = told("the link that it is fixed to", name());
  keys["xyz"] = told("the position in that link's frame, in metres", list_of(coordinate, 3));
  keys["rpy"] =
      told("the rotation in rad: about x, then y, then z, all of them the link's own axes",
           list_of(number(), 3));
  keys["quaternion_xyzw"] =
      told("the rotation as a quaternion x, y, z, w of length 1", list_of(number(), 4));
  Json pose = has_parent ? map_of(keys, {"parent", "xyz"}) : map_of(keys, {"xyz"});
  pose["oneOf"] = one_of({"rpy", "quaternion_xyzw"});
  return pose;
}

Json other_robot_schema() {
  return map_of(
      {{"urdf", told("the robot's description", path())},
       {"package_paths", told("what package://NAME/ means: NAME and its folder", map_to(path()))},
       {"prefix", told("stands before the names of its links and joints", name())},
       {"pose", told("where its root link is, in the link that it stands on", pose_schema(true))}},
      {"urdf", "pose"});
}

Json robot_schema() {
  return map_of(
      {{"urdf", told("the robot's description", path())},
       {"package_paths", told("what package://NAME/ means: NAME and its folder", map_to(path()))},
       {"geometry", told("which shapes of the URDF are the robot",
                         {{"enum", {"visual", "collision"}}, {"default", "visual"}})},
       {"environment_links",
        told("links that are environment: removed from the images, and reported as known "
             "where the robot is near",
             list_of(name()))},
       {"ignore_links", told("links that are left out altogether", list_of(name()))},
       {"guarded_links",
        told("links whose boxes nobody can be in, left out as well", list_of(name()))},
       {"srdf", told("an SRDF: what its disable_collisions name may touch", path())},
       {"allowed_contacts",
        told("pairs of links that may touch: their distance is not reported as known",
             list_of(list_of(name(), 2)))},
       {"others", told("more robots, which stand on a link and have joints of their own",
                       list_of(other_robot_schema()))}},
      {"urdf"});
}

Json camera_schema() {
  const Json name{{"type", {"string", "number"}}, {"pattern", "^(?!\\.{1,2}$)[^/]+$"}};
  const Json files{{"type", "array"}, {"items", path()}, {"minItems", 1}};
  Json keys{
      {"name", told("stands in results, and can be a folder's name", name)},
      {"info", told("a ROS camera_info file: the camera's intrinsics", path())},
      {"pose", told("where the optical frame (z forward, x right, y down) is in a link",
                    pose_schema(true))},
      {"depth", told("depth images, 16-bit PNG: a list, or a pattern such as depth/*.png",
                     {{"anyOf", {path(), files}}})},
      {"depth_scale",
       told("metres for each unit of the images",
            {{"type", "number"}, {"minimum", 1e-6}, {"maximum", 0.1}, {"default", 0.001}})},
      {"depth_offset_m",
       told("what is added to each reading, after depth_scale",
            {{"type", "number"}, {"minimum", -1}, {"maximum", 1}, {"default", 0}})},
      {"depth_is", told("whether a reading is the depth along the camera's axis, or along the ray",
                        {{"enum", {"axis", "ray"}}, {"default", "axis"}})},
      {"rectified", told("false: the lens bends the images, and berth rectifies them; true: they "
                         "are rectified, and the camera_info's distortion is what they had",
                         {{"type", "boolean"}})},
      {"stamps", told("when each image was exposed, one for each, increasing, in seconds",
                      list_of(number()))},
      {"clock_offset_s", told("what is added to the camera's stamps to get the clock of joints",
                              {{"type", "number"}, {"default", 0}})},
      {"near_m", told("a nearer reading counts as none",
                      {{"type", "number"}, {"minimum", 0}, {"default", 0}})},
      {"far_m", told("a farther reading counts as none", above_0())},
      {"background", told("a 16-bit PNG in millimetres: the background to begin with", path())}};
  for (const char* group : {"self_filter", "sensor", "space", "watch"}) {
    keys[group] = told("the camera's own settings over those of the scene", shared(group));
  }
  return map_of(keys, {"name", "info", "pose", "depth"});
}

Json attached_schema() {
  Json part = map_of(
      {{"link", told("the link that it is fixed to", name())},
       {"name", told("with a name it is a link of its own in the results", name())},
       {"mesh", told("a mesh file, in metres", path())},
       {"box", told("its three lengths, in metres", list_of(above_0(), 3))},
       {"cylinder", told("radius and length, in metres; its axis is z", list_of(above_0(), 2))},
       {"sphere", told("its radius, in metres", above_0())},
       {"pose", told("in the link's frame", pose_schema(false))},
       {"sharp", told("whether no contact is tolerable, at whatever speed",
                      {{"type", "boolean"}, {"default", false}})},
       {"soft", told("whether it bends, and the shape is where it may be",
                     {{"type", "boolean"}, {"default", false}})},
       {"may_touch",
        told("links that it may touch, such as the table that it lies on", list_of(name()))}},
      {"link"});
  part["oneOf"] = one_of({"mesh", "box", "cylinder", "sphere"});
  return part;
}

/// What each map of settings is about.
constexpr std::initializer_list<std::pair<const char*, const char*>> kGroupSentences = {
    {"self_filter", "how much of an image counts as the robot itself"},
    {"sensor", "what the cameras do wrong"},
    {"space", "what readings say of free and unknown space"},
    {"watch", "when a camera counts as moved or implausible"},
    {"evaluation", "how distances are looked for"},
    {"time", "how old is too old"},
    {"separation", "how fast the robot may go beside people; without it nothing is monitored"}};

}  // namespace

std::string scene_schema() {
  Json cameras = list_of(camera_schema());
  cameras["minItems"] = 1;
  cameras["maxItems"] = kMostCameras;
  Json keys{
      {"robot", told("the robot", robot_schema())},
      {"cameras", told("the cameras, whose names differ", cameras)},
      {"attached", told("things that the robot holds, or that its URDF does not have",
                        list_of(attached_schema()))},
      {"joints", told("a CSV file: time, then a column for each joint; seconds, rad or m", path())},
      {"joint_offsets",
       told("what is added to a joint's positions, in rad or m", map_to(number()))},
      {"fixed_joints",
       told("positions of joints that never move and have no column in joints, in rad or m",
            map_to(number()))}};
  for (const auto& [group, sentence] : kGroupSentences) keys[group] = told(sentence, shared(group));
  Json scene = map_of(keys, {"robot", "cameras", "joints"});
  scene["$defs"] = group_schemas();
  return schema::text_of("scene", "berth scene",
                         "A scene file of berth. Lengths in metres, angles in rad, times in "
                         "seconds. Paths are relative to the file.",
                         scene);
}

}  // namespace berth
