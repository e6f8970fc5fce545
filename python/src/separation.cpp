#include <pybind11/stl.h>

#include <array>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/results/result_text.hpp"
#include "bindings.hpp"
#include "handles.hpp"
#include "monitor.hpp"
#include "settings.hpp"

namespace berth::python {
namespace {

using Rows = std::vector<std::array<double, 3>>;

Rows rows_of(const SeparationSettings& settings) {
  Rows rows;
  for (const StoppingRow& row : settings.stopping) {
    rows.push_back({row.speed_m_s, row.time_s, row.distance_m});
  }
  return rows;
}

void set_rows(SeparationSettings& settings, const Rows& rows) {
  settings.stopping.clear();
  for (const auto& row : rows) settings.stopping.push_back({row[0], row[1], row[2]});
}

void bind_separation_settings(py::module_& m) {
  bind_settings<SeparationSettings>(m, "SeparationSettings", "separation",
                                    "How fast the robot may go on beside people.");
  py::reinterpret_borrow<py::class_<SeparationSettings>>(m.attr("SeparationSettings"))
      .def_property("stopping", &rows_of, &set_rows,
                    "List[List[float]]: rows of speed (m/s), time (s) and distance (m) from the\n"
                    "robot's data, in place of deceleration_m_s2");
}

}  // namespace

void bind_separation(py::module_& m) {
  bind_separation_settings(m);
  py::class_<SharedMonitor, std::shared_ptr<SharedMonitor>>(
      m, "SeparationMonitor",
      "Speed and separation monitoring: how fast the robot may go on, after each request.\n"
      "Not a certified safety function. Give it to Query.ask.")
      .def(py::init([](std::shared_ptr<Robot> robot, SeparationSettings settings) {
             return std::make_shared<SharedMonitor>(std::move(robot), std::move(settings));
           }),
           py::arg("robot"), py::arg_v("settings", SeparationSettings{}, "SeparationSettings()"))
      .def_property_readonly("settings", &SharedMonitor::settings,
                             "SeparationSettings: a copy of those it was made with");
}

void bind_separation_result(py::module_& m) {
  using SeparationPart = Part<Separation>;
  py::class_<SeparationPart>(m, "Separation", "How fast the robot may go on, and why not faster.")
      .def_property_readonly(
          "state", [](const SeparationPart& s) { return s->state; },
          "SeparationState: whether it may go on, at what speed, or has to stand")
      .def_property_readonly(
          "speed_scale", [](const SeparationPart& s) { return s->speed_scale; },
          "float: by which the joint velocities are to be multiplied, 0 to 1")
      .def_property_readonly(
          "basis", [](const SeparationPart& s) { return s->basis; },
          "SeparationBasis: what the scale was shown by")
      .def_property_readonly(
          "reason", [](const SeparationPart& s) { return s->reason; },
          "SeparationReason: why the scale is not larger")
      .def_property_readonly(
          "link",
          [](const SeparationPart& s) {
            return s->link == kNoLink ? std::optional<std::string>()
                                      : s.result->links[s->link - 1].link;
          },
          "Optional[str]: the link that says so")
      .def_property_readonly(
          "camera",
          [](const SeparationPart& s) {
            return s->camera < 0 ? std::optional<std::string>()
                                 : s.result->cameras[s->camera].camera;
          },
          "Optional[str]: the camera that is not used, where that is the reason")
      .def_property_readonly(
          "reaction_time_s", [](const SeparationPart& s) { return s->reaction_time_s; },
          "float: until the robot obeys, with the age of the images")
      .def_property_readonly(
          "text", [](const SeparationPart& s) { return separation_text(*s.result); },
          "str: all that as a sentence")
      .def("__repr__", [](const SeparationPart& s) {
        return "Separation(" + separation_text(*s.result) + ")";
      });
}

}  // namespace berth::python
