#include "berth/pipeline/query.hpp"

#include <pybind11/stl.h>

#include <mutex>
#include <set>
#include <stdexcept>

#include "arrays.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "bindings.hpp"
#include "handles.hpp"
#include "monitor.hpp"
#include "recorder.hpp"

namespace berth::python {

std::vector<std::shared_ptr<const Frame>> frames_of(const py::object& frames) {
  if (py::isinstance<Frame>(frames)) return {frames.cast<std::shared_ptr<Frame>>()};
  std::vector<std::shared_ptr<const Frame>> all;
  std::set<std::string> names;
  for (const py::handle one : frames) {
    all.push_back(one.cast<std::shared_ptr<Frame>>());
    if (!all.back() || !all.back()->mounted) continue;
    const std::string& name = all.back()->mounted->mount().name;
    if (names.insert(name).second) continue;
    throw std::invalid_argument(
        fmt::format("frames: two of a camera named \"{}\"; expected one of each camera, and a name "
                    "of its own for each: MountedCamera(..., name=)",
                    name));
  }
  return all;
}

namespace {

/// How the robot goes on, as its owner.
struct Motion {
  std::vector<double> velocity;
  std::vector<JointState> path;
};

Motion motion_of(const RobotModel& model, const py::object& velocity, const py::object& path,
                 const std::vector<double>& path_s) {
  Motion motion;
  if (!velocity.is_none()) motion.velocity = joints_of(model, velocity, 0).position;
  motion.path = many_joints_of(model, path);
  if (motion.path.size() != path_s.size()) {
    throw std::invalid_argument(
        fmt::format("path_s: {} times; expected one for each of {} rows of path", path_s.size(),
                    motion.path.size()));
  }
  for (std::size_t i = 0; i < path_s.size(); ++i) motion.path[i].stamp_s = path_s[i];
  return motion;
}

/// A query that several threads may ask, one after another.
class SharedQuery {
 public:
  SharedQuery(const std::shared_ptr<Robot>& robot, std::vector<std::string> camera_names)
      : robot_(robot), loop_(robot, std::move(camera_names)) {}

  Part<Result> ask(const py::object& of, const py::object& joints, std::optional<double> now_s,
                   double joints_stamp_s, const py::object& ahead, double nearer_than_m,
                   const std::optional<std::shared_ptr<SharedMonitor>>& monitor,
                   const py::object& velocity, const py::object& path,
                   const std::vector<double>& path_s,
                   const std::optional<std::shared_ptr<SharedRecorder>>& recorder) {
    const std::vector<std::shared_ptr<const Frame>> frames = frames_of(of);
    const Motion motion = motion_of(robot_->model(), velocity, path, path_s);
    if (monitor && !now_s) throw std::invalid_argument("monitor: expected now_s with it");
    JointState state;
    RequestedJoints requested;
    if (is_buffer(joints)) {
      requested = buffer_of(joints);
    } else if (!joints.is_none()) {
      state = joints_of(robot_->model(), joints, joints_stamp_s);
      requested = state;
    }
    const std::vector<JointState> poses = many_joints_of(robot_->model(), ahead);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    const Request request{.frames = frames,
                          .joints = requested,
                          .now_s = now_s,
                          .ahead = poses,
                          .nearer_than_m = nearer_than_m};
    std::unique_lock<std::mutex> recording;
    if (recorder) recording = std::unique_lock((*recorder)->mutex);
    Recorder* const into = recorder ? &(*recorder)->recorder : nullptr;
    loop_.record_with(into);
    Result result = loop_.ask(request);
    if (monitor) {
      result.separation =
          (*monitor)->update(into, result, {motion.velocity, motion.path}, *now_s, loop_.frames());
    }
    return owned(std::move(result));
  }

  void forget() {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    loop_.forget();
  }

 private:
  std::shared_ptr<const Robot> robot_;
  std::mutex mutex_;
  /// Python's monitors are objects of their own.
  MonitorLoop loop_;
};

}  // namespace

void bind_query(py::module_& m) {
  py::class_<SharedQuery>(
      m, "Query",
      "Requests about the newest frames of all cameras. Threads that ask at the\n"
      "same time have a Query each; they may ask the same frames.")
      .def(py::init<const std::shared_ptr<Robot>&, std::vector<std::string>>(), py::arg("robot"),
           py::arg("camera_names") = std::vector<std::string>(),
           "camera_names are those of cameras that have given no frame yet.")
      .def("ask", &SharedQuery::ask, py::arg("frames"), py::arg("joints") = py::none(),
           py::arg("now_s") = std::nullopt, py::arg("joints_stamp_s") = 0.0,
           py::arg("ahead") = py::none(), py::arg("nearer_than_m") = 0.0,
           py::arg("monitor") = std::nullopt, py::arg("velocity") = py::none(),
           py::arg("path") = py::none(), py::arg("path_s") = std::vector<double>(),
           py::arg("recorder") = std::nullopt,
           "How far each link is from everything that the frames show or hide. frames: one\n"
           "Frame, or the newest one of each camera (None where there is none yet). joints:\n"
           "those of the exposure (None), any others (rad, m; by name or in the robot's order),\n"
           "or a JointBuffer, whose newest count. With now_s ages are told and judged; a stale\n"
           "result has no distance. ahead: rows of joints, poses that the robot may take next;\n"
           "Result.ahead tells their distances, and the first pose at which some link may be\n"
           "nearer than nearer_than_m. monitor: with now_s, Result.separation tells how fast the\n"
           "robot may go on. velocity: the joints' (rad/s, m/s), as measured, or as planned at\n"
           "full speed; without it the robot stops. path: rows of joints where the robot goes\n"
           "from here at full speed, after path_s seconds. recorder: it records the request.")
      .def("forget", &SharedQuery::forget,
           "A request begins with what is known of the one before; after this nothing is known.");
}

}  // namespace berth::python
