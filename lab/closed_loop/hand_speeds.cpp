#include "lab/closed_loop/hand_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/measured_person.hpp"

namespace berth::lab {
namespace {

constexpr double kWalking_m_s = 1.6, kReaching_m_s = 2.0;

/// Of any number of hands.
struct Speeds {
  std::size_t frames = 0;
  std::size_t above_walking = 0;
  std::size_t above_reaching = 0;
  double fastest_m_s = 0;
  double time_s = 0;
  std::vector<double> way_m = {};
  double beyond_walking_m = 0;
  double beyond_reaching_m = 0;

  void add(const std::vector<double>& m_s, double frame_s) {
    frames += m_s.size();
    time_s += static_cast<double>(m_s.size()) * frame_s;
    for (const double v_m_s : m_s) {
      above_walking += v_m_s > kWalking_m_s;
      above_reaching += v_m_s > kReaching_m_s;
      fastest_m_s = std::max(fastest_m_s, v_m_s);
    }
    for (const Burst& burst : bursts_above(kWalking_m_s, m_s, frame_s)) {
      way_m.push_back(burst.way_m);
      beyond_walking_m = std::max(beyond_walking_m, burst.beyond_m);
    }
    for (const Burst& burst : bursts_above(kReaching_m_s, m_s, frame_s)) {
      beyond_reaching_m = std::max(beyond_reaching_m, burst.beyond_m);
    }
  }

  std::string row(const std::string& name) {
    std::ranges::sort(way_m);
    const auto percent = [&](std::size_t part) {
      return 100 * static_cast<double>(part) / static_cast<double>(frames);
    };
    const auto at = [&](double share) {
      if (way_m.empty()) return 0.0;
      return way_m[static_cast<std::size_t>(share * static_cast<double>(way_m.size() - 1))];
    };
    return fmt::format(
        "| {} | {:.0f} s | {:.2f} | {:.1f} % | {:.1f} % | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} "
        "|\n",
        name, time_s, fastest_m_s, percent(above_walking), percent(above_reaching), way_m.size(),
        at(0.99), at(1), beyond_walking_m, beyond_reaching_m);
  }
};

}  // namespace

std::vector<std::vector<double>> hand_speeds_m_s(const sim::Bvh& motion) {
  std::vector<std::vector<double>> speeds_m_s;
  for (const std::size_t hand : sim::hand_joints(motion)) {
    std::vector<Eigen::Vector3d> places_m;
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
      const auto poses = sim::joint_poses(motion, static_cast<double>(i) * motion.frame_s);
      places_m.push_back(poses[hand] * sim::hand_middle_m(motion, hand));
    }
    std::vector<double>& m_s = speeds_m_s.emplace_back();
    for (std::size_t i = 1; i + 1 < places_m.size(); ++i) {
      m_s.push_back((places_m[i + 1] - places_m[i - 1]).norm() / (2 * motion.frame_s));
    }
  }
  return speeds_m_s;
}

std::vector<Burst> bursts_above(double m_s, const std::vector<double>& speeds_m_s, double frame_s) {
  std::vector<Burst> bursts;
  bool is_fast = false;
  for (const double speed_m_s : speeds_m_s) {
    const bool was_fast = is_fast;
    is_fast = speed_m_s > m_s;
    if (!is_fast) continue;
    if (!was_fast) bursts.emplace_back();
    bursts.back().way_m += speed_m_s * frame_s;
    bursts.back().beyond_m += (speed_m_s - m_s) * frame_s;
  }
  return bursts;
}

std::string hand_speed_table(std::span<const sim::Bvh> motions) {
  std::string table =
      "| motion | two hands, in all | fastest [m/s] | above 1.6 m/s | above 2.0 m/s | bursts above "
      "1.6 m/s | way of 99 % of them [m] | of the longest [m] | most beyond 1.6 m/s [m] | most "
      "beyond 2.0 m/s [m] |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  Speeds all;
  for (const sim::Bvh& motion : motions) {
    Speeds speeds;
    for (const std::vector<double>& m_s : hand_speeds_m_s(motion)) {
      speeds.add(m_s, motion.frame_s);
      all.add(m_s, motion.frame_s);
    }
    table += speeds.row(motion.file.stem().string());
  }
  return table + all.row("all");
}

}  // namespace berth::lab
