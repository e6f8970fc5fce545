#include "berth/scene/result_json.hpp"

#include <cassert>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "berth/scene/separation_text.hpp"

namespace berth {
namespace {

using Json = nlohmann::ordered_json;

/// The double that prints as the float does: 0.1234f becomes 0.1234, not 0.12340000271797180.
double shortest(float value) {
  if (!std::isfinite(value)) return value;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double same = 0;
  std::from_chars(text, end, same);
  return same;
}

Json json_of(Pixel pixel) { return {pixel.u, pixel.v}; }

Json json_of(const Eigen::Vector3f& p) {
  return {shortest(p.x()), shortest(p.y()), shortest(p.z())};
}

Json json_of(const SightShares& shares) {
  if (!shares.is_known()) return Json();
  return {{"seen", shortest(shares.seen)},
          {"hidden_by_obstacles", shortest(shares.hidden_by_obstacles)},
          {"hidden_by_robot", shortest(shares.hidden_by_robot)},
          {"no_reading", shortest(shares.no_reading)},
          {"outside_image", shortest(shares.outside_image)}};
}

Json json_of(const LinkVisibility& visibility) {
  const bool is_known = visibility.space.is_known();
  const bool has_doubt = !std::isnan(visibility.doubtful_distance_m);
  return {
      {"surface", json_of(visibility.surface)},
      {"space", json_of(visibility.space)},
      {"space_unknown", is_known ? Json(shortest(visibility.space_unknown)) : Json()},
      {"doubtful_distance_m", has_doubt ? Json(shortest(visibility.doubtful_distance_m)) : Json()},
      {"doubtful_pixel", has_doubt ? json_of(visibility.doubtful_pixel) : Json()}};
}

Json json_of(const AnswerTiming& timing, const std::string& name) {
  return {{"repeat", timing.repeat},
          {name,
           {{"min", timing.min_us},
            {"p50", timing.p50_us},
            {"p99", timing.p99_us},
            {"max", timing.max_us}}}};
}

/// Null where it is not known.
Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Timeliness& time) {
  return {{"status", name_of(time.status)},
          {"frame_age_s", json_of(time.frame_age_s)},
          {"joints_age_s", json_of(time.joints_age_s)},
          {"skew_s", json_of(time.skew_s)}};
}

/// A camera of an untimely frame says what is wrong with its time.
std::string_view status_of(const CameraState& state) {
  return state.status == CameraStatus::untimely ? name_of(state.time) : name_of(state.status);
}

Json fates_json(const std::array<std::int64_t, kPixelFateCount>& counts) {
  Json json;
  for (int i = 0; i < kPixelFateCount; ++i) json[name_of(static_cast<PixelFate>(i))] = counts[i];
  return json;
}

Json camera_json(const CameraResult& camera, bool is_alone) {
  Json json = {{"camera", camera.name},
               {"frame", camera.frame >= 0 ? Json(camera.frame) : Json()},
               {"stamp_s", json_of(camera.state.stamp_s)},
               {"age_s", json_of(camera.state.age_s)},
               {"status", status_of(camera.state)}};
  const CameraWatch& watch = camera.state.watch;
  if (watch.is_on) {
    json["seen_through"] = json_of(watch.seen_through);
    json["displacement_m"] = json_of(watch.displacement_m);
  }
  if (watch.is_implausible) json["at_robot"] = json_of(watch.at_robot);
  if (!is_alone && camera.self_filter) json["self_filter"] = fates_json(*camera.self_filter);
  return json;
}

/// What only methods that compare images know.
void add_image_pair(const LinkDistance& link, const FrameResult& result, Json& json) {
  const bool ok = link.status == LinkStatus::ok;
  const auto if_ok = [ok](const auto& value) { return ok ? json_of(value) : Json(); };
  json["robot_pixel"] = if_ok(link.robot_pixel);
  json["obstacle_pixel"] = if_ok(link.obstacle_pixel);
  json["robot_point_m"] = if_ok(link.robot_point_C_m);
  json["obstacle_point_m"] = if_ok(link.obstacle_point_C_m);
  const std::optional<Pose> X_BC = result.X_BC();
  if (!X_BC) return;
  const auto in_base = [&](const Eigen::Vector3f& p_C) -> Eigen::Vector3f {
    return (*X_BC * p_C.cast<double>()).cast<float>();
  };
  json["robot_point_base_m"] = if_ok(in_base(link.robot_point_C_m));
  json["obstacle_point_base_m"] = if_ok(in_base(link.obstacle_point_C_m));
}

Json reading_json(const SpacePair& pair, const FrameResult& result) {
  const bool known = pair.is_known();
  return {{"lower_bound_m", shortest(pair.lower_bound_m)},
          {"camera", known ? Json(result.cameras[pair.view].name) : Json()},
          {"obstacle_pixel", known ? json_of(pair.obstacle_pixel) : Json()},
          {"robot_point_base_m", known ? json_of(pair.robot_point_B_m) : Json()},
          {"obstacle_point_base_m", known ? json_of(pair.obstacle_point_B_m) : Json()}};
}

/// The pair of method mesh. A link that is not seen may have one.
void add_space_pair(const LinkDistance& link, const FrameResult& result, Json& json) {
  const bool known = link.has_distance();
  const auto if_known = [known](const auto& value) { return known ? json_of(value) : Json(); };
  json["camera"] = known ? Json(result.cameras[link.view].name) : Json();
  json["obstacle_pixel"] = if_known(link.obstacle_pixel);
  json["obstacle_is"] = known ? Json(name_of(link.obstacle_kind)) : Json();
  if (result.cameras.size() == 1) {
    json["robot_point_m"] = if_known(link.robot_point_C_m);
    json["obstacle_point_m"] = if_known(link.obstacle_point_C_m);
  }
  json["robot_point_base_m"] = if_known(link.robot_point_B_m);
  json["obstacle_point_base_m"] = if_known(link.obstacle_point_B_m);
  if (link.status == LinkStatus::untimely) {
    json["reading_distance_m"] = Json();
    return;
  }
  json["reading_distance_m"] =
      link.reading.is_known() ? Json(shortest(link.reading.distance_m)) : Json();
  json["reading"] = reading_json(link.reading, result);
}

Json link_json(const LinkDistance& link, const std::string& name, const FrameResult& result) {
  const bool ok = link.status == LinkStatus::ok;
  // Method mesh tells what is near a link that it does not see.
  const bool has_distance = ok || (!result.asks_images && link.has_distance());
  Json json;
  json["id"] = link.id;
  json["link"] = name;
  json["status"] = name_of(link.status);
  json["distance_m"] = has_distance ? Json(shortest(link.distance_m)) : Json();
  if (result.has_bounds) {
    const bool known = !std::isnan(link.lower_bound_m);
    json["lower_bound_m"] = known ? Json(shortest(link.lower_bound_m)) : Json();
  }
  if (result.asks_images) {
    add_image_pair(link, result, json);
  } else {
    add_space_pair(link, result, json);
  }
  json["mean_direction"] =
      link.mean_count > 0 && has_distance ? json_of(link.mean_direction_C) : Json();
  if (!result.asks_images) {
    json["mean_direction_base"] =
        link.mean_count > 0 && has_distance ? json_of(link.mean_direction_B) : Json();
  }
  json["mean_count"] = link.mean_count;
  if (result.asks_images) json["robot_pixels"] = link.robot_pixels;
  return json;
}

/// Null where a bound is infinite, too.
Json json_of(const LinkSeparation& link) {
  return {{"speed_m_s", json_of(link.speed_m_s)},     {"distance_m", json_of(link.distance_m)},
          {"required_m", json_of(link.required_m)},   {"margin_m", json_of(link.margin_m)},
          {"speed_scale", json_of(link.speed_scale)}, {"reason", name_of(link.reason)}};
}

Json separation_json(const FrameResult& result) {
  const Separation& separation = *result.separation;
  const bool has_link = separation.link != kNoLink;
  const bool has_camera = separation.camera >= 0;
  return {{"state", name_of(separation.state)},
          {"speed_scale", json_of(separation.speed_scale)},
          {"reason", name_of(separation.reason)},
          {"link", has_link ? Json(result.link_names[separation.link - 1]) : Json()},
          {"camera", has_camera ? Json(result.cameras[separation.camera].name) : Json()},
          {"reaction_time_s", json_of(separation.reaction_time_s)},
          {"text", separation_text(result)}};
}

}  // namespace

std::string result_json(const FrameResult& result) {
  const std::vector<LinkDistance>& links = result.distances->links;
  assert(result.link_names.size() == links.size());
  assert(!result.visibility || result.visibility->size() == links.size());
  Json json;
  json["schema"] = "berth/result/2";
  json["frame"] = result.frame;
  json["stamp_s"] = result.stamp_s;
  const bool is_alone = result.cameras.size() == 1;
  if (is_alone) json["camera"] = result.cameras.front().name;
  json["method"] = result.method;
  if (!result.gl_renderer.empty()) json["gl_renderer"] = result.gl_renderer;
  json["range_m"] = result.range_m;
  if (result.time) json["time"] = json_of(*result.time);
  if (result.separation) json["separation"] = separation_json(result);
  json["cameras"] = Json::array();
  for (const CameraResult& camera : result.cameras) {
    json["cameras"].push_back(camera_json(camera, is_alone));
  }
  json["links"] = Json::array();
  for (std::size_t i = 0; i < links.size(); ++i) {
    json["links"].push_back(link_json(links[i], result.link_names[i], result));
    if (result.visibility) json["links"].back()["visibility"] = json_of((*result.visibility)[i]);
    if (result.separation && result.is_moved(i)) {
      json["links"].back()["separation"] = json_of(result.separation->links[i]);
    }
  }
  if (result.asks_images) json["pairs"] = result.distances->pairs;
  if (result.timing) json["timing"] = json_of(*result.timing, result.timing_name);
  if (is_alone && result.cameras.front().self_filter) {
    json["self_filter"] = fates_json(*result.cameras.front().self_filter);
  }
  return json.dump();
}

}  // namespace berth
