#include <pybind11/stl.h>

#include <mutex>

#include "arrays.hpp"
#include "berth/pipeline/trajectory.hpp"
#include "bindings.hpp"
#include "handles.hpp"

#include <fmt/format.h>

namespace berth::python {
namespace {

std::vector<FrameHandle> frames_of(const py::object& frames) {
  if (py::isinstance<FrameHandle>(frames)) return {frames.cast<FrameHandle>()};
  std::vector<FrameHandle> all;
  for (const py::handle one : frames) {
    all.push_back(one.is_none() ? FrameHandle{} : one.cast<FrameHandle>());
  }
  if (all.empty()) throw std::invalid_argument("frames: none; expected one at least");
  return all;
}

LiveFrames pointers_of(const std::vector<FrameHandle>& frames) {
  LiveFrames pointers;
  for (const FrameHandle& one : frames) pointers.push_back(one.frame);
  return pointers;
}

/// An asker that several threads may call, one after another.
class SharedAsker {
 public:
  explicit SharedAsker(std::shared_ptr<Robot> robot) : robot_(std::move(robot)), one_(robot_, 1) {}

  std::shared_ptr<AnswerHandle> ask(const py::object& of, const py::object& joints,
                                    std::optional<double> now_s, double joints_stamp_s) {
    const std::vector<FrameHandle> frames = frames_of(of);
    if (joints.is_none()) {
      return locked(frames, [&](LiveAsker& asker, const LiveFrames& f) -> const Answer& {
        return asker.ask_at_exposure(f, now_s);
      });
    }
    if (is_buffer(joints)) {
      if (!now_s) throw std::invalid_argument("now_s: none; expected the question's time, since joints are a JointBuffer");
      const JointBuffer& buffer = buffer_of(joints);
      return locked(frames, [&](LiveAsker& asker, const LiveFrames& f) -> const Answer& {
        return asker.ask(f, buffer, *now_s);
      });
    }
    const JointState state = joints_of(robot_->model(), joints, joints_stamp_s);
    return locked(frames, [&](LiveAsker& asker, const LiveFrames& f) -> const Answer& {
      return asker.ask(f, state, now_s);
    });
  }

 private:
  template <class Ask>
  std::shared_ptr<AnswerHandle> locked(const std::vector<FrameHandle>& frames, const Ask& ask) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    LiveAsker& asker = asker_for(frames.size());
    const Answer& answer = ask(asker, pointers_of(frames));
    auto handle = std::make_shared<AnswerHandle>(
        AnswerHandle{robot_, answer, cameras_of(frames, answer, asker.cameras())});
    if (asks_images(robot_->settings().method)) {
      fill_base_points(handle->cameras, handle->answer.distances);
    }
    return handle;
  }
  LiveAsker& asker_for(std::size_t count) {
    if (count == 1) return one_;
    if (!several_ || count != count_) several_.emplace(robot_, count);
    count_ = count;
    return *several_;
  }

  std::shared_ptr<Robot> robot_;
  std::mutex mutex_;
  LiveAsker one_;
  std::optional<LiveAsker> several_;
  std::size_t count_ = 0;
};

/// A look-ahead that several threads may call, one after another.
class SharedTrajectoryAsker {
 public:
  explicit SharedTrajectoryAsker(std::shared_ptr<Robot> robot)
      : robot_(std::move(robot)), asker_(robot_) {}

  py::dict ask(const py::object& of, const py::object& trajectory, double nearer_than_m,
               std::optional<double> now_s) {
    const LiveFrames frames = pointers_of(frames_of(of));
    const std::vector<JointState> joints = many_joints_of(robot_->model(), trajectory);
    TrajectoryAnswer answer;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      assign(frames, now_s);
      answer = asker_.ask(set_, joints, nearer_than_m, now_s);
    }
    const auto poses = static_cast<py::ssize_t>(answer.poses.size());
    const auto links = static_cast<py::ssize_t>(robot_->model().link_count());
    py::array_t<float> distance_m({poses, links});
    py::array_t<float> lower_bound_m({poses, links});
    for (py::ssize_t i = 0; i < poses; ++i) {
      for (py::ssize_t k = 0; k < links; ++k) {
        distance_m.mutable_at(i, k) = answer.poses[i][k].nearest.distance_m;
        lower_bound_m.mutable_at(i, k) = answer.poses[i][k].nearest.lower_bound_m;
      }
    }
    py::object first = py::none();
    if (answer.first_nearer) first = py::int_(*answer.first_nearer);
    return py::dict(py::arg("time_status") = answer.time.status, py::arg("distance_m") = distance_m,
                    py::arg("lower_bound_m") = lower_bound_m, py::arg("first_nearer") = first);
  }

 private:
  void assign(const LiveFrames& frames, std::optional<double> now_s) {
    if (frames == frames_ && !now_s) return;
    frames_ = frames;
    pointers_.clear();
    for (const auto& frame : frames_) pointers_.push_back(frame.get());
    set_.assign(pointers_, robot_->settings().time, now_s);
  }

  std::shared_ptr<Robot> robot_;
  std::mutex mutex_;
  TrajectoryAsker asker_;
  LiveFrames frames_;
  std::vector<const Frame*> pointers_;
  FrameSet set_;
};

}  // namespace

void bind_asker(py::module_& m) {
  py::class_<SharedAsker>(m, "Asker",
                          "Answers questions about frames. Threads that ask at the same time have\n"
                          "an Asker each; they may ask the same frames.")
      .def(py::init<std::shared_ptr<Robot>>(), py::arg("robot"))
      .def("ask", &SharedAsker::ask, py::arg("frames"), py::arg("joints") = py::none(),
           py::arg("now_s") = std::nullopt, py::arg("joints_stamp_s") = 0.0,
           "How far each link is from everything that the frames show or hide. frames: one\n"
           "Frame, or the newest one of each camera (None where there is none yet; one camera\n"
           "only unless the method is mesh). joints: those of the exposure (None), any others\n"
           "(rad, m; by name or in the robot's order), or a JointBuffer, whose newest count.\n"
           "With now_s ages are told and judged; untimely answers have no distance.");
  py::class_<SharedTrajectoryAsker>(m, "TrajectoryAsker",
                                    "Look-ahead with method mesh: many poses in one call.")
      .def(py::init<std::shared_ptr<Robot>>(), py::arg("robot"))
      .def("ask", &SharedTrajectoryAsker::ask, py::arg("frames"), py::arg("trajectory"),
           py::arg("nearer_than_m"), py::arg("now_s") = std::nullopt,
           "The distances along rows of joints: distance_m and lower_bound_m, (poses, links),\n"
           "and first_nearer, the first pose at which some link may be nearer than the limit.");
}

}  // namespace berth::python
