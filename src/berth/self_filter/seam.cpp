#include "berth/self_filter/seam.hpp"

#include <algorithm>

#include "berth/self_filter/beside_robot.hpp"
#include "berth/self_filter/joined.hpp"

namespace berth {
namespace {

PixelRect with_border(const PixelRect& rect, const Image<PixelFate>& fate) {
  const PixelRect inside = clip(rect, fate.width(), fate.height());
  return clip({inside.u_begin - 1, inside.v_begin - 1, inside.u_end + 1, inside.v_end + 1},
              fate.width(), fate.height());
}

}  // namespace

void append_seam(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                 const Image<PixelFate>& fate, Image<std::uint8_t>& is_found,
                 std::vector<Pixel>& seam) {
  const auto shows_robot = [&](Pixel q) { return fate(q.u, q.v) == PixelFate::robot; };
  const auto is_on_model = [&](Pixel q) {
    return sensor_depth_m(q.u, q.v) <= tolerance.greatest_reading_m(robot.depth_m(q.u, q.v));
  };
  const auto may_be_next = [&](Pixel q) {
    const PixelFate f = fate(q.u, q.v);
    return is_found(q.u, q.v) == 0 && (f == PixelFate::padding || f == PixelFate::obstacle);
  };
  const auto append = [&](Pixel q) {
    is_found(q.u, q.v) = 1;
    seam.push_back(q);
    return false;
  };

  append_beside_robot(fate, with_border(robot.extent, fate), seam);
  const auto hangs = [&](Pixel p) {
    return any_joined(sensor_depth_m, p, shows_robot, is_on_model);
  };
  seam.erase(std::remove_if(seam.begin(), seam.end(),
                            [&](Pixel p) {
                              if (is_found(p.u, p.v) != 0 || !hangs(p)) return true;
                              is_found(p.u, p.v) = 1;
                              return false;
                            }),
             seam.end());
  for (std::size_t i = 0; i < seam.size(); ++i) {
    const Pixel p = seam[i];
    if (fate(p.u, p.v) == PixelFate::padding) any_joined(sensor_depth_m, p, may_be_next, append);
  }
  for (const Pixel& p : seam) is_found(p.u, p.v) = 0;
}

}  // namespace berth
