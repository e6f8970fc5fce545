#include "berth/record/recorded_messages.hpp"

#include "berth/record/depth_message.hpp"
#include "berth/record/exact_json.hpp"
#include "berth/record/recorded_cell.hpp"

namespace berth {
namespace {

constexpr std::uint16_t kImageSchema = 1;
constexpr std::uint16_t kFirstJsonSchema = 2;

Json json_of(const CameraWatch& w) {
  return {{"is_on", w.is_on},
          {"has_moved", w.has_moved},
          {"is_implausible", w.is_implausible},
          {"is_unconfirmed", w.is_unconfirmed},
          {"is_hidden", w.is_hidden},
          {"seen_through", exact(w.seen_through)},
          {"displacement_m", exact(w.displacement_m)},
          {"at_robot", exact(w.at_robot)}};
}

CameraWatch watch_of(const Json& json) {
  CameraWatch w;
  w.is_on = json.at("is_on").get<bool>();
  w.has_moved = json.at("has_moved").get<bool>();
  w.is_implausible = json.at("is_implausible").get<bool>();
  w.is_unconfirmed = json.at("is_unconfirmed").get<bool>();
  w.is_hidden = json.at("is_hidden").get<bool>();
  w.seen_through = number_of(json.at("seen_through"));
  w.displacement_m = number_of(json.at("displacement_m"));
  w.at_robot = number_of(json.at("at_robot"));
  return w;
}

Json json_of(const std::vector<JointState>& states) {
  Json all = Json::array();
  for (const JointState& state : states) all.push_back(exact(state));
  return all;
}

std::vector<JointState> states_of(const Json& json) {
  std::vector<JointState> all;
  for (const Json& state : json) all.push_back(joints_of(state));
  return all;
}

Json json_of(const RecordedMotion& m) {
  return {{"now_s", exact(m.now_s)},
          {"velocity", exact(m.velocity)},
          {"path", json_of(m.path)},
          {"has_frames", m.has_frames},
          {"before",
           {{"is_first", m.before.is_first},
            {"scale", exact(m.before.scale)},
            {"last_s", exact(m.before.last_s)},
            {"critical_link", m.before.critical_link}}}};
}

RecordedMotion motion_of(const Json& json) {
  const Json& before = json.at("before");
  return {number_of(json.at("now_s")),
          numbers_of(json.at("velocity")),
          states_of(json.at("path")),
          json.at("has_frames").get<bool>(),
          {before.at("is_first").get<bool>(), number_of(before.at("scale")),
           number_of(before.at("last_s")), before.at("critical_link").get<int>()}};
}

Json space_json(const RecordedRequest& r) {
  if (r.space == RecordedRequest::Space::prepared) return json_of(r.searched_for);
  return r.space == RecordedRequest::Space::frames ? Json() : Json("as before");
}

template <class T, class Of>
std::optional<T> unless_null(const Json& json, Of of) {
  return json.is_null() ? std::nullopt : std::optional<T>(of(json));
}

}  // namespace

mcap::Head head_of(const RecordedCell& cell) {
  mcap::Head head;
  head.schemas.push_back(
      {kImageSchema, std::string(kImageType), "ros2msg", std::string(image_definition())});
  const auto add_json = [&](std::uint16_t id, const std::string& topic, const char* name) {
    const auto schema = static_cast<std::uint16_t>(kFirstJsonSchema + head.schemas.size());
    head.schemas.push_back({schema, name, "jsonschema", R"({"type": "object"})"});
    head.channels.push_back({id, schema, topic, "json"});
  };
  add_json(kBeginChannel, "/monitor/begin", "berth.Begin");
  add_json(kRequestChannel, "/monitor/request", "berth.Request");
  add_json(kResultChannel, "/monitor/result", "berth.Result");
  add_json(kJointsChannel, "/joint_messages", "berth.JointMessage");
  for (std::size_t k = 0; k < cell.cameras.size(); ++k) {
    const std::string topic = "/" + cell.cameras[k]->mount().name;
    add_json(channel_of(k, kExposureOfCamera), topic + "/exposure", "berth.Exposure");
    head.channels.push_back({channel_of(k, kDepthOfCamera), kImageSchema, topic + "/depth", "cdr"});
    head.channels.push_back(
        {channel_of(k, kBackgroundOfCamera), kImageSchema, topic + "/background", "cdr"});
  }
  head.attachments = attachments_of(cell);
  return head;
}

std::uint64_t time_ns(double time_s) {
  constexpr double kLatest_s = 9e9;
  return time_s > 0 && time_s < kLatest_s ? static_cast<std::uint64_t>(time_s * 1e9) : 0;
}

std::string json_text(const RecordedBegin& begin) {
  return Json{{"camera_names", begin.camera_names},
              {"lost_images", begin.lost_images},
              {"lost_requests", begin.lost_requests}}
      .dump();
}

RecordedBegin begin_of(std::string_view text) {
  const Json json = Json::parse(text);
  return {json.at("camera_names").get<std::vector<std::string>>(),
          json.at("lost_images").get<std::int64_t>(), json.at("lost_requests").get<std::int64_t>()};
}

std::string json_text(const RecordedExposure& e) {
  return Json{{"exposure", e.number},           {"status", name_of(e.time.status)},
              {"skew_s", exact(e.time.skew_s)}, {"watch", json_of(e.watch)},
              {"X_PC", exact(e.X_PC)},          {"X_WB", exact(e.X_WB)},
              {"joints", exact(e.joints)}}
      .dump();
}

RecordedExposure exposure_of(std::string_view text) {
  const Json json = Json::parse(text);
  return {json.at("exposure").get<std::uint64_t>(),
          {enum_of<TimeStatus>(json.at("status"), kTimeStatusCount), number_of(json.at("skew_s"))},
          watch_of(json.at("watch")),
          pose_of(json.at("X_PC")),
          pose_of(json.at("X_WB")),
          joints_of(json.at("joints"))};
}

std::string json_text(const RecordedRequest& r) {
  return Json{{"number", r.number},
              {"now_s", r.now_s ? exact(*r.now_s) : Json()},
              {"X_WB", r.X_WB ? exact(*r.X_WB) : Json()},
              {"joints", r.joints ? exact(*r.joints) : Json()},
              {"joints_status", name_of(r.joints_status)},
              {"frames", r.frames},
              {"prepared_for", space_json(r)},
              {"is_stopped", r.is_stopped},
              {"motion", r.is_monitored ? json_of(r.motion) : Json()}}
      .dump();
}

RecordedRequest request_of(std::string_view text) {
  const Json json = Json::parse(text);
  RecordedRequest r;
  r.number = json.at("number").get<std::int64_t>();
  r.now_s = unless_null<double>(json.at("now_s"), number_of);
  r.X_WB = unless_null<Pose>(json.at("X_WB"), pose_of);
  r.joints = unless_null<JointState>(json.at("joints"), joints_of);
  r.joints_status = enum_of<TimeStatus>(json.at("joints_status"), kTimeStatusCount);
  r.frames = json.at("frames").get<std::vector<std::uint64_t>>();
  const Json& prepared = json.at("prepared_for");
  r.space = prepared.is_null()    ? RecordedRequest::Space::frames
            : prepared.is_array() ? RecordedRequest::Space::prepared
                                  : RecordedRequest::Space::as_before;
  if (prepared.is_array()) r.searched_for = states_of(prepared);
  r.is_stopped = json.at("is_stopped").get<bool>();
  r.is_monitored = !json.at("motion").is_null();
  if (r.is_monitored) r.motion = motion_of(json.at("motion"));
  return r;
}

std::string json_text(double stamp_s, const std::vector<std::string>& names,
                      const std::vector<double>& positions) {
  return Json{{"stamp_s", exact(stamp_s)}, {"name", names}, {"position", exact(positions)}}.dump();
}

}  // namespace berth
