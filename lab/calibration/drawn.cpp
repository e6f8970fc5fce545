#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <numbers>
#include "berth/calibration/fit_camera.hpp"
#include "berth/calibration/score.hpp"
#include "lab/trust/trial_robots.hpp"
#include "tests/support/drawn_teach_in.hpp"
#include "tests/support/sensor_model.hpp"
using namespace berth;
namespace drawnlab {
double shift(FrameDrawer& d, const CalibrationEstimate& a, const Pose& b, int step) {
  double sum = 0, n = 0; std::mutex m;
  const Pose X_ba = b.inverse() * a.cameras[0].X_PC;
  d.draw(step, a, {}, FrameChoice::all, [&](const DrawnFrame& f) {
    double s = 0, k = 0;
    for (int v = 0; v < f.camera.height_px; v++) for (int u = 0; u < f.camera.width_px; u++) {
      if (f.robot.link_id(u, v) == kNoLink) continue;
      const double z = f.robot.depth_m(u, v);
      const Eigen::Vector3d p((u - f.camera.cx_px) / f.camera.fx_px * z, (v - f.camera.cy_px) / f.camera.fy_px * z, z);
      s += (X_ba * p - p).norm(); k++;
    }
    std::lock_guard l(m); sum += s; n += k;
  });
  return sum / n;
}
}
int main(int argc, char** argv) {
  CLI::App app; std::string folder, only; int seeds = 5; double off = 0.05, deg = 5; testing::DrawnTeachInSettings st; double zero_deg = 0;
  app.add_option("robots", folder); app.add_option("--seeds", seeds); app.add_option("--off", off); app.add_option("--deg", deg);
  app.add_option("--only", only);
  app.add_option("--bias", st.errors.depth_share); app.add_option("--clock", st.errors.clock_offset_s); app.add_option("--zero", zero_deg);
  app.add_option("--poses", st.poses); app.add_flag("--moves", st.moves);
  CLI11_PARSE(app, argc, argv);
  st.errors.joint_zero = zero_deg * std::numbers::pi / 180;
  std::vector<double> errs;
  for (const lab::TrialRobot& robot : lab::load_trial_robots(folder)) {
    if (!only.empty() && robot.name.find(only) == std::string::npos) continue;
    for (int seed = 1; seed <= seeds; seed++) {
      auto d = testing::draw_teach_in(robot.model, robot.meshes, st, seed);
      d.camera->X_PC = testing::miscalibrated(d.X_PC_true, off, deg * std::numbers::pi / 180, seed + 100);
      auto steps = camera_steps(d.camera->camera.width_px);
      FrameDrawer drawer(d.teach_in, steps);
      FitPriors priors; if (st.moves) priors.clock_s = 0.1; if (zero_deg > 0) priors.joints.assign(robot.model.joints.size(), 0.035);
      auto t0 = std::chrono::steady_clock::now();
      double start = drawnlab::shift(drawer, start_of(d.teach_in), d.X_PC_true, steps[1]);
      const FitResult f = fit_camera(drawer, priors);
      double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
      const auto& c = f.estimate.cameras[0];
      double e = drawnlab::shift(drawer, f.estimate, d.X_PC_true, steps[1]);
      errs.push_back(e);
      double zmax = 0; for (size_t j = 1; j + 1 < d.joint_shift.size(); j++) zmax = std::max(zmax, std::abs(d.joint_shift[j] - f.estimate.joint_shift[j]));
      CalibrationEstimate truth = f.estimate; truth.cameras[0].X_PC = d.X_PC_true;
      fmt::print("{:18} {} from {:.0f} mm: error {:.2f} mm; a {:.1f} mm b {:.3f} % d {:.2f} px clock {:.1f} ms zeros off {:.2f} deg score {:.3f} true {:.3f} {:.2f} s\n", robot.name, seed, 1e3 * start, 1e3 * e,
        1e3 * c.depth_offset_m, 100 * (c.depth_scale - 1), c.dilation_px, 1e3 * c.clock_shift_s, zmax * 180 / std::numbers::pi,
        score(drawer, f.estimate, {1, .03, 10}).value, score(drawer, truth, {1, .03, 10}).value, s);
      fflush(stdout);
    }
  }
  std::sort(errs.begin(), errs.end());
  fmt::print("median {:.2f} mm, worst {:.2f} mm of {}\n", 1e3 * errs[errs.size() / 2], 1e3 * errs.back(), errs.size());
}
