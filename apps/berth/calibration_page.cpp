#include "apps/berth/calibration_page.hpp"

#include <fmt/format.h>

#include <iterator>

#include "apps/berth/calibration_page_parts.hpp"
#include "apps/berth/calibration_page_style.hpp"
#include "apps/berth/html_text.hpp"
#include "berth/files/file_bytes.hpp"

namespace berth::app {
namespace {

using Html = std::back_insert_iterator<std::string>;

void add_joint_offsets(const CalibrationReport& report, Html out) {
  const CalibrationResult& result = *report.result;
  if (result.joint_offsets.empty() && result.joints_not_determined.empty()) return;
  fmt::format_to(out,
                 "<section><h2>Joint zeros</h2>\n<p>Added to what the joints tell.</p>\n<table>"
                 "<tr><th>joint</th><th>offset</th></tr>\n");
  for (const MovableJoint& joint : report.calibration_data->model->joints) {
    const auto offset = result.joint_offsets.find(joint.name);
    if (offset == result.joint_offsets.end()) continue;
    fmt::format_to(
        out, "<tr><td>{}</td><td>{}</td></tr>\n", html_text(joint.name),
        joint.type == JointType::prismatic
            ? fmt::format("{:.1f} mm", 1e3 * offset->second)
            : fmt::format("{:.4f} rad ({:.2f}°)", offset->second, offset->second * 180 / EIGEN_PI));
  }
  fmt::format_to(out, "</table>\n");
  for (const std::string& name : result.joints_not_determined) {
    fmt::format_to(out, "<p>{}: these images do not tell; it stays.</p>\n", html_text(name));
  }
  fmt::format_to(out, "</section>\n");
}

std::string head(const std::string& title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head>"
      "<meta charset=\"utf-8\"/>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>"
      "<title>Calibration of {0}</title><style>{1}</style></head>\n<body><main>\n"
      "<h1>Calibration of {0}</h1>\n",
      html_text(title), kCalibrationPageStyle);
}

}  // namespace

void write_calibration_page(const std::filesystem::path& folder, const std::string& title,
                            const CalibrationReport& report) {
  std::filesystem::create_directories(folder);
  std::string html = head(title);
  const auto out = std::back_inserter(html);
  for (const std::string& warning : report.warnings) {
    fmt::format_to(out, "<p class=\"warning\">{}</p>\n", html_text(warning));
  }
  for (std::size_t camera = 0; camera < report.result->cameras.size(); ++camera) {
    html += camera_section(folder, report, camera);
  }
  html += attached_section(folder, report);
  html += detection_section(report.detection);
  add_joint_offsets(report, out);
  html += "</main></body></html>\n";
  write_file_bytes(folder / "index.html", html);
}

}  // namespace berth::app
