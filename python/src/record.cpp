#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/record/replay.hpp"
#include "bindings.hpp"
#include "handles.hpp"
#include "recorder.hpp"

namespace berth::python {
namespace {

std::shared_ptr<SharedRecorder> make(const std::filesystem::path& file,
                                     const std::shared_ptr<Robot>& robot,
                                     const std::vector<std::shared_ptr<MountedCamera>>& cameras,
                                     const std::optional<SeparationSettings>& separation,
                                     double seconds, bool on_stop, double after_stop_s) {
  RecorderSettings settings;
  settings.file = file;
  settings.seconds = seconds;
  settings.on_stop = on_stop;
  settings.after_stop_s = after_stop_s;
  return std::make_shared<SharedRecorder>(
      robot, std::vector<std::shared_ptr<const MountedCamera>>(cameras.begin(), cameras.end()),
      separation, settings);
}

void put(SharedRecorder& self, const Frame& frame, const py::object& depth,
         std::optional<double> depth_scale) {
  const DepthInput input = depth_of(depth, depth_scale);
  const py::gil_scoped_release release;
  self.recorder.put(frame, input.view);
}

void finish(SharedRecorder& self) {
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  self.recorder.finish();
}

void write(SharedRecorder& self) {
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  self.recorder.write();
}

struct ReplayStep {
  std::int64_t number;
  double time_s;
  Part<Result> result;
  std::optional<ReplayDifference> difference;
  std::string text;
};

class ReplayIterator {
 public:
  explicit ReplayIterator(const std::filesystem::path& file) : replay_(file) {}

  ReplayStep next() {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (!replay_.next()) throw py::stop_iteration();
    return {replay_.number(), replay_.time_s(), owned(replay_.result()), replay_.difference(),
            replay_.text()};
  }

 private:
  std::mutex mutex_;
  Replay replay_;
};

void bind_recorder(py::module_& m) {
  py::class_<SharedRecorder, std::shared_ptr<SharedRecorder>>(
      m, "Recorder",
      "A black box: what a monitor saw and said in the last seconds, in a ring on disk, written "
      "as\n"
      "an MCAP file when the monitor stops the robot, or on request. Give it each frame before it\n"
      "is asked, and itself to Query.ask.")
      .def(py::init(&make), py::arg("file"), py::arg("robot"), py::arg("views"),
           py::arg("separation") = std::nullopt, py::arg("seconds") = 30.0,
           py::arg("on_stop") = true, py::arg("after_stop_s") = 1.0,
           "The first recording is written to file, the next ones to FILE_2 and so on; nothing "
           "that\n"
           "is there is overwritten. separation: the monitor's settings.")
      .def("put", &put, py::arg("frame"), py::arg("depth"), py::arg("depth_scale") = py::none(),
           "A frame, and the image that it was made of.")
      .def("write", &write, "Writes a recording of what was given so far. Returns at once.")
      .def("finish", &finish,
           "Waits until everything is written. Raises ValueError where something went wrong.")
      .def_property_readonly(
          "files", [](const SharedRecorder& s) { return s.recorder.counts().files; },
          "List[pathlib.Path]: the recordings that were written")
      .def_property_readonly(
          "lost",
          [](const SharedRecorder& s) {
            const RecorderCounts counts = s.recorder.counts();
            return py::make_tuple(counts.lost_images, counts.lost_requests);
          },
          "Tuple[int, int]: images and requests that the disk was too slow for");
}

void bind_replay(py::module_& m) {
  py::class_<ReplayStep>(m, "ReplayStep", "One request of a recording, asked once more.")
      .def_readonly("number", &ReplayStep::number, "int: of the request, in the recorder's life")
      .def_readonly("time_s", &ReplayStep::time_s, "float: of the request")
      .def_property_readonly(
          "result", [](const ReplayStep& s) { return s.result; }, "Result: as it is now")
      .def_property_readonly(
          "difference",
          [](const ReplayStep& s) -> py::object {
            if (!s.difference) return py::none();
            return py::make_tuple(s.difference->field, s.difference->recorded,
                                  s.difference->replayed);
          },
          "Optional[Tuple[str, str, str]]: the first field that is not as recorded, and both "
          "values\n"
          "as JSON; None where all are the same to the last bit")
      .def_readonly("text", &ReplayStep::text, "str: the difference as a sentence");
  py::class_<ReplayIterator>(m, "Replay", "A recording, replayed request by request.")
      .def(
          "__iter__", [](ReplayIterator& self) -> ReplayIterator& { return self; },
          py::return_value_policy::reference)
      .def("__next__", &ReplayIterator::next);
  m.def(
      "replay",
      [](const std::filesystem::path& file) {
        const py::gil_scoped_release release;
        return std::make_unique<ReplayIterator>(file);
      },
      py::arg("file"),
      "Does once more what a Recorder recorded. Raises FileNotFoundError or ValueError that names\n"
      "file, what is wrong and what was expected; of a file that is cut off, as by a crash, after\n"
      "all that it has.");
}

}  // namespace

void bind_record(py::module_& m) {
  bind_recorder(m);
  bind_replay(m);
}

}  // namespace berth::python
