#pragma once

#include <fmt/format.h>

#include <string>

#include "sim/bvh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {

inline constexpr double kSmallFrame_s = 0.01;

/// A BVH file of somebody 1.5 m high up to the head's joint, in this unit, who swings both arms:
/// the forearms are turned by first_deg about y, and by swing_deg more in each frame.
inline std::string small_bvh(int frames, double swing_deg, double per_metre = 100,
                             double first_deg = 60) {
  const auto offset = [&](double x_m, double y_m, double z_m) {
    return fmt::format("OFFSET {} {} {} ", per_metre * x_m, per_metre * y_m, per_metre * z_m);
  };
  const std::string turns = "CHANNELS 3 Zrotation Xrotation Yrotation ";
  const auto arm = [&](const std::string& side, double sign) {
    return fmt::format(
        "JOINT {0}Shldr {{ {1}{5}JOINT {0}ForeArm {{ {2}{5}JOINT {0}Hand {{ {3}{5}\n"
        "End Site {{ {4}}} }} }} }}\n",
        side, offset(0.2 * sign, 0.4, 0), offset(0.28 * sign, 0, 0), offset(0.24 * sign, 0, 0),
        offset(0.02 * sign, 0, 0), turns);
  };
  const auto leg = [&](const std::string& side, double sign) {
    return fmt::format("JOINT {0}Thigh {{ {1}{4}JOINT {0}Foot {{ {2}{4}End Site {{ {3}}} }} }}\n",
                       side, offset(0.09 * sign, 0, 0), offset(0, -0.85, 0), offset(0, -0.05, 0.12),
                       turns);
  };
  std::string text = "HIERARCHY\nROOT hip\n{ " + offset(0, 0, 0) +
                     "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n" +
                     "JOINT chest { " + offset(0, 0.1, 0) + turns + "\n" + arm("r", -1) +
                     arm("l", 1) + "JOINT head { " + offset(0, 0.5, 0) + turns + "End Site { " +
                     offset(0, 0.01, 0) + "} } }\n" + leg("r", -1) + leg("l", 1) + "}\n";
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", frames, kSmallFrame_s);
  for (int i = 0; i < frames; ++i) {
    text += fmt::format("0 {} 0 0 0 0  0 0 0 ", 0.9 * per_metre);
    for (const int sign : {1, -1}) {
      text += fmt::format("0 0 0  0 0 {}  0 0 0 ", sign * (first_deg + swing_deg * i));
    }
    text += "0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n";
  }
  return text;
}

inline sim::Bvh small_motion(int frames = 150, double swing_deg = 0.2, double first_deg = 60) {
  const TemporaryFolder folder;
  return sim::read_bvh(folder.write("small.bvh", small_bvh(frames, swing_deg, 100, first_deg)));
}

}  // namespace berth
