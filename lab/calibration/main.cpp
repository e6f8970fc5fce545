#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <numbers>
#include "berth/calibration/fit_camera.hpp"
#include "berth/calibration/score.hpp"
#include "berth/calibration/coarse_search.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/random.hpp"
using namespace berth;
static double shift(FrameDrawer& d, const CalibrationEstimate& a, const CalibrationEstimate& b) {
  // mean displacement of visible robot points between both
  double sum = 0, n = 0; std::mutex m;
  const Pose X_ba = b.cameras[0].X_PC.inverse() * a.cameras[0].X_PC;
  d.draw(4, a, {}, FrameChoice::all, [&](const DrawnFrame& f) {
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
int main(int argc, char** argv) {
  CLI::App app; std::string file; int starts = 30; double off = 0.05, deg = 5;
  app.add_option("scene", file); app.add_option("--starts", starts); app.add_option("--off", off); app.add_option("--deg", deg);
  CLI11_PARSE(app, argc, argv);
  const OpenScene scene = open_scene(file);
  for (const OpenCamera& oc : scene.cameras) {
  TeachInCamera cam; cam.name = oc.source.name; cam.camera = oc.view->camera();
  cam.parent = *scene.robot->model().find_link(oc.source.parent_link);
  const Pose given = cam.X_PC = oc.source.X_PC;
  for (size_t k = 0; k < oc.source.depth.size(); k++) cam.frames.push_back({int(k), oc.read_depth(k), oc.at_exposure[k]});
  TeachIn t; t.model = &scene.robot->model(); t.meshes = scene.robot->meshes(); t.joints = nullptr; t.cameras = {&cam};
  auto steps = camera_steps(cam.camera.width_px); steps.push_back(4); steps.push_back(2);
  FrameDrawer drawer(t, steps);
  auto now = [] { return std::chrono::steady_clock::now(); };
  auto t0 = now();
  const FitResult ref = fit_camera(drawer, {});
  double s = std::chrono::duration<double>(now() - t0).count();
  CalibrationEstimate g = start_of(t);
  auto sc = [&](const CalibrationEstimate& e) { return score(drawer, e, {1, 0.03, 10}).value; };
  fmt::print("{} given score {:.4f}, fit {:.4f}, moved {:.1f} mm, a {:.1f} mm b {:.3f} % d {:.2f} px, {:.2f} s\n", cam.name, sc(g), sc(ref.estimate),
    1e3 * shift(drawer, g, ref.estimate), 1e3 * ref.estimate.cameras[0].depth_offset_m, 100 * (ref.estimate.cameras[0].depth_scale - 1), ref.estimate.cameras[0].dilation_px, s);
  for (auto ch : {FrameChoice::even, FrameChoice::odd}) {
    auto h = fit(drawer, ref.estimate, {}, {{2, 5, .04, .03, 16, .05}, {1, 4, .03, .02, 12, .05}}, ch);
    fmt::print("  half moved {:.1f} mm a {:.1f} b {:.3f} d {:.2f}\n", 1e3 * shift(drawer, ref.estimate, h.estimate), 1e3*h.estimate.cameras[0].depth_offset_m, 100*(h.estimate.cameras[0].depth_scale-1), h.estimate.cameras[0].dilation_px);
  }
  int back = 0;
  for (int i = getenv("FROM") ? atoi(getenv("FROM")) : 1; i <= starts; i++) {
    testing::Random r(i);
    Eigen::Vector3d ax(r.gaussian(), r.gaussian(), r.gaussian()), tr(r.gaussian(), r.gaussian(), r.gaussian());
    cam.X_PC = given * Pose(Eigen::Translation3d(off * tr.normalized()) * Eigen::AngleAxisd(deg * std::numbers::pi / 180, ax.normalized()));
    if (getenv("DBG")) { CoarseSearch w{.step = steps[0], .reach_m = .4, .reach_rad = .6, .tries = 2000, .best = 12};
      auto st = start_of(t); auto size = typical_size(drawer, st, w);
      auto tr = [&](const CalibrationEstimate& e, double cut) { auto q = score(drawer, e, {steps[0], cut, 0, .6 * size.pixels}); return fmt::format("{:.3f} ({})", q.value, q.pixels); };
      fmt::print("size {} truth {} {} {} start {}\n", size.pixels, tr(ref.estimate, .15), tr(ref.estimate, .075), tr(ref.estimate, .06), tr(st, .15));
      for (auto& e : search_coarsely(drawer, st, w, .6 * size.pixels)) fmt::print("   {} {} off {:.0f}\n", tr(e, .15), tr(e, .06), 1e3 * shift(drawer, ref.estimate, e));
      continue; }
    t0 = now();
    const FitResult f = fit_camera(drawer, {});
    s = std::chrono::duration<double>(now() - t0).count();
    const double d = shift(drawer, ref.estimate, f.estimate);
    back += d < 0.005;
    fmt::print("start {} off {:.0f} mm: moved {:.1f} mm score {:.4f} {:.2f} s\n", i, 1e3 * shift(drawer, ref.estimate, start_of(t)), 1e3 * d, sc(f.estimate), s);
    fflush(stdout);
  }
  fmt::print("{} of {} back\n", back, starts);
  }
}
