#include "berth/sensor/sensor_rules.hpp"

#include <tbb/parallel_for.h>

#include <atomic>

namespace berth {
namespace {

void count_again(ObstacleImage& out) {
  std::array<std::atomic<std::int64_t>, kPixelFateCount> total{};
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    std::array<int, kPixelFateCount> count{};
    for (int u = 0; u < out.fate.width(); ++u) ++count[static_cast<std::size_t>(out.fate(u, v))];
    for (std::size_t fate = 0; fate < count.size(); ++fate) total[fate] += count[fate];
  });
  for (std::size_t fate = 0; fate < total.size(); ++fate) out.count[fate] = total[fate];
}

}  // namespace

void apply_sensor_rules(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                        const KnownPlace& place, const SensorSettings& settings,
                        SensorWorkspace& workspace, ObstacleImage& out) {
  if (settings.first_rule().empty() && !place.always_reads) return;
  const bool has_background = settings.has_background() && place.background;
  if (settings.drops_speckle()) drop_speckle(settings, workspace.speckle, out);
  if (has_background) place.background->complete(sensor_depth_m, place, settings, out);
  if (has_background || place.always_reads) {
    find_holes(camera, sensor_depth_m, robot, place, settings, workspace.holes, out);
  }
  count_again(out);
}

}  // namespace berth
