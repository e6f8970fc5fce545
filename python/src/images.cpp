#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/files/camera_info.hpp"
#include "berth/files/png.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/rectification.hpp"
#include "bindings.hpp"
#include "thesis/evaluate.hpp"

#include <fmt/format.h>

namespace berth::python {
namespace {

/// An array that owns the image.
template <class T>
py::array owned(Image<T>&& image) {
  auto* kept = new Image<T>(std::move(image));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Image<T>*>(p); });
  using Number = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
  return py::array_t<Number>({kept->height(), kept->width()},
                             reinterpret_cast<const Number*>(kept->pixels().data()), owner);
}

void require_size(const Camera& camera, int width, int height, const char* name) {
  if (width == camera.width_px && height == camera.height_px) return;
  throw std::invalid_argument(fmt::format("{}: {} x {} pixels; expected the camera's {} x {}", name,
                                          width, height, camera.width_px, camera.height_px));
}

using LinkIds = py::array_t<LinkId, py::array::c_style | py::array::forcecast>;

RobotImage robot_image(const Camera& camera, const py::object& depth_m, const py::object& ids) {
  RobotImage robot;
  const LinkIds link_id = LinkIds::ensure(ids);
  if (!link_id) throw py::error_already_set();
  const DepthInput depth = depth_of(depth_m, {});
  require_size(camera, depth.view.width, depth.view.height, "robot_depth_m");
  if (link_id.ndim() != 2) throw std::invalid_argument("link_id: expected rows and columns");
  require_size(camera, static_cast<int>(link_id.shape(1)), static_cast<int>(link_id.shape(0)),
               "link_id");
  robot.depth_m = DepthImage(camera.width_px, camera.height_px, kNoDepth);
  robot.link_id = Image<LinkId>(camera.width_px, camera.height_px, kNoLink);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = link_id.at(v, u);
      if ((id == kNoLink) != std::isnan(depth.view(u, v))) {
        throw std::invalid_argument(fmt::format(
            "link_id: {} at ({}, {}), where robot_depth_m is {}; expected 0 exactly where "
            "there is no depth",
            id, u, v, depth.view(u, v)));
      }
      robot.depth_m(u, v) = depth.view(u, v);
      robot.link_id(u, v) = id;
    }
  }
  return robot;
}

py::tuple render(const RobotModel& model, const py::object& joints, const Camera& camera,
                 const py::object& X_BC) {
  RobotPose pose;
  forward_kinematics(model, joints_of(model, joints, 0).position, pose);
  const Pose camera_pose = pose_of(X_BC, "X_BC");
  RobotImage image;
  {
    const py::gil_scoped_release release;
    RobotRenderer(build_link_meshes(model), camera).render(pose, camera_pose, image);
  }
  return py::make_tuple(owned(std::move(image.depth_m)), owned(std::move(image.link_id)));
}

py::tuple filter(const py::object& depth, const py::object& robot_depth_m,
                 const py::object& link_id, const Camera& camera,
                 const SelfFilterSettings& settings, std::optional<double> depth_scale) {
  validate(settings);
  const DepthInput input = depth_of(depth, depth_scale);
  require_size(camera, input.view.width, input.view.height, "depth");
  const RobotImage robot = robot_image(camera, robot_depth_m, link_id);
  ObstacleImage obstacles;
  {
    const py::gil_scoped_release release;
    SelfFilterWorkspace workspace;
    self_filter(camera, input.view, robot, settings, workspace, obstacles);
  }
  return py::make_tuple(owned(std::move(obstacles.depth_m)), owned(std::move(obstacles.fate)));
}

Method method_of(const std::string& name) {
  for (const Method method : kCpuMethods) {
    if (name_of(method) == name) return method;
  }
  throw std::invalid_argument(
      fmt::format("method: \"{}\"; expected one of exact, brute_force, lattice", name));
}

py::list evaluate_images(const py::object& robot_depth_m, const py::object& link_id,
                         const py::object& obstacle_depth_m, const Camera& camera, int link_count,
                         const std::string& method, double range_m,
                         std::optional<double> tolerance_m) {
  const Method chosen = method_of(method);
  ImageDistanceSettings settings;
  settings.range_m = range_m;
  settings.tolerance_m = tolerance_m;
  const RobotImage robot = robot_image(camera, robot_depth_m, link_id);
  for (const LinkId id : robot.link_id.pixels()) {
    if (id <= link_count || id == kEnvironmentLink) continue;
    throw std::invalid_argument(fmt::format(
        "link_id: {}; expected numbers up to link_count, which is {}, or 65535", id, link_count));
  }
  const DepthInput obstacles = depth_of(obstacle_depth_m, {});
  require_size(camera, obstacles.view.width, obstacles.view.height, "obstacle_depth_m");
  LinkDistances distances;
  {
    const py::gil_scoped_release release;
    SearchableDepth searchable;
    searchable.build(obstacles.view);
    EvaluateWorkspace workspace;
    evaluate(chosen, {camera, robot, link_count, searchable, settings}, workspace, distances);
  }
  py::list links;
  const auto point = [](const Eigen::Vector3f& p) { return py::array_t<float>(3, p.data()); };
  for (const LinkDistance& link : distances.links) {
    links.append(py::dict(
        py::arg("status") = link.status, py::arg("distance_m") = link.distance_m,
        py::arg("lower_bound_m") = link.lower_bound_m,
        py::arg("robot_pixel") = py::make_tuple(link.robot_pixel.u, link.robot_pixel.v),
        py::arg("obstacle_pixel") = py::make_tuple(link.obstacle_pixel.u, link.obstacle_pixel.v),
        py::arg("robot_point_C_m") = point(link.robot_point_C_m),
        py::arg("obstacle_point_C_m") = point(link.obstacle_point_C_m),
        py::arg("mean_direction_C") = point(link.mean_direction_C),
        py::arg("mean_count") = link.mean_count));
  }
  return links;
}

py::array read_png(const std::filesystem::path& file, const Camera& camera, double depth_scale) {
  return owned(read_depth_png(file, camera, depth_scale));
}

void write_png(const std::filesystem::path& file, const py::object& depth, double depth_scale) {
  const bool is_whole = py::isinstance<py::array_t<std::uint16_t, 0>>(depth);
  const DepthInput input = depth_of(depth, is_whole ? std::optional(depth_scale) : std::nullopt);
  write_depth_png(file, input.view, depth_scale);
}

Rectification make_rectification(const std::filesystem::path& file, bool is_rectified,
                                 bool is_along_ray) {
  const CameraInfo info = read_camera_info(file, is_rectified);
  return {info.camera, info.lens, is_along_ray ? DepthIs::along_ray : DepthIs::along_axis};
}

py::array rectify(const Rectification& self, const py::object& depth,
                  std::optional<double> depth_scale) {
  const DepthInput input = depth_of(depth, depth_scale);
  require_size(self.given(), input.view.width, input.view.height, "depth");
  return owned(self.apply(input.view));
}

void bind_rectification(py::module_& m) {
  py::class_<Rectification>(
      m, "Rectification",
      "Makes depth images as a camera gives them into those of a pinhole camera: without the\n"
      "lens's distortion, and along the axis. Of two readings that fall into one pixel the nearer\n"
      "one is kept.")
      .def(py::init(&make_rectification), py::arg("file"), py::kw_only(),
           py::arg("rectified") = false, py::arg("along_ray") = false,
           "Of a ROS camera_info file (YAML). With rectified its distortion does not count; with\n"
           "along_ray a reading is the distance from the camera, not the depth along its axis.")
      .def_property_readonly("camera", &Rectification::camera,
                             "Camera: of the images that are made, for MountedCamera")
      .def("apply", &rectify, py::arg("depth"), py::arg("depth_scale") = std::nullopt,
           "The image that is made of this one, in metres, float32; NaN is no reading.");
}

}  // namespace

void bind_images(py::module_& m) {
  bind_rectification(m);
  m.def("render", &render, py::arg("model"), py::arg("joints"), py::arg("camera"), py::arg("X_BC"),
        "The robot as the camera would see it alone: its depth (float32, NaN where it is not) and\n"
        "the numbers of the links (uint16).");
  m.def("self_filter", &filter, py::arg("depth"), py::arg("robot_depth_m"), py::arg("link_id"),
        py::arg("camera"), py::arg_v("settings", SelfFilterSettings{}, "SelfFilterSettings()"),
        py::arg("depth_scale") = std::nullopt,
        "Takes the robot out of a depth image. robot_depth_m and link_id are those of render().\n"
        "Gives what is left (float32, NaN elsewhere) and the fate of each pixel (PixelFate).");
  m.def(
      "needs_copy",
      [](const py::object& depth, std::optional<double> depth_scale) {
        return depth_of(depth, depth_scale).kept.ptr() != depth.ptr();
      },
      py::arg("depth"), py::arg("depth_scale") = std::nullopt,
      "Whether berth copies this depth image before it works on it, in place of looking at it.");
  m.def("read_depth_png", &read_png, py::arg("file"), py::arg("camera"), py::arg("depth_scale"),
        "For berth.io.read_depth.");
  m.def("write_depth_png", &write_png, py::arg("file"), py::arg("depth"), py::arg("depth_scale"),
        "For berth.io.write_depth.");
  m.def("evaluate", &evaluate_images, py::arg("robot_depth_m"), py::arg("link_id"),
        py::arg("obstacle_depth_m"), py::arg("camera"), py::arg("link_count"),
        py::arg("method") = "exact", py::arg("range_m") = 1.0,
        py::arg("tolerance_m") = std::nullopt,
        "The distances between the links in one image and what is in another, up to range_m, by\n"
        "a method that compares images: exact, brute_force or lattice. exact may stop once it\n"
        "knows a distance to tolerance_m. One dict for each link, in frame C.");
}

}  // namespace berth::python
