#include "apps/berth/calibration_page_parts.hpp"

#include <fmt/format.h>

#include <iterator>

#include "apps/berth/calibration_picture.hpp"
#include "apps/berth/residual_colors.hpp"

namespace berth::app {
namespace {

/// The colours from the one end of the scale to the other.
std::string gradient() {
  std::string stops;
  for (const ResidualColor& stop : residual_scale()) stops += ", " + css(stop.color);
  return "linear-gradient(to right" + stops + ")";
}

std::string key(const std::string& style, const std::string& text) {
  return fmt::format("<span><i class=\"key\" style=\"background: {}\"></i>{}</span> ", style, text);
}

std::string striped(const Stripes& stripes) {
  return fmt::format("repeating-linear-gradient(135deg, {0} 0 4px, {1} 4px 6px)", css(stripes.dark),
                     css(stripes.light));
}

std::string legend() {
  return fmt::format(
      "<div class=\"scale\"><div class=\"bar\" style=\"background: {}\"></div>"
      "<div class=\"ticks\"><span>−100</span><span>−30</span><span>−10</span><span>0 mm</span>"
      "<span>+10</span><span>+30</span><span>+100</span></div></div>\n"
      "<p class=\"faint keys\">{}{}{}{}{}{}</p>\n",
      gradient(), key(css(residual_color(-0.02)), "reading nearer than the model"),
      key(css(residual_color(0.02)), "farther"),
      key(striped(beyond_scale(-1)), "something more than 10 cm in front of the robot"),
      key(striped(beyond_scale(1)), "the camera sees through the model"),
      key(css(kFlyingPixelColor), "beside the model, like the robot, and not in most other images"),
      key(css(kOutlineColor) + "; outline: 1px solid var(--line)",
          "outline of the model, light where there is no reading"));
}

std::string figure(const FramePicture& picture, int number, const char* side) {
  if (picture.file.empty()) {
    return fmt::format(
        "<figure><div class=\"none\">The joints are not known at the clock that was found.</div>"
        "<figcaption><strong>{}</strong></figcaption></figure>",
        side);
  }
  return fmt::format(
      "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"frame {1}, {2}\" loading=\"lazy\"/></a>"
      "<figcaption><strong>{2}</strong>: {3} px beside the model are like the "
      "robot</figcaption></figure>",
      picture.file, number, side, picture.flying_px);
}

}  // namespace

std::string frames_html(const CalibrationCamera& source, const CameraCalibration& found,
                        const CalibrationFrames& frames) {
  std::string html = "<h3>The images</h3>\n";
  const auto out = std::back_inserter(html);
  const std::size_t shown = frames.pictures.size(), all = source.frames.size();
  fmt::format_to(out, "<p>{} Each is cut to the robot; the grey is depth, near is bright. ",
                 shown == all ? fmt::format("All {} that were used.", all)
                              : fmt::format("{} of the {} that were used, spread over them, with "
                                            "the one that agrees worst.",
                                            shown, all));
  fmt::format_to(out,
                 "The robot is white where the reading is where the model is. After a good "
                 "calibration it is pale, without a blue or orange rim on one side.</p>\n");
  html += legend();
  const bool has_after = found.refused.empty();
  for (const FramePictures& frame : frames.pictures) {
    fmt::format_to(out, "<h4>Frame {}</h4>\n<div class=\"frame\">{}{}</div>\n", frame.number,
                   figure(frame.before, frame.number, has_after ? "before" : "the scene's pose"),
                   has_after ? figure(frame.after, frame.number, "after") : "");
  }
  return html;
}

}  // namespace berth::app
