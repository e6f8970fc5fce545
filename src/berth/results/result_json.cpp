#include "berth/results/result_json.hpp"

#include <cmath>
#include <concepts>
#include <type_traits>

#include "berth/results/json_values.hpp"
#include "berth/results/result_text.hpp"

namespace berth {
namespace {

/// Writes each field that it visits.
class Writer {
 public:
  Writer(const Result& result, Json& json) : result_(result), json_(json) {}

  template <class T>
  void operator()(const Field& field, const T& value) const {
    json_[field.name] = json_of(value);
  }

 private:
  template <class T>
  Json json_of(const T& value) const {
    if constexpr (requires { json_value(value); } && !std::is_integral_v<T>) {
      return json_value(value);
    } else if constexpr (std::is_enum_v<T>) {
      return name_of(value);
    } else if constexpr (requires { value.has_value(); }) {
      return value ? json_of(*value) : Json();
    } else if constexpr (requires { visit_fields(value, *this); }) {
      Json object;
      visit_fields(value, Writer(result_, object));
      return object;
    } else if constexpr (std::signed_integral<T>) {
      return value < 0 ? Json() : Json(value);
    } else {
      return value;
    }
  }
  Json json_of(const CameraPlace& at) const {
    return at.place < 0 ? Json() : Json(result_.cameras[at.place].camera);
  }
  Json json_of(const KnownLink& at) const {
    return at.place < 0 ? Json() : Json((*result_.link_names)[static_cast<std::size_t>(at.place)]);
  }
  Json json_of(const ObstacleOf& of) const {
    return of.pair.is_known() ? Json(name_of(of.pair.obstacle_is)) : Json();
  }
  Json json_of(const SightShares& shares) const {
    if (!shares.is_known()) return Json();
    Json object;
    visit_fields(shares, Writer(result_, object));
    return object;
  }
  Json json_of(const SeparationOf& of) const {
    const Separation& separation = *of.result.separation;
    const bool has_link = separation.link != kNoLink;
    return {{"state", name_of(separation.state)},
            {"speed_scale", json_value(separation.speed_scale)},
            {"basis", name_of(separation.basis)},
            {"reason", name_of(separation.reason)},
            {"link", has_link ? Json(result_.links[separation.link - 1].link) : Json()},
            {"camera", json_of(CameraPlace{separation.camera})},
            {"reaction_time_s", json_value(separation.reaction_time_s)},
            {"text", separation_text(result_)}};
  }
  Json json_of(const std::vector<ToldPair>& pairs) const {
    Json all = Json::array();
    for (const ToldPair& pair : pairs) all.push_back(json_of(pair));
    return all;
  }
  /// Null with its pair.
  Json json_of(const std::vector<float>& gradient) const {
    if (std::isnan(gradient.front())) return {};
    Json all = Json::array();
    for (const float number : gradient) all.push_back(json_value(number));
    return all;
  }
  Json json_of(const std::vector<CameraResult>& cameras) const {
    Json all = Json::array();
    for (const CameraResult& camera : cameras) {
      Json& json = all.emplace_back();
      visit_fields(camera, Writer(result_, json));
      if (!camera.has_frame) json["self_filter"] = Json();
    }
    return all;
  }
  Json json_of(const std::vector<LinkResult>& links) const {
    Json all = Json::array();
    for (const LinkResult& link : links) {
      visit_fields(link, result_, Writer(result_, all.emplace_back()));
    }
    return all;
  }

  const Result& result_;
  Json& json_;
};

}  // namespace

Json result_values(const Result& result) {
  Json json = {{"schema", "berth/result/3"}};
  visit_fields(result, Writer(result, json));
  if (const auto& timing = result.timing) {
    json["timing"] = {{"repeat", timing->repeat},
                      {result.timing_name,
                       {{"min", timing->min_us},
                        {"p50", timing->p50_us},
                        {"p99", timing->p99_us},
                        {"max", timing->max_us}}}};
  }
  return json;
}

std::string result_json(const Result& result) { return result_values(result).dump(); }

}  // namespace berth
