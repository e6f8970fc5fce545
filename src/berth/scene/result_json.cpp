#include "berth/scene/result_json.hpp"

#include <cassert>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

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

Json json_of(const EvaluateTiming& timing) {
  return {{"repeat", timing.repeat},
          {"evaluate_us",
           {{"min", timing.min_us},
            {"p50", timing.p50_us},
            {"p99", timing.p99_us},
            {"max", timing.max_us}}}};
}

/// Seconds; null where they are not known.
Json json_of(double value_s) { return std::isfinite(value_s) ? Json(value_s) : Json(); }

Json json_of(const Timeliness& time) {
  return {{"status", name_of(time.status)},
          {"frame_age_s", json_of(time.frame_age_s)},
          {"joints_age_s", json_of(time.joints_age_s)},
          {"skew_s", json_of(time.skew_s)}};
}

Json link_json(const LinkDistance& link, const std::string& name, const FrameResult& result) {
  const std::optional<Pose>& X_BC = result.X_BC;
  const bool ok = link.status == LinkStatus::ok;
  const auto if_ok = [ok](const auto& value) { return ok ? json_of(value) : Json(); };
  const auto in_base = [&](const Eigen::Vector3f& p_C) -> Eigen::Vector3f {
    return (*X_BC * p_C.cast<double>()).cast<float>();
  };
  Json json;
  json["id"] = link.id;
  json["link"] = name;
  json["status"] = name_of(link.status);
  json["distance_m"] = ok ? Json(shortest(link.distance_m)) : Json();
  if (result.has_bounds) {
    const bool known = !std::isnan(link.lower_bound_m);
    json["lower_bound_m"] = known ? Json(shortest(link.lower_bound_m)) : Json();
  }
  json["robot_pixel"] = if_ok(link.robot_pixel);
  json["obstacle_pixel"] = if_ok(link.obstacle_pixel);
  json["robot_point_m"] = if_ok(link.robot_point_C_m);
  json["obstacle_point_m"] = if_ok(link.obstacle_point_C_m);
  if (X_BC) {
    json["robot_point_base_m"] = if_ok(in_base(link.robot_point_C_m));
    json["obstacle_point_base_m"] = if_ok(in_base(link.obstacle_point_C_m));
  }
  json["mean_direction"] = link.mean_count > 0 ? if_ok(link.mean_direction_C) : Json();
  json["mean_count"] = link.mean_count;
  json["robot_pixels"] = link.robot_pixels;
  return json;
}

}  // namespace

std::string result_json(const FrameResult& result) {
  const std::vector<LinkDistance>& links = result.distances->links;
  assert(result.link_names.size() == links.size());
  assert(!result.visibility || result.visibility->size() == links.size());
  Json json;
  json["schema"] = "berth/result/1";
  json["frame"] = result.frame;
  json["stamp_s"] = result.stamp_s;
  json["camera"] = result.camera;
  json["method"] = result.method;
  if (!result.gl_renderer.empty()) json["gl_renderer"] = result.gl_renderer;
  json["range_m"] = result.range_m;
  if (result.time) json["time"] = json_of(*result.time);
  json["links"] = Json::array();
  for (std::size_t i = 0; i < links.size(); ++i) {
    json["links"].push_back(link_json(links[i], result.link_names[i], result));
    if (result.visibility) json["links"].back()["visibility"] = json_of((*result.visibility)[i]);
  }
  json["pairs"] = result.distances->pairs;
  if (result.timing) json["timing"] = json_of(*result.timing);
  if (result.self_filter) {
    for (int i = 0; i < kPixelFateCount; ++i) {
      json["self_filter"][name_of(static_cast<PixelFate>(i))] = (*result.self_filter)[i];
    }
  }
  return json.dump();
}

}  // namespace berth
