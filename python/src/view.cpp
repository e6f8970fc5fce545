#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/files/camera_info.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "bindings.hpp"
#include "handles.hpp"

namespace berth::python {
namespace {

std::shared_ptr<MountedCamera> make_view(std::shared_ptr<Robot> robot, const Camera& camera,
                                         const std::string& parent_link, const py::object& X_PC,
                                         const SelfFilterSettings& self_filter,
                                         const SensorSettings& sensor, const SpaceSettings& space,
                                         const WatchSettings& watch,
                                         const std::map<std::string, double>& link_padding_m,
                                         const std::string& name) {
  CameraSettings settings{self_filter, link_padding_m, sensor, space, watch};
  CameraMount mount{camera, parent_link, pose_of(X_PC, "X_PC"), name};
  return std::make_shared<MountedCamera>(std::move(robot), std::move(mount), std::move(settings));
}

/// An observer that several threads may call, one after another.
class SharedObserver {
 public:
  explicit SharedObserver(const std::shared_ptr<MountedCamera>& mounted)
      : mounted_(mounted), observer_(mounted) {}

  std::shared_ptr<Frame> observe(const py::object& depth, const py::object& joints, double stamp_s,
                                 std::optional<double> depth_scale, double clock_offset_s) {
    const DepthInput input = depth_of(depth, depth_scale);
    if (is_buffer(joints)) {
      const JointBuffer& buffer = buffer_of(joints);
      return locked([&](Frame& frame) {
        observer_.observe(input.view, stamp_s, buffer, frame, clock_offset_s);
      });
    }
    const JointState state = joints_of(mounted_->robot()->model(), joints, stamp_s);
    return locked([&](Frame& frame) { observer_.observe(input.view, state, frame); });
  }

  void learn_background(const py::object& depth, const Frame& frame,
                        std::optional<double> depth_scale) {
    const DepthInput input = depth_of(depth, depth_scale);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    observer_.learn_background(input.view, frame);
  }

 private:
  template <class Observe>
  std::shared_ptr<Frame> locked(const Observe& observe) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    const std::shared_ptr<Frame> frame = pool_.take();
    observe(*frame);
    return frame;
  }

  std::shared_ptr<const MountedCamera> mounted_;
  std::mutex mutex_;
  Observer observer_;
  FramePool pool_;
};

/// An array that looks into an image of a frame and keeps the frame.
template <class Get>
auto image_of(const Get& get) {
  return [get](const py::object& self) { return array_of(get(self.cast<const Frame&>()), self); };
}

void bind_camera(py::module_& m) {
  py::class_<Camera>(m, "Camera",
                     "A pinhole camera; whole pixel coordinates are pixel centres, as in ROS and\n"
                     "OpenCV. Its optical frame C has z forward, x right, y down.")
      .def(py::init([](int width_px, int height_px, double fx_px, double fy_px, double cx_px,
                       double cy_px) {
             return Camera{width_px, height_px, fx_px, fy_px, cx_px, cy_px};
           }),
           py::arg("width_px"), py::arg("height_px"), py::arg("fx_px"), py::arg("fy_px"),
           py::arg("cx_px"), py::arg("cy_px"))
      .def_readonly("width_px", &Camera::width_px, "int: columns")
      .def_readonly("height_px", &Camera::height_px, "int: rows")
      .def_readonly("fx_px", &Camera::fx_px, "float: focal length, horizontally")
      .def_readonly("fy_px", &Camera::fy_px, "float: focal length, vertically")
      .def_readonly("cx_px", &Camera::cx_px, "float: column of the optical axis")
      .def_readonly("cy_px", &Camera::cy_px, "float: row of the optical axis")
      .def("__repr__", [](const Camera& c) {
        return fmt::format(
            "Camera(width_px={}, height_px={}, fx_px={}, fy_px={}, cx_px={}, cy_px={})", c.width_px,
            c.height_px, c.fx_px, c.fy_px, c.cx_px, c.cy_px);
      });
  m.def(
      "read_camera_info",
      [](const std::filesystem::path& file) { return read_camera_info(file).camera; },
      py::arg("file"), "The intrinsics of a ROS camera_info file (YAML) of rectified images.");
}

void bind_frame(py::module_& m) {
  py::class_<Frame, std::shared_ptr<Frame>>(
      m, "Frame",
      "What one depth image tells. Its arrays are views, read only, and keep the frame alive.")
      .def_property_readonly(
          "camera", [](const Frame& f) { return f.mounted->mount().name; },
          "str: the camera's name")
      .def_property_readonly(
          "stamp_s", [](const Frame& f) { return f.stamp_s; }, "float: the exposure")
      .def_property_readonly(
          "time_status", [](const Frame& f) { return f.time.status; },
          "TimeStatus: unless it is ok the images are empty")
      .def_property_readonly(
          "X_BC", [](const Frame& f) { return array_of(f.X_BC); },
          "numpy.ndarray: the camera's pose in the robot's root frame, 4 x 4")
      .def_property_readonly(
          "robot_depth_m", image_of([](const Frame& f) -> auto& { return f.robot.depth_m; }),
          "numpy.ndarray: the robot's surface, rows x columns, float32; NaN elsewhere")
      .def_property_readonly(
          "link_id", image_of([](const Frame& f) -> auto& { return f.robot.link_id; }),
          "numpy.ndarray: i + 1 where link_names[i] is seen, 65535 for environment, else 0")
      .def_property_readonly(
          "obstacle_depth_m", image_of([](const Frame& f) -> auto& { return f.obstacles.depth_m; }),
          "numpy.ndarray: what is left without the robot, float32; NaN elsewhere")
      .def_property_readonly("fate",
                             image_of([](const Frame& f) -> auto& { return f.obstacles.fate; }),
                             "numpy.ndarray: what became of each pixel, numbers of PixelFate")
      .def_property_readonly(
          "fate_count", [](const Frame& f) { return dict_of(f.obstacles.count); },
          "Dict[str, int]: pixels of each PixelFate")
      .def_property_readonly(
          "is_blind", [](const Frame& f) { return f.is_blind; },
          "bool: hardly a pixel has a reading");
}

}  // namespace

void bind_view(py::module_& m) {
  bind_camera(m);
  py::class_<MountedCamera, std::shared_ptr<MountedCamera>>(
      m, "MountedCamera", "One camera that sees the robot. Constant; share it.")
      .def(py::init(&make_view), py::arg("robot"), py::arg("camera"), py::arg("parent_link"),
           py::arg("X_PC"), py::arg_v("self_filter", SelfFilterSettings{}, "SelfFilterSettings()"),
           py::arg_v("sensor", SensorSettings{}, "SensorSettings()"),
           py::arg_v("space", SpaceSettings{}, "SpaceSettings()"),
           py::arg_v("watch", CameraSettings{}.watch, "WatchSettings(tell_only=True)"),
           py::arg("link_padding_m") = std::map<std::string, double>{}, py::arg("name") = "camera",
           "X_PC is the pose, 4 x 4, of the camera's optical frame C in the frame P of\n"
           "parent_link, the link that it is fixed to.")
      .def_property_readonly(
          "name", [](const MountedCamera& v) { return v.mount().name; }, "str: the camera's name")
      .def_property_readonly("camera", &MountedCamera::camera, "Camera: its intrinsics")
      .def_property_readonly(
          "parent_link", [](const MountedCamera& v) { return v.mount().parent_link; },
          "str: the link that it is fixed to")
      .def_property_readonly(
          "X_PC", [](const MountedCamera& v) { return array_of(v.mount().X_PC); },
          "numpy.ndarray: its pose in that link's frame, 4 x 4")
      .def_property_readonly(
          "self_filter", [](const MountedCamera& v) { return v.settings().self_filter; },
          "SelfFilterSettings: what counts as the robot")
      .def_property_readonly(
          "sensor", [](const MountedCamera& v) { return v.settings().sensor; },
          "SensorSettings: the camera's faults");
  bind_frame(m);
  py::class_<SharedObserver>(m, "Observer", "Makes frames of one camera's depth images.")
      .def(py::init<const std::shared_ptr<MountedCamera>&>(), py::arg("view"))
      .def("observe", &SharedObserver::observe, py::arg("depth"), py::arg("joints"),
           py::arg("stamp_s") = 0.0, py::arg("depth_scale") = std::nullopt,
           py::arg("clock_offset_s") = 0.0,
           "The frame of a depth image: rows x columns, float32 in metres or uint16 times\n"
           "depth_scale (0.001), along the optical axis; NaN, 0, negative and infinite are no\n"
           "reading. joints are those of the exposure (rad, m; by name or in the robot's order),\n"
           "or a JointBuffer that has them around stamp_s + clock_offset_s.")
      .def("learn_background", &SharedObserver::learn_background, py::arg("depth"),
           py::arg("frame"), py::arg("depth_scale") = std::nullopt,
           "Learns what the image shows beside the robot, where sensor.background_frames asks\n"
           "for it; frame is what observe made of it.");
}

}  // namespace berth::python
