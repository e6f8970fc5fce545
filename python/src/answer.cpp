#include <pybind11/stl.h>

#include "arrays.hpp"
#include "berth/scene/answer_result.hpp"
#include "berth/scene/result_json.hpp"
#include "bindings.hpp"
#include "handles.hpp"

#include <fmt/format.h>

namespace berth::python {

FrameResult AnswerHandle::result() const {
  FrameResult result = result_of(*robot, answer);
  result.frame = frame;
  result.stamp_s = stamp_s.value_or(answer.frame_stamp_s);
  result.cameras = cameras;
  return result;
}

std::vector<CameraResult> cameras_of(const std::vector<FrameHandle>& frames, const Answer& answer,
                                     const std::vector<CameraState>& states) {
  std::vector<CameraResult> cameras(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    cameras[k].name = frames[k].camera;
    cameras[k].state = k < answer.cameras.size() ? answer.cameras[k] : states[k];
    if (!frames[k].frame) continue;
    cameras[k].frame = 0;
    cameras[k].X_BC = frames[k].frame->X_BC;
    cameras[k].self_filter = frames[k].frame->obstacles.count;
  }
  return cameras;
}

void fill_base_points(const std::vector<CameraResult>& cameras, LinkDistances& distances) {
  if (cameras.size() != 1 || !cameras.front().X_BC) return;
  const Eigen::Isometry3f X_BC = cameras.front().X_BC->cast<float>();
  for (LinkDistance& link : distances.links) {
    link.robot_point_B_m = X_BC * link.robot_point_C_m;
    link.obstacle_point_B_m = X_BC * link.obstacle_point_C_m;
    link.mean_direction_B = X_BC.linear() * link.mean_direction_C;
    if (link.has_distance()) link.view = 0;
  }
}

namespace {

/// One link of an answer, which it keeps.
struct LinkHandle {
  std::shared_ptr<const AnswerHandle> answer;
  std::size_t index;

  const LinkDistance& get() const { return answer->answer.distances.links[index]; }
};

using AnswerPointer = std::shared_ptr<AnswerHandle>;

std::vector<std::string> link_names(const AnswerHandle& handle) {
  return handle.robot->model().evaluated_link_names();
}

LinkHandle link_at(const AnswerPointer& handle, py::ssize_t index) {
  const auto count = static_cast<py::ssize_t>(handle->answer.distances.links.size());
  if (index < 0) index += count;
  if (index < 0 || index >= count) throw py::index_error("there are " + std::to_string(count) + " links");
  return {handle, static_cast<std::size_t>(index)};
}

LinkHandle link_named(const AnswerPointer& handle, const std::string& name) {
  const std::vector<std::string> names = link_names(*handle);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw py::key_error(fmt::format("\"{}\" is no link of the robot; expected one of {}", name,
                                    fmt::join(names, ", ")));
  }
  return {handle, static_cast<std::size_t>(found - names.begin())};
}

std::vector<LinkHandle> links(const AnswerPointer& handle) {
  std::vector<LinkHandle> all;
  for (std::size_t i = 0; i < handle->answer.distances.links.size(); ++i) all.push_back({handle, i});
  return all;
}

/// Of the links that move, the one that is nearest to something.
std::optional<LinkHandle> nearest(const AnswerPointer& handle) {
  std::optional<LinkHandle> least;
  const RobotModel& model = handle->robot->model();
  for (const LinkHandle& link : links(handle)) {
    if (!link.get().has_distance() || !model.is_moved(model.evaluated_links[link.index])) continue;
    if (!least || link.get().distance_m < least->get().distance_m) least = link;
  }
  return least;
}

py::array_t<float> array_of_vector(const Eigen::Vector3f& v) {
  py::array_t<float> array(3);
  std::copy(v.data(), v.data() + 3, array.mutable_data());
  return array;
}

/// Of each link, by a member of LinkDistance; `first` is its first number.
template <class First>
auto column_of(const First& first, int count = 1) {
  return [first, count](const py::object& self) {
    const auto& rows = self.cast<const AnswerHandle&>().answer.distances.links;
    static const LinkDistance none;
    return column(rows, first(rows.empty() ? none : rows.front()), count, self);
  };
}

py::object camera_of(const LinkHandle& link) {
  const int view = link.get().view;
  const auto& cameras = link.answer->cameras;
  if (view < 0 || static_cast<std::size_t>(view) >= cameras.size()) return py::none();
  return py::str(cameras[view].name);
}

py::object visibility_of(const AnswerHandle& handle, std::size_t index) {
  if (handle.answer.visibility.empty()) return py::none();
  const LinkVisibility& own = handle.answer.visibility[index];
  const auto shares = [](const SightShares& s) {
    return py::dict(py::arg("seen") = s.seen, py::arg("hidden_by_obstacles") = s.hidden_by_obstacles,
                    py::arg("hidden_by_robot") = s.hidden_by_robot,
                    py::arg("no_reading") = s.no_reading, py::arg("outside_image") = s.outside_image);
  };
  return py::dict(py::arg("surface") = shares(own.surface), py::arg("space") = shares(own.space),
                  py::arg("space_unknown") = own.space_unknown,
                  py::arg("doubtful_distance_m") = own.doubtful_distance_m);
}

void bind_link(py::module_& m) {
  py::class_<LinkHandle>(m, "LinkDistance",
                         "One link's distance. What is not known is NaN. Points and directions\n"
                         "are in frame B, the robot's root link.")
      .def_property_readonly(
          "name", [](const LinkHandle& l) { return link_names(*l.answer)[l.index]; },
          "str: the link's name")
      .def_property_readonly(
          "status", [](const LinkHandle& l) { return l.get().status; },
          "LinkStatus: what is known of it")
      .def_property_readonly(
          "distance_m", [](const LinkHandle& l) { return l.get().distance_m; },
          "float: to the nearest thing that is seen or hidden")
      .def_property_readonly(
          "lower_bound_m", [](const LinkHandle& l) { return l.get().lower_bound_m; },
          "float: nothing that is seen or hidden is nearer")
      .def_property_readonly(
          "robot_point_B_m", [](const LinkHandle& l) { return array_of_vector(l.get().robot_point_B_m); },
          "numpy.ndarray: the link's closest point")
      .def_property_readonly(
          "obstacle_point_B_m",
          [](const LinkHandle& l) { return array_of_vector(l.get().obstacle_point_B_m); },
          "numpy.ndarray: the obstacle's closest point")
      .def_property_readonly(
          "obstacle_kind", [](const LinkHandle& l) { return l.get().obstacle_kind; },
          "ObstacleKind: whether it was measured, or is hidden behind something that was")
      .def_property_readonly("camera", &camera_of,
                             "Optional[str]: the camera that sees it, or what hides it")
      .def_property_readonly(
          "obstacle_pixel",
          [](const LinkHandle& l) { return py::make_tuple(l.get().obstacle_pixel.u, l.get().obstacle_pixel.v); },
          "Tuple[int, int]: column and row in that camera's image; -1 where there is none")
      .def_property_readonly(
          "reading_distance_m", [](const LinkHandle& l) { return l.get().reading.distance_m; },
          "float: to what is seen alone")
      .def_property_readonly(
          "mean_direction_B",
          [](const LinkHandle& l) { return array_of_vector(l.get().mean_direction_B); },
          "numpy.ndarray: mean of the unit vectors to what is near")
      .def_property_readonly(
          "visibility", [](const LinkHandle& l) { return visibility_of(*l.answer, l.index); },
          "Optional[Dict[str, object]]: how much of the link and of the space around it is seen")
      .def("__repr__", [](const LinkHandle& l) {
        return fmt::format("LinkDistance({}, {}, {:.4f} m)", link_names(*l.answer)[l.index],
                           name_of(l.get().status), l.get().distance_m);
      });
}

void bind_camera_state(py::module_& m) {
  py::class_<CameraResult>(m, "CameraState", "One camera's part in an answer.")
      .def_readonly("name", &CameraResult::name, "str: the camera's name")
      .def_property_readonly(
          "status", [](const CameraResult& c) { return c.state.status; },
          "CameraStatus: whether its frame is used")
      .def_property_readonly(
          "stamp_s", [](const CameraResult& c) { return c.state.stamp_s; }, "float: of its frame")
      .def_property_readonly(
          "age_s", [](const CameraResult& c) { return c.state.age_s; }, "float: of its frame")
      .def("__repr__", [](const CameraResult& c) {
        return fmt::format("CameraState({}, {})", c.name, name_of(c.state.status));
      });
}

}  // namespace

void bind_answer(py::module_& m) {
  bind_link(m);
  bind_camera_state(m);
  using L = LinkDistance;
  py::class_<AnswerHandle, AnswerPointer>(
      m, "Answer",
      "The distances of all links. Arrays have a row for each of link_names, look into the\n"
      "answer, read only, and keep it alive; what is not known is NaN. Frame B is the robot's\n"
      "root link.")
      .def_property_readonly("link_names", &link_names, "List[str]: the links, in this order")
      .def_property_readonly("link_is_moved",
                             [](const AnswerHandle& h) {
                               const RobotModel& model = h.robot->model();
                               std::vector<bool> moved;
                               for (const std::size_t i : model.evaluated_links) moved.push_back(model.is_moved(i));
                               return moved;
                             },
                             "List[bool]: whether a joint moves the link")
      .def_property_readonly("distance_m", column_of([](const L& l) { return &l.distance_m; }),
                             "numpy.ndarray: (links,), to the nearest thing that is seen or hidden")
      .def_property_readonly("lower_bound_m", column_of([](const L& l) { return &l.lower_bound_m; }),
                             "numpy.ndarray: (links,), nothing is nearer")
      .def_property_readonly("reading_distance_m",
                             column_of([](const L& l) { return &l.reading.distance_m; }),
                             "numpy.ndarray: (links,), to what is seen alone")
      .def_property_readonly("robot_point_B_m",
                             column_of([](const L& l) { return l.robot_point_B_m.data(); }, 3),
                             "numpy.ndarray: (links, 3), closest points of the links")
      .def_property_readonly("obstacle_point_B_m",
                             column_of([](const L& l) { return l.obstacle_point_B_m.data(); }, 3),
                             "numpy.ndarray: (links, 3), closest points of the obstacles")
      .def_property_readonly("mean_direction_B",
                             column_of([](const L& l) { return l.mean_direction_B.data(); }, 3),
                             "numpy.ndarray: (links, 3), mean of the unit vectors to what is near")
      .def_property_readonly("status",
                             [](const AnswerHandle& h) {
                               std::vector<LinkStatus> all;
                               for (const L& link : h.answer.distances.links) all.push_back(link.status);
                               return all;
                             },
                             "List[LinkStatus]: what is known of each link")
      .def_property_readonly("links", &links, "List[LinkDistance]: one for each link")
      .def_property_readonly("nearest", &nearest,
                             "Optional[LinkDistance]: of the links that a joint moves, the one with\n"
                             "the least distance")
      .def("__getitem__", &link_at, py::arg("index"), "The link with this number.")
      .def("__getitem__", &link_named, py::arg("name"), "The link of this name.")
      .def("__len__", [](const AnswerHandle& h) { return h.answer.distances.links.size(); })
      .def_readonly("cameras", &AnswerHandle::cameras,
                    "List[CameraState]: each camera's part in it")
      .def_property_readonly(
          "time_status", [](const AnswerHandle& h) { return h.answer.time.status; },
          "TimeStatus: unless it is ok no link has a distance")
      .def_property_readonly(
          "frame_stamp_s", [](const AnswerHandle& h) { return h.answer.frame_stamp_s; },
          "float: the newest exposure")
      .def_property_readonly(
          "joints_stamp_s", [](const AnswerHandle& h) { return h.answer.joints_stamp_s; },
          "float: of the joints that were asked for")
      .def_property_readonly(
          "frame_age_s", [](const AnswerHandle& h) { return h.answer.time.frame_age_s; },
          "float: at the question; NaN where nobody told its time")
      .def_property_readonly(
          "joints_age_s", [](const AnswerHandle& h) { return h.answer.time.joints_age_s; },
          "float: at the question; NaN where nobody told its time")
      .def("to_json", [](const AnswerHandle& h) { return result_json(h.result()); },
           "As a line of `berth run --format json`.")
      .def("__repr__", [](const AnswerPointer& h) {
        const auto least = nearest(h);
        return fmt::format("Answer({} links, {}{})", h->answer.distances.links.size(),
                           name_of(h->answer.time.status),
                           least ? fmt::format(", nearest {} {:.4f} m", link_names(*h)[least->index],
                                               least->get().distance_m)
                                 : std::string());
      });
}

}  // namespace berth::python
