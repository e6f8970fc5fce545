#include "thesis/surveillance_settings.hpp"

namespace berth {

std::string_view name_of(SurveillanceRegion region) {
  switch (region) {
    case SurveillanceRegion::image:
      return "image";
    case SurveillanceRegion::cube_projection:
      return "cube_projection";
    case SurveillanceRegion::flacco:
      return "flacco";
  }
  return {};
}

std::string_view name_of(DepthInterval interval) {
  switch (interval) {
    case DepthInterval::gray_area:
      return "gray_area";
    case DepthInterval::cube:
      return "cube";
  }
  return {};
}

std::string_view name_of(SearchPattern pattern) {
  switch (pattern) {
    case SearchPattern::row_major:
      return "row_major";
    case SearchPattern::oscillating:
      return "oscillating";
    case SearchPattern::spiral:
      return "spiral";
  }
  return {};
}

std::string_view name_of(Shrinking shrinking) {
  switch (shrinking) {
    case Shrinking::per_link:
      return "per_link";
    case Shrinking::none:
      return "none";
  }
  return {};
}

}  // namespace berth
