#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/reports/calibration_report.hpp"
#include "berth/scene/calibrate_scene.hpp"
#include "bindings.hpp"

namespace berth::python {
namespace {

/// A calibration and all that it refers to.
struct CalibrationHandle {
  OpenScene scene;
  SceneCalibrationData material;
  CalibrateSceneSettings settings;
  SceneCalibration calibration;

  CalibrationReport report() const {
    return report_of(material, calibration, settings.correct_depth);
  }
};

std::shared_ptr<CalibrationHandle> calibrate_file(const std::filesystem::path& file,
                                                  bool joint_zeros, bool correct_depth) {
  const auto pause = [] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  const py::gil_scoped_release release;
  auto handle = std::make_shared<CalibrationHandle>();
  handle->scene = open_scene_with_images(read_scene_to_calibrate(file), pause);
  handle->material = make_calibration_data(handle->scene);
  handle->settings = {{.joint_zeros = joint_zeros, .pause = pause}, correct_depth};
  handle->calibration = calibrate_scene(handle->scene, handle->material, handle->settings);
  return handle;
}

void write(const CalibrationHandle& handle, const std::filesystem::path& new_scene) {
  write_rewritten_scene(handle.scene.file, handle.calibration.change, new_scene);
}

py::array residuals(const ResidualSpread& spread) {
  const double values[] = {spread.median_m, spread.p90_m, spread.p99_m};
  return py::array_t<double>(3, values);
}

}  // namespace

void bind_calibration(py::module_& m) {
  using C = CameraCalibration;
  py::class_<C>(m, "CameraCalibration", "What a calibration found of one camera.")
      .def_readonly("camera", &C::camera, "str: its name")
      .def_property_readonly(
          "X_PC", [](const C& c) { return array_of(c.X_PC); },
          "numpy.ndarray: the optical frame's pose in the frame of the link that the camera is\n"
          "fixed to, 4 x 4")
      .def_readonly("moved_m", &C::moved_m,
                    "float: how far the robot's points have moved from where the scene had them")
      .def_readonly("halves_m", &C::halves_m,
                    "float: how far they lie apart between a fit to the even and one to the odd\n"
                    "frames; NaN with fewer than two")
      .def_readonly("clock_offset_s", &C::clock_offset_s,
                    "float: the joints' clock at an exposure is its stamp plus this")
      .def_property_readonly(
          "before_m", [](const C& c) { return residuals(c.before); },
          "numpy.ndarray: residuals at the scene's pose: median, 90 %, 99 %")
      .def_property_readonly(
          "after_m", [](const C& c) { return residuals(c.after); },
          "numpy.ndarray: residuals at the pose that was found: median, 90 %, 99 %")
      .def_readonly("frames", &C::frames, "List[int]: the images that were used")
      .def_readonly("not_determined", &C::not_determined, "List[str]: what the images do not tell")
      .def_readonly("refused", &C::refused,
                    "str: why the pose that was found is not to be used; empty: it is good");
  using H = CalibrationHandle;
  py::class_<H, std::shared_ptr<H>>(m, "Calibration", "What a calibration found.")
      .def_property_readonly(
          "cameras", [](const H& h) { return h.calibration.found.cameras; },
          "List[CameraCalibration]: one for each camera of the scene")
      .def_property_readonly(
          "joint_offsets", [](const H& h) { return h.calibration.found.joint_offsets; },
          "Dict[str, float]: with joint_zeros, to be added to the joints' positions, rad or m")
      .def_property_readonly(
          "warnings", [](const H& h) { return h.calibration.warnings; },
          "List[str]: what makes the result worse than it could be")
      .def("write", &write, py::arg("new_scene"),
           "Writes the user's scene file with what was found to another file.")
      .def(
          "to_json", [](const H& h) { return calibration_json(h.report()); },
          "As `berth calibrate --format json`.")
      .def(
          "table", [](const H& h) { return calibration_table(h.report()); },
          "As `berth calibrate` prints it.");
  m.def("calibrate", &calibrate_file, py::arg("scene_file"), py::arg("joint_zeros") = false,
        py::arg("correct_depth") = false,
        "Calibration of a scene file: its cameras' poses and clocks, and settings that fit them.\n"
        "Raises ValueError where nothing can be calibrated, and says why.");
}

}  // namespace berth::python
