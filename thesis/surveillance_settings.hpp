// Which obstacle pixels a robot pixel is tried against, and in which order.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace berth {

/// The part of the image that is searched around a robot pixel, for a cube of half side L around
/// it. Each enumerator here and below is its own name.
enum class SurveillanceRegion {
  image,            ///< all of it, whatever L is
  cube_projection,  ///< the cube's projection (Hirt algorithm 1), which holds all within L
  flacco,           ///< Flacco's rectangle (Hirt 2.15, 2.16), too small away from the optical axis
};
inline constexpr std::array kSurveillanceRegions = {
    SurveillanceRegion::image, SurveillanceRegion::cube_projection, SurveillanceRegion::flacco};

/// The depths of obstacles that count around a robot pixel at depth z.
enum class DepthInterval {
  gray_area,  ///< up to z + L: what an obstacle hides counts as obstacle
  cube,       ///< [z - L, z + L], the thesis's cube: loses obstacles in front of it
};
inline constexpr std::array kDepthIntervals = {DepthInterval::gray_area, DepthInterval::cube};

/// The order of the obstacle pixels around a robot pixel (Hirt figure 3.2). It changes how soon the
/// region shrinks, and which of several pairs equally close is found.
enum class SearchPattern {
  row_major,    ///< row by row from the top
  oscillating,  ///< row by row from the robot pixel's, below and above by turns
  spiral,       ///< ring by ring around the robot pixel
};
inline constexpr std::array kSearchPatterns = {SearchPattern::row_major, SearchPattern::oscillating,
                                               SearchPattern::spiral};

/// What becomes of L once a link has a pair.
enum class Shrinking {
  per_link,  ///< it is the distance of the link's closest pair so far (Hirt algorithm 2)
  none,      ///< it stays the range for every robot pixel (Hirt figure 3.5, and for mean vectors)
};
inline constexpr std::array kShrinkings = {Shrinking::per_link, Shrinking::none};

std::string_view name_of(SurveillanceRegion region);
std::string_view name_of(DepthInterval interval);
std::string_view name_of(SearchPattern pattern);
std::string_view name_of(Shrinking shrinking);

constexpr const auto& all_of(SurveillanceRegion) { return kSurveillanceRegions; }
constexpr const auto& all_of(DepthInterval) { return kDepthIntervals; }
constexpr const auto& all_of(SearchPattern) { return kSearchPatterns; }
constexpr const auto& all_of(Shrinking) { return kShrinkings; }

/// For brute_force and lattice. L begins with the range.
struct SurveillanceSettings {
  /// Nothing: image for brute_force, cube_projection for lattice.
  std::optional<SurveillanceRegion> region = std::nullopt;
  DepthInterval depth_interval = DepthInterval::gray_area;
  SearchPattern search_pattern = SearchPattern::row_major;
  Shrinking shrinking = Shrinking::per_link;

  bool operator==(const SurveillanceSettings&) const = default;
};

}  // namespace berth
