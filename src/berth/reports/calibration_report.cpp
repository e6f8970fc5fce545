#include "berth/reports/calibration_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "berth/reports/calibration_coverage.hpp"
#include "berth/reports/calibration_words.hpp"

namespace berth {

CalibrationReport report_of(const SceneCalibrationData& material,
                            const SceneCalibration& calibration, bool corrects_depth) {
  return {&material.calibration_data, &calibration.found,   calibration.filters,  corrects_depth,
          calibration.warnings,       calibration.attached, calibration.detection};
}

int frames_used(const CalibrationReport& report) {
  std::size_t count = 0;
  for (const CameraCalibration& camera : report.result->cameras) count += camera.frames.size();
  return static_cast<int>(count);
}

namespace {

using Text = std::back_insert_iterator<std::string>;

std::string cell(double length_m) { return std::isnan(length_m) ? "-" : mm_text(length_m); }

void add_residuals(const CameraCalibration& camera, Text out) {
  fmt::format_to(out, "  {:<13}{:>10}{:>10}\n", "residual", "before", "after");
  const auto line = [&](const char* name, const std::string& before, const std::string& after) {
    fmt::format_to(out, "    {:<11}{:>10}{:>10}\n", name, before, after);
  };
  line("median", cell(camera.before.median_m), cell(camera.after.median_m));
  line("90 %", cell(camera.before.p90_m), cell(camera.after.p90_m));
  line("99 %", cell(camera.before.p99_m), cell(camera.after.p99_m));
  fmt::format_to(out, "  {:<13}{:>8.0f} %{:>8.0f} %\n", "fit", fit_percent(camera.score_before),
                 fit_percent(camera.score_after));
}

void add_settings(const char* group, const std::vector<ProposedSetting>& settings, Text out) {
  for (const ProposedSetting& setting : settings) {
    fmt::format_to(out, "    {}.{}: {}\n      {}\n", group, setting.key, value_text(setting),
                   setting.why);
  }
}

void add_smallest(const FilterProposal& proposal, Text out) {
  for (const SmallestObstacle& at : proposal.smallest) {
    fmt::format_to(out, "    seen {:g} m away: rods of {}, fingers of {}\n", at.depth_m,
                   smallest_width_text(at.rod_width_m), smallest_width_text(at.finger_width_m));
  }
}

void add_camera(const CalibrationReport& report, std::size_t index, Text out) {
  const CameraCalibration& camera = report.result->cameras[index];
  const FilterProposal& proposal = report.proposals[index];
  const CalibrationCoverage coverage = coverage_of(report, index);
  fmt::format_to(out, "{}: {}\n", camera.camera, headline(camera));
  add_residuals(camera, out);
  fmt::format_to(out, "  clock offset: {}\n",
                 clock_text(camera, *report.calibration_data->cameras[index]));
  fmt::format_to(out, "  depth: {}\n",
                 depth_text(camera, coverage.median_depth_m, report.corrects_depth));
  if (!proposal.self_filter.empty() || !proposal.sensor.empty())
    fmt::format_to(out, "  settings\n");
  add_settings("self_filter", proposal.self_filter, out);
  add_settings("sensor", proposal.sensor, out);
  for (const std::string& sentence : consequences(proposal))
    fmt::format_to(out, "    {}\n", sentence);
  add_smallest(proposal, out);
  const std::vector<std::string> advice = calibration_advice(report, index, coverage);
  if (!advice.empty()) fmt::format_to(out, "  next\n");
  for (const std::string& sentence : advice) fmt::format_to(out, "    - {}\n", sentence);
}

void add_joints(const CalibrationResult& result, Text out) {
  if (result.joint_offsets.empty() && result.joints_not_determined.empty()) return;
  fmt::format_to(out, "joint offsets [rad or m]\n");
  for (const auto& [name, offset] : result.joint_offsets) {
    fmt::format_to(out, "  {}: {:.4f}\n", name, offset + 0.0);
  }
  for (const std::string& name : result.joints_not_determined) {
    fmt::format_to(out, "  {}: not determined\n", name);
  }
}

void add_attached(const AttachedParts& attached, Text out) {
  if (!attached.refused.empty()) fmt::format_to(out, "carried: {}\n", attached.refused);
  for (const AttachedPart& part : attached.parts) {
    fmt::format_to(out, "carried: {}\n  {}\n", attached_text(part), attached_use_text(part));
  }
}

}  // namespace

std::string calibration_table(const CalibrationReport& report) {
  std::string text;
  for (const std::string& warning : report.warnings) {
    fmt::format_to(std::back_inserter(text), "warning: {}\n", warning);
  }
  for (std::size_t i = 0; i < report.result->cameras.size(); ++i) {
    add_camera(report, i, std::back_inserter(text));
  }
  add_joints(*report.result, std::back_inserter(text));
  add_attached(report.attached, std::back_inserter(text));
  for (const std::string& sentence : detection_texts(report.detection)) {
    fmt::format_to(std::back_inserter(text), "detection: {}\n", sentence);
  }
  return text;
}

}  // namespace berth
