#include "apps/view/scene_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/berth/picture_palette.hpp"
#include "apps/berth/residual_colors.hpp"
#include "berth/results/result_json.hpp"

namespace berth::app {
namespace {

using Json = nlohmann::ordered_json;

Json links_json(const RobotModel& model) {
  Json links = Json::array();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const bool is_evaluated = link.role == LinkRole::evaluated;
    links.push_back({{"name", link.name},
                     {"id", link.id},
                     {"is_evaluated", is_evaluated},
                     {"is_moved", model.is_moved(i)},
                     {"color", is_evaluated ? css(link_color(link.id)) : "#8a8a8a"}});
  }
  return links;
}

Json cameras_json(const std::vector<PageCamera>& all) {
  Json cameras = Json::array();
  for (const auto& [name, camera] : all) {
    cameras.push_back({{"name", name},
                       {"width_px", camera.width_px},
                       {"height_px", camera.height_px},
                       {"fx_px", camera.fx_px},
                       {"fy_px", camera.fy_px},
                       {"cx_px", camera.cx_px},
                       {"cy_px", camera.cy_px}});
  }
  return cameras;
}

Json steps_json(const std::vector<ImageStep>& steps) {
  Json json = Json::array();
  for (const ImageStep& step : steps) json.push_back({step.camera, step.frame, step.stamp_s});
  return json;
}

Json fates_json() {
  Json fates = Json::array();
  for (int i = 0; i < kPixelFateCount; ++i) {
    const auto fate = static_cast<PixelFate>(i);
    fates.push_back(
        {{"name", name_of(fate)}, {"color", css(fate_color(fate))}, {"is_kept", is_kept(fate)}});
  }
  return fates;
}

/// How readings of the robot fit its model, as in the report of a calibration.
Json misfits_json() {
  Json misfits = Json::array();
  for (const ResidualColor& stop : residual_scale()) {
    misfits.push_back(
        {{"behind_mm", std::round(1000 * stop.residual_m)}, {"color", css(stop.color)}});
  }
  return misfits;
}

Json rows_of(const Pose& X) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) rows.push_back(X.matrix()(row, column));
  }
  return rows;
}

template <class T>
std::span<const std::byte> bytes_of_all(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace

PageMessage scene_message(const std::string& name, const RobotModel& model,
                          const std::vector<PageCamera>& cameras,
                          const std::vector<ImageStep>& steps) {
  return json_message({{"type", "scene"},
                       {"file", name},
                       {"robot", model.name},
                       {"links", links_json(model)},
                       {"cameras", cameras_json(cameras)},
                       {"steps", steps_json(steps)},
                       {"fates", fates_json()},
                       {"misfits", misfits_json()}});
}

PageMessage scene_message(const OpenScene& scene, const std::vector<ImageStep>& steps) {
  return scene_message(scene.file.string(), scene.robot->model(), page_cameras(scene), steps);
}

std::vector<PageCamera> page_cameras(const OpenScene& scene) {
  std::vector<PageCamera> cameras;
  for (const OpenCamera& one : scene.cameras) {
    cameras.push_back({one.source.name, one.mounted->camera()});
  }
  return cameras;
}

PageMessage mesh_message(const RobotModel& model) {
  Json header = {{"type", "mesh"}, {"corners", {}}, {"triangles", {}}};
  std::vector<float> corners_m;
  std::vector<std::uint32_t> triangles;
  for (const Link& link : model.links) {
    header["corners"].push_back(link.mesh_L.vertices_m.size());
    header["triangles"].push_back(link.mesh_L.triangles.size());
    for (const Eigen::Vector3f& corner : link.mesh_L.vertices_m) {
      corners_m.insert(corners_m.end(), corner.begin(), corner.end());
    }
    for (const auto& triangle : link.mesh_L.triangles) {
      triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    }
  }
  return binary_message(header, {bytes_of_all(corners_m), bytes_of_all(triangles)});
}

PageMessage shown_message(const RobotModel& model, const Result& result,
                          const std::vector<const Frame*>& frames, const ShownStep& of) {
  Json json = {{"type", "shown"},
               {"step", of.step},
               {"is_provisional", of.is_provisional},
               {"links", {}},
               {"cameras", {}}};
  const auto posed = [](const Frame* frame) {
    return frame && frame->time.status == TimeStatus::ok;
  };
  const auto at = std::find_if(frames.begin(), frames.end(), posed);
  const Frame* newest = at == frames.end() ? nullptr : *at;
  for (const Frame* frame : frames) {
    if (posed(frame) && frame->stamp_s > newest->stamp_s) newest = frame;
    json["cameras"].push_back(posed(frame) ? rows_of(frame->X_BC) : Json());
  }
  // A result that is stale has no pose, and the robot is to be seen all the same.
  const bool has_pose = !result.pose.X_BL.empty();
  const RobotPose* pose = has_pose ? &result.pose : newest ? &newest->pose : nullptr;
  for (std::size_t i = 0; pose && i < model.links.size(); ++i) {
    json["links"].push_back(rows_of(pose->X_BL[i]));
  }
  json["result"] = Json::parse(result_json(result));
  return json_message(json);
}

int shown_stride(const std::vector<PageCamera>& cameras) {
  std::size_t pixels = 0;
  for (const auto& [name, camera] : cameras) {
    pixels += static_cast<std::size_t>(camera.width_px) * camera.height_px;
  }
  std::size_t stride = 1;
  while (pixels > kMostShownPixels * stride * stride) ++stride;
  return static_cast<int>(stride);
}

PageMessage image_message(std::size_t camera, std::size_t number, const DepthImage& sensor_depth_m,
                          const Frame& frame, int stride) {
  constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::min();
  constexpr float kMost_mm = std::numeric_limits<std::int16_t>::max();
  const bool has_robot = frame.time.status == TimeStatus::ok;
  const int width = (sensor_depth_m.width() + stride - 1) / stride;
  const int height = (sensor_depth_m.height() + stride - 1) / stride;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  std::vector<float> depth_m(pixels);
  std::vector<PixelFate> fates(pixels, PixelFate::no_reading);
  std::vector<LinkId> links(pixels, kNoLink);
  std::vector<std::int16_t> behind_mm(pixels, kNone);
  for (std::size_t i = 0; i < pixels; ++i) {
    const int u = static_cast<int>(i) % width * stride, v = static_cast<int>(i) / width * stride;
    depth_m[i] = sensor_depth_m(u, v);
    if (!has_robot) continue;
    fates[i] = frame.obstacles.fate(u, v);
    links[i] = frame.robot.link_id(u, v);
    const float behind_m = depth_m[i] - frame.robot.depth_m(u, v);
    if (is_kept(fates[i])) depth_m[i] = frame.obstacles.depth_m(u, v);
    if (std::isnan(behind_m)) continue;
    behind_mm[i] =
        static_cast<std::int16_t>(std::lround(std::clamp(1000 * behind_m, -kMost_mm, kMost_mm)));
  }
  const Json header = {{"type", "image"},   {"camera", camera},    {"frame", number},
                       {"width_px", width}, {"height_px", height}, {"stride", stride}};
  return binary_message(header, {bytes_of_all(depth_m), bytes_of_all(fates), bytes_of_all(links),
                                 bytes_of_all(behind_mm)});
}

}  // namespace berth::app
