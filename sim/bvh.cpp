#include "sim/bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string_view>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/files/number.hpp"

namespace berth::sim {
namespace {

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

/// A column of the motion.
struct Channel {
  int joint;
  /// In kChannelNames.
  int kind;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : text_(read_file_bytes(file)) {
    bvh_.file = file;
  }

  Bvh read() {
    read_hierarchy();
    read_motion();
    to_metres();
    return std::move(bvh_);
  }

 private:
  /// Empty at the end of the file.
  std::string_view next() {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::string_view text = text_;
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, at_), text.size());
    line_ += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    at_ = std::min(text.find_first_of(kBlanks, begin), text.size());
    return text.substr(begin, at_ - begin);
  }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw_bad_file({bvh_.file, line_}, found.empty() ? "the file ends" : fmt::format("'{}'", found),
                   expected);
  }

  void expect(std::string_view word) {
    const std::string_view found = next();
    if (found != word) fail(found, word);
  }

  double number(std::string_view expected) {
    const std::string_view found = next();
    const std::optional<double> value = parse_finite(found);
    if (!value) fail(found, expected);
    return *value;
  }

  int whole(int least, int most, std::string_view of) {
    const std::string_view found = next();
    const std::optional<int> value = parse_integer(found);
    if (!value || *value < least || *value > most) {
      fail(found, fmt::format("{} to {} {}", least, most, of));
    }
    return *value;
  }

  void read_hierarchy() {
    expect("HIERARCHY");
    expect("ROOT");
    read_joint(-1);
    int open = 0;
    while (open >= 0) {
      const std::string_view word = next();
      if (word == "JOINT") {
        open = read_joint(open);
      } else if (word == "End") {
        expect("Site");
        begin_joint("", open);
        expect("}");
      } else if (word == "}") {
        open = bvh_.joints[static_cast<std::size_t>(open)].parent;
      } else {
        fail(word, "JOINT, End Site or }");
      }
    }
  }

  /// Its place.
  int begin_joint(std::string_view name, int parent) {
    expect("{");
    expect("OFFSET");
    BvhJoint& joint = bvh_.joints.emplace_back();
    joint.name = name;
    joint.parent = parent;
    for (double& x_m : joint.offset_m) x_m = number("a length in each direction");
    return static_cast<int>(bvh_.joints.size()) - 1;
  }

  int read_joint(int parent) {
    const std::string name(next());
    const int joint = begin_joint(name, parent);
    expect("CHANNELS");
    const int count = whole(1, static_cast<int>(kChannelNames.size()), "channels");
    for (int i = 0; i < count; ++i) {
      const std::string_view found = next();
      const auto kind = std::ranges::find(kChannelNames, found) - kChannelNames.begin();
      if (kind == std::ssize(kChannelNames)) fail(found, "Xposition, Xrotation or the like");
      if (kind < 3 && parent >= 0) fail(found, "position channels of the root alone");
      channels_.push_back({joint, static_cast<int>(kind)});
    }
    return joint;
  }

  void read_motion() {
    expect("MOTION");
    expect("Frames:");
    // Each number has a digit and a blank.
    const std::size_t most = (text_.size() - at_) / (2 * channels_.size());
    constexpr std::size_t kMost = std::numeric_limits<int>::max();
    const int frames = whole(2, std::max(2, static_cast<int>(std::min(most, kMost))),
                             "frames, as the file is long");
    expect("Frame");
    expect("Time:");
    bvh_.frame_s = number("seconds");
    if (bvh_.frame_s <= 0) fail(fmt::format("{}", bvh_.frame_s), "seconds above 0");
    for (int i = 0; i < frames; ++i) bvh_.frames.push_back(read_frame(i, frames));
    const std::string_view rest = next();
    if (!rest.empty()) fail(rest, fmt::format("the end after {} frames", frames));
  }

  BvhFrame read_frame(int frame, int frames) {
    const std::string expected =
        fmt::format("{} finite numbers in each of {} frames, here in frame {}", channels_.size(),
                    frames, frame + 1);
    BvhFrame read{
        bvh_.joints.front().offset_m,
        std::vector<Eigen::Quaterniond>(bvh_.joints.size(), Eigen::Quaterniond::Identity())};
    for (const Channel& channel : channels_) {
      const double value = number(expected);
      if (channel.kind < 3) {
        read.root_m[channel.kind] = value;
        continue;
      }
      auto& turn = read.turns[static_cast<std::size_t>(channel.joint)];
      turn = turn * Eigen::AngleAxisd(value * std::numbers::pi / 180,
                                      Eigen::Vector3d::Unit(channel.kind - 3));
    }
    return read;
  }

  void to_metres() {
    constexpr std::array kUnits_m = {1.0, 0.01, 0.001, 0.0254, 0.0254 / 0.45};
    constexpr double kLeast_m = 1.1, kMost_m = 2.0;
    std::vector<double> y{0};
    for (std::size_t j = 1; j < bvh_.joints.size(); ++j) {
      const BvhJoint& joint = bvh_.joints[j];
      y.push_back(y[static_cast<std::size_t>(joint.parent)] + joint.offset_m.y());
    }
    const auto [low, high] = std::ranges::minmax(y);
    const double height = high - low;
    const auto unit_m = std::ranges::find_if(kUnits_m, [height](double of_m) {
      return height * of_m >= kLeast_m && height * of_m <= kMost_m;
    });
    if (unit_m == kUnits_m.end()) {
      throw_bad_file({bvh_.file, 0, "HIERARCHY"},
                     fmt::format("the skeleton at rest is {:.3g} high", height),
                     "1.1 to 2.0 m along y, in m, cm, mm, inches or 1/0.45 inches");
    }
    for (BvhJoint& joint : bvh_.joints) joint.offset_m *= *unit_m;
    for (BvhFrame& frame : bvh_.frames) frame.root_m *= *unit_m;
  }

  std::string text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Channel> channels_;
  Bvh bvh_;
};

}  // namespace

Bvh read_bvh(const std::filesystem::path& file) { return Reader(file).read(); }

std::vector<Pose> joint_poses(const Bvh& bvh, double time_s) {
  const auto last = static_cast<double>(bvh.frames.size() - 1);
  const double place = std::clamp(time_s / bvh.frame_s, 0.0, last);
  const auto before = static_cast<std::size_t>(std::min(place, last - 1));
  const double share = place - static_cast<double>(before);
  const BvhFrame &a = bvh.frames[before], &b = bvh.frames[before + 1];
  std::vector<Pose> X_WJ;
  for (std::size_t j = 0; j < bvh.joints.size(); ++j) {
    const BvhJoint& joint = bvh.joints[j];
    const bool is_root = joint.parent < 0;
    // y up, to z up.
    const Pose X_WP = is_root
                          ? Pose(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()))
                          : X_WJ[static_cast<std::size_t>(joint.parent)];
    const Eigen::Vector3d p_P_m =
        is_root ? Eigen::Vector3d(a.root_m + share * (b.root_m - a.root_m)) : joint.offset_m;
    X_WJ.push_back(X_WP * Eigen::Translation3d(p_P_m) * a.turns[j].slerp(share, b.turns[j]));
  }
  return X_WJ;
}

}  // namespace berth::sim
