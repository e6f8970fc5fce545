#include "apps/view/curves.hpp"

#include <cmath>

namespace berth::app {
namespace {

using Json = nlohmann::ordered_json;

Json length_json(float length_m) {
  // To a tenth of a millimetre: a curve needs no more.
  return std::isnan(length_m) ? Json() : Json(std::round(1e4 * length_m) / 1e4);
}

}  // namespace

void Curves::add(const Result& result) {
  Column column{result.stamp_s, {}, result.nearest, {}};
  for (const LinkResult& link : result.links) {
    const bool is_rejected = !std::isnan(link.visibility.rejected_distance_m);
    column.links.push_back({link.distance_m, link.status, is_rejected});
  }
  if (result.separation) {
    column.speed = Speed{result.separation->speed_scale, result.separation->state};
  }
  columns_.push_back(std::move(column));
  if (columns_.size() > most_) columns_.pop_front();
}

void Curves::warn(const std::string& text) {
  if (!text.empty()) warnings_.push_back(text);
}

PageMessage Curves::message(const std::string& error) const {
  Json stamps = Json::array();
  Json links = {
      {"distance_m", Json::array()}, {"status", Json::array()}, {"is_rejected", Json::array()}};
  Json nearest = Json::array();
  Json speed;
  for (const Column& column : columns_) {
    stamps.push_back(column.stamp_s);
    nearest.push_back(column.nearest < 0 ? Json() : Json(column.nearest));
    if (column.speed) {
      speed["scale"].push_back(column.speed->scale);
      speed["state"].push_back(name_of(column.speed->state));
    }
    for (std::size_t i = 0; i < column.links.size(); ++i) {
      links["distance_m"][i].push_back(length_json(column.links[i].distance_m));
      links["status"][i].push_back(name_of(column.links[i].status));
      links["is_rejected"][i].push_back(column.links[i].is_rejected);
    }
  }
  return json_message({{"type", "timeline"},
                       {"done", columns_.size()},
                       {"total", total_},
                       {"error", error},
                       {"warnings", warnings_},
                       {"stamps_s", stamps},
                       {"links", links},
                       {"nearest", nearest},
                       {"speed", speed}});
}

}  // namespace berth::app
