#include "apps/view/curves.hpp"

#include <cmath>
#include <limits>

#include "berth/scene/separation_text.hpp"

namespace berth::app {
namespace {

using CurveJson = nlohmann::ordered_json;

constexpr float kNoLength = std::numeric_limits<float>::quiet_NaN();

CurveJson length_json(float length_m) {
  // To a tenth of a millimetre: a curve needs no more.
  return std::isnan(length_m) ? CurveJson() : CurveJson(std::round(1e4 * length_m) / 1e4);
}

}  // namespace

void Curves::add(const FrameResult& result) {
  const std::vector<LinkDistance>& links = result.distances->links;
  Column column{result.stamp_s, {}, {}};
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkDistance& link = links[i];
    const bool has_distance =
        link.status == LinkStatus::ok || (!result.asks_images && link.has_distance());
    const bool is_doubtful = result.visibility && !result.visibility->empty() &&
                             !std::isnan((*result.visibility)[i].doubtful_distance_m);
    column.links.push_back({has_distance ? link.distance_m : kNoLength,
                            link.reading.is_known() ? link.reading.distance_m : kNoLength,
                            link.status, is_doubtful});
  }
  if (result.separation) {
    column.speed = Speed{result.separation->speed_scale, separation_text(result)};
  }
  columns_.push_back(std::move(column));
  if (columns_.size() > most_) columns_.pop_front();
}

void Curves::warn(const std::string& text) {
  if (!text.empty()) warnings_.push_back(text);
}

PageMessage Curves::message(const std::string& error) const {
  CurveJson stamps = CurveJson::array();
  CurveJson links = {{"distance_m", CurveJson::array()},
                     {"reading_m", CurveJson::array()},
                     {"status", CurveJson::array()},
                     {"is_doubtful", CurveJson::array()}};
  CurveJson speed;
  for (const Column& column : columns_) {
    stamps.push_back(column.stamp_s);
    if (column.speed) {
      speed["scale"].push_back(column.speed->scale);
      speed["text"].push_back(column.speed->text);
    }
    for (std::size_t i = 0; i < column.links.size(); ++i) {
      links["distance_m"][i].push_back(length_json(column.links[i].distance_m));
      links["reading_m"][i].push_back(length_json(column.links[i].reading_m));
      links["status"][i].push_back(name_of(column.links[i].status));
      links["is_doubtful"][i].push_back(column.links[i].is_doubtful);
    }
  }
  return json_message({{"type", "timeline"},
                       {"done", columns_.size()},
                       {"total", total_},
                       {"error", error},
                       {"warnings", warnings_},
                       {"stamps_s", stamps},
                       {"links", links},
                       {"speed", speed}});
}

}  // namespace berth::app
