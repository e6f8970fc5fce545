#include "sim/motions.hpp"

#include <algorithm>

#include "berth/files/error.hpp"

namespace berth::sim {
namespace {

constexpr double kLeadIn_s = 0.25, kShortest_s = 1;

double greatest_step_m(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double step_m = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    step_m = std::max(step_m, (a[j].translation() - b[j].translation()).norm());
  }
  return step_m;
}

}  // namespace

Bvh as_measured(Bvh motion) {
  const double step_m = kFastestJoint_m_s * motion.frame_s;
  std::size_t best = 0, best_end = 0;
  std::size_t begin = static_cast<std::size_t>(kLeadIn_s / motion.frame_s) + 1;
  std::vector<Pose> before;
  for (std::size_t i = begin; i < motion.frames.size(); ++i) {
    std::vector<Pose> now = joint_poses(motion, static_cast<double>(i) * motion.frame_s);
    if (i > begin && greatest_step_m(before, now) > step_m) begin = i;
    if (i + 1 - begin > best_end - best) {
      best = begin;
      best_end = i + 1;
    }
    before = std::move(now);
  }
  const auto at = [&](std::size_t i) {
    return motion.frames.begin() + static_cast<std::ptrdiff_t>(i);
  };
  motion.frames = {at(best), at(best_end)};
  const bool is_short = static_cast<double>(motion.frames.size()) * motion.frame_s < kShortest_s;
  if (is_short || motion.frames.size() < 2) motion.frames.clear();
  return motion;
}

std::vector<Bvh> read_motions(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const char* const expected = "a folder with *.bvh files in it or below";
  if (!fs::is_directory(folder)) throw_bad_file({folder}, "no such folder", expected);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".bvh") files.push_back(entry.path());
  }
  if (files.empty()) throw_bad_file({folder}, "no *.bvh file", expected);
  std::ranges::sort(files);
  std::vector<Bvh> motions;
  for (const fs::path& file : files) {
    motions.push_back(as_measured(read_bvh(file)));
    if (!motions.back().frames.empty()) continue;
    throw_bad_file({file}, "less than a second without a joint above 8 m/s",
                   "a motion as measured");
  }
  return motions;
}

}  // namespace berth::sim
