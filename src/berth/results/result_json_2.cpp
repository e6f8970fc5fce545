// The schema before this one, for who has not changed yet. Its words are those of its time.
#include "berth/results/json_values.hpp"
#include "berth/results/result_json.hpp"
#include "berth/results/result_text.hpp"

namespace berth {
namespace {

std::string_view old_name(LinkStatus status) {
  return status == LinkStatus::stale ? "untimely" : name_of(status);
}

std::string_view old_name(ObstacleKind kind) {
  return kind == ObstacleKind::unknown ? "hidden" : "reading";
}

std::string_view old_name(SeparationReason reason) {
  switch (reason) {
    case SeparationReason::occupied:
      return "reading";
    case SeparationReason::unknown:
      return "hidden";
    case SeparationReason::stale:
      return "untimely";
    default:
      return name_of(reason);
  }
}

Json fates_json(const std::array<std::int64_t, kPixelFateCount>& counts) {
  Json json;
  for (int i = 0; i < kPixelFateCount; ++i) {
    const auto fate = static_cast<PixelFate>(i);
    json[fate == PixelFate::flying_patch ? "island" : name_of(fate)] = counts[i];
  }
  return json;
}

Json shares_json(const SightShares& shares) {
  if (!shares.is_known()) return Json();
  return {{"seen", json_value(shares.seen)},
          {"hidden_by_obstacles", json_value(shares.hidden_by_obstacles)},
          {"hidden_by_robot", json_value(shares.hidden_by_robot)},
          {"no_reading", json_value(shares.no_reading)},
          {"outside_image", json_value(shares.outside_image)}};
}

Json visibility_json(const LinkVisibility& visibility) {
  return {{"surface", shares_json(visibility.surface)},
          {"space", shares_json(visibility.space)},
          {"space_unknown", json_value(visibility.space_unknown)},
          {"doubtful_distance_m", json_value(visibility.rejected_distance_m)},
          {"doubtful_pixel", json_value(visibility.rejected_pixel)}};
}

Json camera_json(const CameraResult& camera, bool is_alone) {
  Json json = {{"camera", camera.camera},
               {"frame", camera.frame >= 0 ? Json(camera.frame) : Json()},
               {"stamp_s", json_value(camera.stamp_s)},
               {"age_s", json_value(camera.age_s)},
               {"status", json_value(static_cast<const CameraState&>(camera))}};
  const CameraWatch& watch = camera.watch;
  if (watch.is_on) {
    json["seen_through"] = json_value(watch.seen_through);
    json["displacement_m"] = json_value(watch.displacement_m);
  }
  if (watch.is_implausible) json["at_robot"] = json_value(watch.at_robot);
  if (!is_alone && camera.has_frame) json["self_filter"] = fates_json(camera.self_filter);
  return json;
}

Json camera_name(const SpacePair& pair, const Result& result) {
  return pair.is_known() ? Json(result.cameras[pair.camera].camera) : Json();
}

/// Whether the camera's pose is known: three images without a scene have none.
bool has_base(const Result& result) {
  return result.cameras.size() == 1 && result.cameras.front().X_BC.matrix().allFinite();
}

Json mean_direction_json(const LinkResult& link) {
  return link.mean_count > 0 ? json_value(link.mean_direction_C) : Json();
}

void add_image_points(const LinkResult& link, const Result& result, Json& json) {
  const bool ok = link.status == LinkStatus::ok;
  json["robot_pixel"] = ok ? json_value(link.image.robot_pixel) : Json();
  json["obstacle_pixel"] = json_value(link.obstacle_pixel);
  json["robot_point_m"] = json_value(link.robot_point_C_m);
  json["obstacle_point_m"] = json_value(link.obstacle_point_C_m);
  if (!has_base(result)) return;
  json["robot_point_base_m"] = json_value(link.robot_point_B_m);
  json["obstacle_point_base_m"] = json_value(link.obstacle_point_B_m);
}

Json reading_json(const SpacePair& pair, const Result& result) {
  return {{"lower_bound_m", json_value(pair.lower_bound_m)},
          {"camera", camera_name(pair, result)},
          {"obstacle_pixel", json_value(pair.obstacle_pixel)},
          {"robot_point_base_m", json_value(pair.robot_point_B_m)},
          {"obstacle_point_base_m", json_value(pair.obstacle_point_B_m)}};
}

void add_image_pair(const LinkResult& link, const Result& result, Json& json) {
  add_image_points(link, result, json);
  json["mean_direction"] = mean_direction_json(link);
  json["mean_count"] = link.mean_count;
  json["robot_pixels"] = link.image.robot_pixels;
}

void add_space_pair(const LinkResult& link, const Result& result, Json& json) {
  json["camera"] = camera_name(link, result);
  json["obstacle_pixel"] = json_value(link.obstacle_pixel);
  json["obstacle_is"] = link.is_known() ? Json(old_name(link.obstacle_is)) : Json();
  if (result.cameras.size() == 1) {
    json["robot_point_m"] = json_value(link.robot_point_C_m);
    json["obstacle_point_m"] = json_value(link.obstacle_point_C_m);
  }
  json["robot_point_base_m"] = json_value(link.robot_point_B_m);
  json["obstacle_point_base_m"] = json_value(link.obstacle_point_B_m);
  json["reading_distance_m"] = json_value(link.occupied.distance_m);
  if (link.status != LinkStatus::stale) json["reading"] = reading_json(link.occupied, result);
  json["mean_direction"] = mean_direction_json(link);
  json["mean_direction_base"] = json_value(link.mean_direction_B);
  json["mean_count"] = link.mean_count;
}

Json link_json(const LinkResult& link, const Result& result) {
  Json json = {{"id", link.id},
               {"link", link.link},
               {"status", old_name(link.status)},
               {"distance_m", json_value(link.distance_m)}};
  if (result.has_bounds) json["lower_bound_m"] = json_value(link.lower_bound_m);
  if (result.compares_images) {
    add_image_pair(link, result, json);
  } else {
    add_space_pair(link, result, json);
  }
  if (result.has_visibility) json["visibility"] = visibility_json(link.visibility);
  return json;
}

Json separation_json(const LinkSeparation& link) {
  return {
      {"speed_m_s", json_value(link.speed_m_s)},     {"distance_m", json_value(link.distance_m)},
      {"required_m", json_value(link.required_m)},   {"margin_m", json_value(link.margin_m)},
      {"speed_scale", json_value(link.speed_scale)}, {"reason", old_name(link.reason)}};
}

Json separation_json(const Result& result) {
  const Separation& separation = *result.separation;
  const bool has_link = separation.link != kNoLink;
  const bool has_camera = separation.camera >= 0;
  return {{"state", name_of(separation.state)},
          {"speed_scale", json_value(separation.speed_scale)},
          {"reason", old_name(separation.reason)},
          {"link", has_link ? Json(result.links[separation.link - 1].link) : Json()},
          {"camera", has_camera ? Json(result.cameras[separation.camera].camera) : Json()},
          {"reaction_time_s", json_value(separation.reaction_time_s)},
          {"text", separation_text(result)}};
}

}  // namespace

std::string result_json_2(const Result& result) {
  Json json = {{"schema", "berth/result/2"}, {"frame", result.frame}, {"stamp_s", result.stamp_s}};
  const bool is_alone = result.cameras.size() == 1;
  if (is_alone) json["camera"] = result.cameras.front().camera;
  json["method"] = result.method;
  if (!result.gl_renderer.empty()) json["gl_renderer"] = result.gl_renderer;
  json["range_m"] = result.range_m;
  if (!std::isnan(result.joints_stamp_s)) {
    json["time"] = {{"status", name_of(result.time.status)},
                    {"frame_age_s", json_value(result.time.frame_age_s)},
                    {"joints_age_s", json_value(result.time.joints_age_s)},
                    {"skew_s", json_value(result.time.skew_s)}};
  }
  if (result.separation) json["separation"] = separation_json(result);
  json["cameras"] = Json::array();
  for (const CameraResult& camera : result.cameras) {
    json["cameras"].push_back(camera_json(camera, is_alone));
  }
  json["links"] = Json::array();
  for (const LinkResult& link : result.links) {
    json["links"].push_back(link_json(link, result));
    if (!result.separation || !link.is_moved) continue;
    json["links"].back()["separation"] = separation_json(result.separation->links[link.id - 1]);
  }
  if (result.compares_images) json["pairs"] = result.pairs;
  if (const auto& timing = result.timing) {
    json["timing"] = {{"repeat", timing->repeat},
                      {result.timing_name,
                       {{"min", timing->min_us},
                        {"p50", timing->p50_us},
                        {"p99", timing->p99_us},
                        {"max", timing->max_us}}}};
  }
  if (is_alone && result.cameras.front().has_frame) {
    json["self_filter"] = fates_json(result.cameras.front().self_filter);
  }
  return json.dump();
}

}  // namespace berth
