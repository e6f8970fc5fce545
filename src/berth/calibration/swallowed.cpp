#include "berth/calibration/swallowed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "berth/types/image.hpp"

namespace berth {
namespace {

constexpr double kSwallowed = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kWidths_m{0.003, 0.005, 0.008, 0.010, 0.015, 0.020, 0.030};
constexpr std::array kGaps_m{0.01, 0.02, 0.03, 0.04, 0.06, 0.08, 0.10, 0.15};
constexpr double kRodWidth_m = 0.01;
constexpr double kRodLength_m = 0.30;
constexpr double kFingerLength_m = 0.07;
/// From the robot, and between two things, in the image.
constexpr double kRoom_m = 0.15;
/// The surface behind has to be farther away than that.
constexpr double kFreeBehind_m = 0.10;
constexpr double kKeptShare = 0.5;
constexpr double kPlacesShare = 0.9;
constexpr std::size_t kLeastPlaces = 5;
constexpr int kRowStep_px = 8;
/// Between two things, lest they count as one.
constexpr int kApart_px = 5;

/// An upright thing that faces the camera.
struct Thing {
  PixelRect pixels;
  float depth_m;
};

/// Pixels whose middle lies on a strip, the left edge of which is at `u`.
Thing thing_at(const Camera& camera, double u, double v, double width_m, double length_m,
               double depth_m) {
  const double width_px = camera.fx_px * width_m / depth_m;
  const double height_px = camera.fy_px * length_m / depth_m;
  return {{static_cast<int>(std::ceil(u)), static_cast<int>(std::ceil(v)),
           static_cast<int>(std::ceil(u + width_px)), static_cast<int>(std::ceil(v + height_px))},
          static_cast<float>(depth_m)};
}

template <class Holds>
bool all_pixels(const PixelRect& rect, const Holds& holds) {
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      if (!holds(u, v)) return false;
    }
  }
  return true;
}

bool is_inside(const Camera& camera, const PixelRect& rect) {
  return clip(rect, camera.width_px, camera.height_px) == rect;
}

/// Whether the thing would stand before what the camera sees there, or before nothing.
bool has_background(const FilteredCamera& view, const Thing& thing) {
  return all_pixels(thing.pixels, [&](int u, int v) {
    return !(view.depth_m(u, v) < thing.depth_m + kFreeBehind_m);
  });
}

/// How many of the things the filter keeps, drawn into the image all at once.
class Filter {
 public:
  std::vector<bool> kept(const FilteredCamera& view, const std::vector<Thing>& things) {
    depth_m_.resize(view.depth_m.width, view.depth_m.height, kNoDepth);
    for (int v = 0; v < view.depth_m.height; ++v) {
      std::copy_n(view.depth_m.row(v), view.depth_m.width, depth_m_.row(v));
    }
    for (const Thing& thing : things) {
      all_pixels(thing.pixels, [&](int u, int v) {
        depth_m_(u, v) = thing.depth_m;
        return true;
      });
    }
    const ObstacleImage& left = filter_.run(view, depth_m_);
    std::vector<bool> result;
    for (const Thing& thing : things) {
      int count = 0;
      int pixels = 0;
      all_pixels(thing.pixels, [&](int u, int v) {
        ++pixels;
        count += is_kept(left.fate(u, v));
        return true;
      });
      result.push_back(count > kKeptShare * pixels);
    }
    return result;
  }

 private:
  DepthImage depth_m_;
  DrawnImageFilter filter_;
};

/// In rows and columns over the whole image, where nothing of the robot is near.
std::vector<Thing> spread(const FilteredCamera& view, double width_m, double length_m,
                          double depth_m) {
  const Camera& camera = *view.camera;
  const int room_px = static_cast<int>(camera.fx_px * kRoom_m / depth_m);
  std::vector<Thing> things;
  for (double v = 0; v < camera.height_px; v += camera.fy_px * length_m / depth_m + room_px) {
    // Not a whole number, so that edges fall anywhere between pixels.
    for (double u = 0; u < camera.width_px;
         u += room_px + camera.fx_px * width_m / depth_m + 0.37) {
      const Thing thing = thing_at(camera, u, v, width_m, length_m, depth_m);
      if (!is_inside(camera, thing.pixels) || !has_background(view, thing)) continue;
      const PixelRect near =
          clip(grown_by(thing.pixels, room_px), camera.width_px, camera.height_px);
      if (!all_pixels(near, [&](int a, int b) { return view.robot->link_id(a, b) == kNoLink; })) {
        continue;
      }
      things.push_back(thing);
    }
  }
  return things;
}

/// Whether nine of ten things are kept; false where there are too few places to say so.
struct KeptCount {
  std::size_t places = 0;
  std::size_t kept = 0;

  void add(const std::vector<bool>& which) {
    places += which.size();
    for (const bool one : which) kept += one;
  }
  bool is_enough() const {
    return places >= kLeastPlaces &&
           static_cast<double>(kept) >= kPlacesShare * static_cast<double>(places);
  }
};

double least_width_m(const std::vector<FilteredCamera>& views, double length_m, double depth_m) {
  Filter filter;
  for (const double width_m : kWidths_m) {
    KeptCount count;
    for (const FilteredCamera& view : views) {
      count.add(filter.kept(view, spread(view, width_m, length_m, depth_m)));
    }
    if (count.is_enough()) return width_m;
  }
  return kSwallowed;
}

/// Rods to the left and right of the robot, at its depth, each so far from its outline.
std::vector<Thing> beside(const FilteredCamera& view, double gap_m) {
  const Camera& camera = *view.camera;
  std::vector<Thing> things;
  const auto is_apart = [&things](const PixelRect& near) {
    return std::none_of(things.begin(), things.end(), [&](const Thing& other) {
      const PixelRect& o = other.pixels;
      return near.u_begin < o.u_end && o.u_begin < near.u_end && near.v_begin < o.v_end &&
             o.v_begin < near.v_end;
    });
  };
  for (int v = 0; v < camera.height_px; v += kRowStep_px) {
    for (int u = 1; u + 1 < camera.width_px; ++u) {
      const bool begins =
          view.robot->link_id(u, v) != kNoLink && view.robot->link_id(u - 1, v) == kNoLink;
      const bool ends =
          view.robot->link_id(u, v) != kNoLink && view.robot->link_id(u + 1, v) == kNoLink;
      if (!begins && !ends) continue;
      const double z_m = view.robot->depth_m(u, v);
      const double off_px = camera.fx_px * (begins ? gap_m + kRodWidth_m : gap_m) / z_m;
      const Thing rod =
          thing_at(camera, u + (begins ? -off_px : off_px), v, kRodWidth_m, kFingerLength_m, z_m);
      const int gap_px = static_cast<int>(0.8 * camera.fx_px * gap_m / z_m);
      const PixelRect near = grown_by(rod.pixels, gap_px);
      if (!is_inside(camera, near) || !has_background(view, rod)) continue;
      if (!all_pixels(near, [&](int a, int b) { return view.robot->link_id(a, b) == kNoLink; })) {
        continue;
      }
      if (!is_apart(grown_by(rod.pixels, gap_px + kApart_px))) continue;
      things.push_back(rod);
    }
  }
  return things;
}

}  // namespace

SmallestObstacle smallest_obstacle(const std::vector<FilteredCamera>& views, double depth_m) {
  return {depth_m, least_width_m(views, kRodLength_m, depth_m),
          least_width_m(views, kFingerLength_m, depth_m)};
}

double least_rod_gap_m(const std::vector<FilteredCamera>& views) {
  Filter filter;
  for (const double gap_m : kGaps_m) {
    KeptCount count;
    for (const FilteredCamera& view : views) {
      count.add(filter.kept(view, beside(view, gap_m)));
    }
    if (count.is_enough()) return gap_m;
  }
  return kSwallowed;
}

const ObstacleImage& DrawnImageFilter::run(const FilteredCamera& camera, DepthView depth_m) {
  SelfFilterSettings settings = *camera.self_filter;
  settings.robot_region_scale = 0;
  self_filter(*camera.camera, depth_m, *camera.robot, settings, workspace_, out_);
  if (camera.soft) drop_soft(*camera.camera, *camera.soft, out_);
  SensorSettings sensor = *camera.sensor;
  sensor.background_frames = 0;
  apply_sensor_rules(*camera.camera, depth_m, *camera.robot, {}, sensor, sensor_workspace_, out_);
  drop_phantoms(*camera.camera, depth_m, sensor.phantom_radius_m, phantoms_, out_);
  return out_;
}

}  // namespace berth
