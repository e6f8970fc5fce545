#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/scene_run.hpp"
#include "bindings.hpp"
#include "handles.hpp"

namespace berth::python {
namespace {

/// Ctrl-C while C++ works.
void stop_if_interrupted() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

struct SceneHandle {
  std::shared_ptr<const OpenScene> scene;
};

/// One image of a scene, and the result after it.
struct SceneStep {
  std::shared_ptr<Frame> frame;
  DepthImage depth_m;
  std::size_t number;
  bool begins_result;
  std::vector<double> joints;
  Part<Result> result;
};

/// A run of a scene, one image after another.
class SceneIterator {
 public:
  explicit SceneIterator(const SceneHandle& handle) : scene_(handle.scene) {}

  std::shared_ptr<SceneStep> next() {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (!run_) run_.emplace(*scene_, stop_if_interrupted);
    if (!run_->next()) throw py::stop_iteration();
    const DepthView depth_m = run_->sensor_depth_m();
    auto step = std::make_shared<SceneStep>();
    step->frame = std::const_pointer_cast<Frame>(run_->frame());
    step->depth_m.resize(depth_m.width, depth_m.height, kNoDepth);
    for (int v = 0; v < depth_m.height; ++v) {
      std::copy(depth_m.row(v), depth_m.row(v) + depth_m.width, step->depth_m.row(v));
    }
    step->number = run_->frame_number();
    step->begins_result = run_->begins_result();
    step->joints = run_->camera().at_exposure[step->number].position;
    step->result = owned(run_->ask());
    return step;
  }

 private:
  std::shared_ptr<const OpenScene> scene_;
  std::mutex mutex_;
  std::optional<SceneRun> run_;
};

SceneHandle open(const std::filesystem::path& file) {
  const py::gil_scoped_release release;
  return {std::make_shared<OpenScene>(open_scene(read_scene(file), stop_if_interrupted))};
}

std::vector<std::shared_ptr<MountedCamera>> cameras(const SceneHandle& handle) {
  std::vector<std::shared_ptr<MountedCamera>> all;
  for (const OpenCamera& camera : handle.scene->cameras) {
    all.push_back(std::const_pointer_cast<MountedCamera>(camera.mounted));
  }
  return all;
}

}  // namespace

void bind_scene(py::module_& m) {
  py::class_<SceneStep, std::shared_ptr<SceneStep>>(
      m, "SceneStep", "One image of a scene, and the result after it.")
      .def_readonly("frame", &SceneStep::frame, "Frame: what the image tells")
      .def_property_readonly(
          "depth_m",
          [](const py::object& self) { return array_of(self.cast<SceneStep&>().depth_m, self); },
          "numpy.ndarray: the camera's image, float32, NaN where there is no reading")
      .def_readonly("number", &SceneStep::number, "int: among the images of its camera")
      .def_readonly("begins_result", &SceneStep::begins_result,
                    "bool: False where another camera's image of the same stamp came before: the\n"
                    "result is that step's")
      .def_property_readonly(
          "joints",
          [](const SceneStep& s) {
            return py::array_t<double>(static_cast<py::ssize_t>(s.joints.size()), s.joints.data());
          },
          "numpy.ndarray: the joints at the exposure, in the robot's order")
      .def_property_readonly(
          "result", [](const SceneStep& s) { return s.result; },
          "Result: of the robot as it stood then, against the newest image of each camera");
  py::class_<SceneIterator>(m, "SceneIterator", "A run of a scene.")
      .def(
          "__iter__", [](SceneIterator& self) -> SceneIterator& { return self; },
          py::return_value_policy::reference)
      .def("__next__", &SceneIterator::next);
  py::class_<SceneHandle>(
      m, "Scene",
      "A scene file and all that it names, read and checked. Iterating over it\n"
      "runs it, each time anew.")
      .def_property_readonly(
          "file", [](const SceneHandle& h) { return h.scene->file.string(); }, "str: its path")
      .def_property_readonly(
          "robot",
          [](const SceneHandle& h) { return std::const_pointer_cast<Robot>(h.scene->robot); },
          "Robot: with the scene's evaluation settings")
      .def_property_readonly("views", &cameras, "List[MountedCamera]: one for each camera")
      .def("__len__", [](const SceneHandle& h) { return h.scene->frame_count; })
      .def("__iter__", [](const SceneHandle& h) { return std::make_unique<SceneIterator>(h); });
  m.def("open_scene", &open, py::arg("file"),
        "Opens a scene file, each image too. Raises FileNotFoundError or ValueError that names\n"
        "file, place, value and what was expected.");
}

}  // namespace berth::python
