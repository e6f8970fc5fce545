#include "apps/berth/calibration_page_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "apps/berth/html_text.hpp"
#include "berth/reports/calibration_coverage.hpp"
#include "berth/reports/calibration_words.hpp"

namespace berth::app {
namespace {

using Html = std::back_insert_iterator<std::string>;

std::string length_cell(double length_m) { return std::isnan(length_m) ? "–" : mm_text(length_m); }

std::string quaternion_text(const Eigen::Quaterniond& q) {
  return fmt::format("{:.5f}, {:.5f}, {:.5f}, {:.5f}", q.x(), q.y(), q.z(), q.w());
}

class CameraSection {
 public:
  CameraSection(const CalibrationReport& report, std::size_t camera,
                const CalibrationCoverage& coverage, const CalibrationFrames& frames)
      : report_(report),
        camera_(camera),
        found_(report.result->cameras[camera]),
        source_(*report.calibration_data->cameras[camera]),
        proposal_(report.proposals[camera]),
        coverage_(coverage),
        frames_(frames) {}

  std::string run() {
    const bool is_good = found_.refused.empty();
    fmt::format_to(out_, "<section>\n<h2>{}</h2>\n<p class=\"{}\">{}</p>\n",
                   html_text(found_.camera), is_good ? "lead" : "lead refused",
                   html_text(headline(found_)));
    add_advice();
    fmt::format_to(out_, "<div class=\"columns\"><div>\n");
    add_residuals();
    fmt::format_to(out_, "</div><div>\n");
    add_histogram();
    fmt::format_to(out_, "</div></div>\n");
    add_settings();
    add_pose();
    html_ += frames_html(source_, found_, frames_);
    return std::move(html_) + "</section>\n";
  }

 private:
  void add_list(const std::vector<std::string>& sentences) {
    fmt::format_to(out_, "<ul>\n");
    for (const std::string& sentence : sentences) {
      fmt::format_to(out_, "<li>{}</li>\n", html_text(sentence));
    }
    fmt::format_to(out_, "</ul>\n");
  }

  void add_advice() {
    const std::vector<std::string> advice = calibration_advice(report_, camera_, coverage_);
    fmt::format_to(out_, "<h3>What to do next</h3>\n");
    if (advice.empty()) {
      fmt::format_to(out_, "<p>Nothing: these images are enough.</p>\n");
    } else {
      add_list(advice);
    }
  }

  void add_residuals() {
    fmt::format_to(out_,
                   "<h3>How far readings of the robot lie from its model</h3>\n<table>"
                   "<tr><th></th><th>before</th><th>after</th></tr>\n");
    const auto row = [&](const char* name, const std::string& before, const std::string& after) {
      fmt::format_to(out_, "<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", name, before, after);
    };
    row("half of them within", length_cell(found_.before.median_m),
        length_cell(found_.after.median_m));
    row("90 % within", length_cell(found_.before.p90_m), length_cell(found_.after.p90_m));
    row("99 % within", length_cell(found_.before.p99_m), length_cell(found_.after.p99_m));
    row("fit of depth and outline", fmt::format("{:.0f} %", fit_percent(found_.score_before)),
        fmt::format("{:.0f} %", fit_percent(found_.score_after)));
    fmt::format_to(
        out_,
        "</table>\n<p class=\"faint\">After: with the error of the camera's depths, told "
        "below, taken out. Judge by the fit: depth alone can fit well where the "
        "outline does not.</p>\n");
  }

  void add_histogram() {
    fmt::format_to(out_,
                   "<h3>Reading − model</h3>\n<figure>{}<figcaption class=\"keys\">"
                   "<span><i class=\"key before\"></i>before</span>"
                   "<span><i class=\"key after\"></i>after</span></figcaption></figure>\n",
                   histogram_svg(frames_.before, frames_.after));
  }

  void add_settings() {
    fmt::format_to(out_, "<h3>Settings for this camera</h3>\n");
    if (proposal_.self_filter.empty() && proposal_.sensor.empty()) {
      fmt::format_to(out_, "<p>None are proposed: the scene's stay.</p>\n");
      return;
    }
    fmt::format_to(out_, "<table class=\"settings\">\n");
    add_group("self_filter", proposal_.self_filter);
    add_group("sensor", proposal_.sensor);
    fmt::format_to(out_, "</table>\n");
    add_list(consequences(proposal_));
    add_smallest();
  }

  void add_group(const char* group, const std::vector<ProposedSetting>& settings) {
    for (const ProposedSetting& setting : settings) {
      fmt::format_to(out_,
                     "<tr><td><code>{}.{}</code></td><td class=\"value\">{}</td>"
                     "<td class=\"text\">{}</td></tr>\n",
                     group, html_text(setting.key), value_text(setting), html_text(setting.why));
    }
  }

  void add_smallest() {
    if (proposal_.smallest.empty()) return;
    fmt::format_to(
        out_,
        "<p>The thinnest things that are still seen with these settings, away from the "
        "robot, tried in these very images:</p>\n<table><tr><th>away from the camera</th>"
        "<th>upright rod, 30 cm long</th><th>finger, 7 cm long</th></tr>\n");
    for (const SmallestObstacle& at : proposal_.smallest) {
      fmt::format_to(out_, "<tr><td>{:g} m</td><td>{}</td><td>{}</td></tr>\n", at.depth_m,
                     smallest_width_text(at.rod_width_m), smallest_width_text(at.finger_width_m));
    }
    fmt::format_to(out_, "</table>\n");
  }

  void add_pose() {
    const bool is_good = found_.refused.empty();
    fmt::format_to(
        out_,
        "<h3>Pose, clock and depth</h3>\n<div class=\"scroll\"><table><tr><th>the camera "
        "in <code>{}</code></th><th>scene</th><th>{}</th><th>repeatable to</th></tr>\n",
        html_text(report_.calibration_data->model->links[source_.parent].name),
        is_good ? "found" : "stays");
    for (int i = 0; i < 3; ++i) {
      fmt::format_to(out_, "<tr><td>{}</td><td>{:.4f} m</td><td>{:.4f} m</td><td>{}</td></tr>\n",
                     "xyz"[i], source_.X_PC.translation()[i], found_.X_PC.translation()[i],
                     is_good ? "± " + mm_text(found_.sigma_xyz_m[i]) : "–");
    }
    add_rotation();
    fmt::format_to(out_, "</table></div>\n");
    add_moves();
  }

  void add_rotation() {
    Eigen::Quaterniond q_scene(source_.X_PC.linear());
    Eigen::Quaterniond q_found(found_.X_PC.linear());
    // q and -q are the same rotation; people compare the two, and with the JSON.
    if (q_scene.w() < 0) q_scene.coeffs() = -q_scene.coeffs();
    if (q_found.dot(q_scene) < 0) q_found.coeffs() = -q_found.coeffs();
    const Eigen::Vector3d turn_deg = found_.sigma_rotation_rad * (180 / EIGEN_PI);
    fmt::format_to(
        out_, "<tr><td>quaternion x, y, z, w</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        quaternion_text(q_scene), quaternion_text(q_found),
        found_.refused.empty()
            ? fmt::format("± {:.2f}°, {:.2f}°, {:.2f}°", turn_deg.x(), turn_deg.y(), turn_deg.z())
            : "–");
  }

  void add_moves() {
    const Pose X_CC = source_.X_PC.inverse() * found_.X_PC;
    if (found_.refused.empty()) {
      fmt::format_to(
          out_,
          "<p>The camera itself moved by {} and turned by {:.2f}°. Moving and turning can "
          "make up for one another; what counts is how far the robot moved in its view, "
          "which is told at the top.</p>\n",
          mm_text(X_CC.translation().norm()),
          Eigen::AngleAxisd(X_CC.linear()).angle() * 180 / EIGEN_PI);
    }
    std::vector<std::string> facts = {
        "Clock offset: " + clock_text(found_, source_) + ".",
        "Depth: " + depth_text(found_, coverage_.median_depth_m, report_.corrects_depth) + ".",
        fmt::format("Outline: the camera sees the robot {:.1f} px {} than its model, on each side.",
                    std::abs(found_.dilation_px), found_.dilation_px < 0 ? "narrower" : "wider")};
    const std::vector<std::string> open = open_questions(found_);
    facts.insert(facts.end(), open.begin(), open.end());
    add_list(facts);
  }

  const CalibrationReport& report_;
  const std::size_t camera_;
  const CameraCalibration& found_;
  const CalibrationCamera& source_;
  const FilterProposal& proposal_;
  const CalibrationCoverage& coverage_;
  const CalibrationFrames& frames_;
  std::string html_;
  Html out_ = std::back_inserter(html_);
};

}  // namespace

std::string camera_section(const std::filesystem::path& folder, const CalibrationReport& report,
                           std::size_t camera) {
  const CalibrationCoverage coverage = coverage_of(report, camera);
  const CalibrationFrames frames = write_calibration_frames(folder, report, camera, coverage);
  return CameraSection(report, camera, coverage, frames).run();
}

}  // namespace berth::app
