#include "apps/berth/calibration_page_parts.hpp"

#include <fmt/format.h>

#include <iterator>

#include "apps/berth/attached_picture.hpp"
#include "apps/berth/html_text.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/reports/calibration_words.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth::app {
namespace {

using Html = std::back_insert_iterator<std::string>;

void add_pictures(const std::filesystem::path& folder, const CalibrationReport& report,
                  const CarryingRobotData& carrying, std::size_t camera, Html out) {
  CalibratedRobot calibrated(carrying.calibration_data(), *report.result, camera);
  const auto bare_links = static_cast<LinkId>(report.calibration_data->model->link_count());
  fmt::format_to(out, "<h4>{}</h4>\n<div class=\"frame\">", html_text(calibrated.source().name));
  for (std::size_t k = 0; k < calibrated.source().frames.size(); ++k) {
    const RobotImage* robot = calibrated.draw(k, CalibrationSide::after);
    if (!robot) continue;
    const CalibrationFrame& frame = calibrated.source().frames[k];
    const std::string file =
        fmt::format("camera_{}_frame_{:06}_carried.png", camera + 1, frame.number);
    write_file_bytes(folder / file, attached_picture_png({frame.depth_m, depth_tone(frame.depth_m),
                                                          robot, bare_links}));
    fmt::format_to(out,
                   "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"frame {1}, what is carried\" "
                   "loading=\"lazy\"/></a><figcaption>Frame {1}</figcaption></figure>",
                   file, frame.number);
  }
  fmt::format_to(out, "</div>\n");
}

}  // namespace

std::string attached_section(const std::filesystem::path& folder, const CalibrationReport& report) {
  const AttachedParts& attached = report.attached;
  if (attached.parts.empty() && attached.refused.empty()) return "";
  std::string html = "<section>\n<h2>What the robot carries</h2>\n";
  const auto out = std::back_inserter(html);
  if (!attached.refused.empty()) {
    fmt::format_to(out, "<p>{}</p>\n", html_text(attached.refused));
  }
  for (const AttachedPart& part : attached.parts) {
    fmt::format_to(out, "<p class=\"lead\">{}</p>\n<p>{}</p>\n", html_text(attached_text(part)),
                   html_text(attached_use_text(part)));
  }
  if (!attached.parts.empty()) {
    fmt::format_to(
        out,
        "<p>Is it the robot's in each image, and nothing of the room? What is taken by mistake is "
        "never seen as an obstacle again.</p>\n"
        "<p class=\"faint keys\"><span><i class=\"key\" style=\"background: {}\"></i>what was "
        "found</span><span><i class=\"key\" style=\"background: {}\"></i>the robot as its URDF has "
        "it</span></p>\n",
        css(kAttachedColor), css(kBareRobotColor));
    const CarryingRobotData carrying(*report.calibration_data, attached, CarriedParts::all);
    for (std::size_t camera = 0; camera < report.result->cameras.size(); ++camera) {
      add_pictures(folder, report, carrying, camera, out);
    }
  }
  return html + "</section>\n";
}

}  // namespace berth::app
