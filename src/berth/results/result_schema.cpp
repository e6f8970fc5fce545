#include "berth/results/result_schema.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "berth/files/json_schema.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/results/json_values.hpp"

namespace berth {
namespace {

using schema::count, schema::list_of, schema::map_of_all, schema::number_or_null, schema::or_null,
    schema::text_or_null;

constexpr const auto& names_of(LinkStatus) { return kLinkStatusNames; }
constexpr const auto& names_of(ResultStatus) { return kResultStatusNames; }
constexpr const auto& names_of(TimeStatus) { return kTimeStatusNames; }
constexpr const auto& names_of(SeparationReason) { return kSeparationReasonNames; }

/// Describes each field that it visits, as result_json() writes it. Cameras and links are described
/// by the first of each.
class Describer {
 public:
  Describer(const Result& least, const Result& most, const Json& more_of_link, Json& properties)
      : least_(least), most_(most), more_of_link_(more_of_link), properties_(properties) {}

  template <class T>
  void operator()(const Field& field, const T& value) const {
    properties_[field.name] = schema::told(field.sentence, schema_of(value));
  }

 private:
  template <class T>
  Json schema_of(const T& value) const {
    if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_enum_v<T>) {
      return {{"enum", names_of(value)}};
    } else if constexpr (std::is_floating_point_v<T>) {
      return number_or_null();
    } else if constexpr (std::signed_integral<T>) {
      return {{"type", {"integer", "null"}}, {"minimum", 0}};
    } else if constexpr (std::integral<T>) {
      return count();
    } else {
      Json properties;
      visit_fields(value, Describer(least_, most_, more_of_link_, properties));
      return map_of_all(properties);
    }
  }
  Json schema_of(const std::string&) const { return schema::text(); }
  Json schema_of(const std::string_view&) const { return schema::text(); }
  Json schema_of(const std::optional<std::string_view>&) const { return text_or_null(); }
  Json schema_of(const CameraPlace&) const { return text_or_null(); }
  Json schema_of(const KnownLink&) const { return text_or_null(); }
  Json schema_of(const Eigen::Vector3f&) const { return or_null(list_of(schema::number(), 3)); }
  Json schema_of(const Pixel&) const { return or_null(list_of(count(), 2)); }
  Json schema_of(const ObstacleOf&) const {
    Json names = kObstacleKindNames;
    names.push_back(nullptr);
    return {{"enum", names}};
  }
  Json schema_of(const SightShares& shares) const {
    Json properties;
    visit_fields(shares, Describer(least_, most_, more_of_link_, properties));
    return or_null(map_of_all(properties));
  }
  /// A camera of a stale frame says what is wrong with its time.
  Json schema_of(const CameraState&) const {
    Json names = kCameraStatusNames;
    for (const std::string_view name : kTimeStatusNames) {
      if (std::ranges::find(names, Json(name)) == names.end()) names.push_back(name);
    }
    names.erase(std::ranges::find(names, Json(name_of(CameraStatus::stale))));
    return {{"enum", names}};
  }
  Json schema_of(const std::array<std::int64_t, kPixelFateCount>&) const {
    Json fates;
    for (const std::string_view name : kPixelFateNames) {
      fates[name] = count();
    }
    return or_null(map_of_all(fates));
  }
  Json schema_of(const SeparationOf&) const {
    const Json fields{{"state", {{"enum", kSeparationStateNames}}},
                      {"speed_scale", {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}},
                      {"basis", {{"enum", kSeparationBasisNames}}},
                      {"reason", {{"enum", kSeparationReasonNames}}},
                      {"link", text_or_null()},
                      {"camera", text_or_null()},
                      {"reaction_time_s", number_or_null()},
                      {"text", schema::text()}};
    return map_of_all(fields);
  }
  Json schema_of(const ToldPair& pair) const { return pair_schema(pair); }
  Json schema_of(const KnownPair& pair) const { return pair_schema(pair); }
  Json schema_of(const std::vector<ToldPair>&) const {
    return list_of(pair_schema(most_.links.front().occupied));
  }
  /// Its gradient is not in all results.
  template <class Pair>
  Json pair_schema(const Pair& pair) const {
    Json least, most;
    visit_fields(Pair(), Describer(least_, most_, more_of_link_, least));
    visit_fields(pair, Describer(least_, most_, more_of_link_, most));
    return schema::map_with(least, most);
  }
  Json schema_of(const std::vector<float>&) const { return or_null(list_of(schema::number())); }
  Json schema_of(const std::vector<CameraResult>& cameras) const {
    Json properties;
    visit_fields(cameras.front(), Describer(least_, most_, more_of_link_, properties));
    return list_of(map_of_all(properties));
  }
  Json schema_of(const std::vector<LinkResult>&) const {
    Json least, most;
    visit_fields(least_.links.front(), least_, Describer(least_, most_, more_of_link_, least));
    visit_fields(most_.links.front(), most_, Describer(least_, most_, more_of_link_, most));
    most.update(more_of_link_);
    return list_of(schema::map_with(least, most));
  }

  const Result& least_;
  const Result& most_;
  const Json& more_of_link_;
  Json& properties_;
};

/// One that has only what every result has.
Result least_result() {
  Result result;
  result.cameras.resize(2);
  result.links.resize(1);
  return result;
}

/// One that has all that a result may have.
Result full_result() {
  Result result;
  result.cameras.resize(1);
  result.links.resize(1);
  result.links.front().id = 1;
  result.has_visibility = true;
  result.has_candidates = true;
  LinkResult& link = result.links.front();
  link.gradient = link.occupied.gradient = link.known.gradient = {0};
  result.link_names = std::make_shared<const std::vector<std::string>>();
  result.separation.emplace().links.resize(1);
  return result;
}

Json timing_schema() {
  Json times;
  for (const char* name : {"min", "p50", "p99", "max"}) times[name] = schema::number();
  const Json us = map_of_all(times);
  const Json repeat{{"type", "integer"}, {"minimum", 1}};
  Json timing = schema::map_with({{"repeat", repeat}},
                                 {{"repeat", repeat}, {"ask_us", us}, {"evaluate_us", us}});
  timing["minProperties"] = 2;
  timing["description"] = "with --repeat: how long a request took, in microseconds";
  return timing;
}

}  // namespace

std::string result_schema(const MoreOfResults& more) {
  const Result least = least_result(), most = full_result();
  const Json name{{"schema", {{"const", "berth/result/3"}}}};
  Json always = name, all = name;
  visit_fields(least, Describer(least, most, more.of_link, always));
  visit_fields(most, Describer(least, most, more.of_link, all));
  all["method"] = {{"description", all["method"]["description"]}, {"enum", more.methods}};
  all.update(more.of_line);
  all["timing"] = timing_schema();
  return schema::text_of(
      "result:3", "berth/result/3",
      "A line that `berth run` or `berth evaluate` writes with --format json. Lengths in metres, "
      "times in seconds, points in the robot's root frame. What is not known is null.",
      schema::map_with(always, all));
}

}  // namespace berth
