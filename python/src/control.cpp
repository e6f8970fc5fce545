#include "arrays.hpp"
#include "berth/control/velocity_filter.hpp"
#include "bindings.hpp"
#include "handles.hpp"
#include "settings.hpp"

namespace berth::python {
namespace {

template <class Numbers>
py::array array_of(const Numbers& numbers) {
  py::array_t<double> out({numbers.rows(), numbers.cols()});
  std::copy_n(numbers.data(), numbers.size(), out.mutable_data());
  return out;
}

/// A copy, since the next update writes over it.
struct Filtered {
  FilteredVelocity of;
  std::vector<std::pair<std::string, RowKind>> held_by;
};

/// The filter and its robot, by whose joints numbers are named.
class NamedFilter {
 public:
  NamedFilter(const std::shared_ptr<Robot>& robot, const VelocityFilterSettings& settings)
      : robot_(robot), filter_(robot, settings) {}

  Filtered update(const Part<Result>& result, const py::object& position,
                  const py::object& velocity, const py::object& wanted, const py::object& weight) {
    const auto numbers = [&](const py::object& joints) {
      return joints_of(robot_->model(), joints, 0).position;
    };
    const std::vector<double> q = numbers(position), v = numbers(velocity), w = numbers(wanted);
    const std::vector<double> weights = weight.is_none() ? std::vector<double>() : numbers(weight);
    Filtered out{filter_.update(*result, {q, v, w, weights}), {}};
    for (const LinkRow& row : out.of.held_by) {
      out.held_by.emplace_back(result->links[row.link - 1].link, row.kind);
    }
    return out;
  }

 private:
  std::shared_ptr<const Robot> robot_;
  VelocityFilter filter_;
};

void bind_rows(py::module_& m) {
  py::class_<DistanceRows> rows(
      m, "DistanceRows",
      "How the distances of a result change with the joints: arrays of links x joints, in the\n"
      "order of Result.link_names and RobotModel.joint_names. For one thread.");
  rows.def(py::init<std::shared_ptr<Robot>>(), py::arg("robot"))
      .def(
          "update", [](DistanceRows& self, const Part<Result>& result) { self.update(*result); },
          py::arg("result"), "Takes up a result of this robot; else raises ValueError.")
      .def(
          "gradient",
          [](const DistanceRows& self, RowKind kind, int candidate) {
            return array_of(self.gradient(kind, candidate));
          },
          py::arg("kind"), py::arg("candidate") = 0,
          "d(distance)/dq of each link's pair, (links, joints) in m/rad, or m/m where the joint\n"
          "slides. NaN where there is no pair, 0 in contact. Of RowKind.nearest, candidate k is\n"
          "LinkResult.candidates[k - 1]; 0 is the link's own pair.")
      .def(
          "normal",
          [](const DistanceRows& self, RowKind kind, int candidate) {
            return array_of(self.normal_B(kind, candidate));
          },
          py::arg("kind"), py::arg("candidate") = 0,
          "From the obstacle's point of each link's pair to the link's, (links, 3), of length 1, "
          "in\n"
          "the robot's root frame. In contact that of the last result in which they were apart; "
          "NaN\n"
          "where there is no pair, or none was apart before.")
      .def(
          "reach_m",
          [](const DistanceRows& self, RowKind kind) { return array_of(self.reach_m(kind)); },
          py::arg("kind"),
          "What a motion can cost at most, (links, joints): after any step dq nothing of this "
          "kind\n"
          "is nearer than lower_bound_m - reach_m @ abs(dq).");
}

void bind_filter(py::module_& m) {
  bind_settings<VelocityFilterSettings>(
      m, "VelocityFilterSettings", "velocity_filter",
      "How near the robot may go to what is around it, and how soon it obeys.");
  py::class_<Filtered>(m, "FilteredVelocity", "What VelocityFilter gives.")
      .def_property_readonly(
          "status", [](const Filtered& self) { return self.of.status; },
          "FilterStatus: why the velocity is what it is")
      .def_property_readonly(
          "velocity",
          [](const Filtered& self) {
            return py::array_t<double>(std::ssize(self.of.velocity), self.of.velocity.data());
          },
          "numpy.ndarray: rad/s or m/s, one for each joint; 0 unless the status is ok")
      .def_property_readonly(
          "scale", [](const Filtered& self) { return self.of.scale; },
          "float: the share that the check without a model left of what was solved")
      .def_readonly("held_by", &Filtered::held_by,
                    "List[Tuple[str, RowKind]]: links and kinds of pairs without which the\n"
                    "velocity would be another one");
  py::class_<NamedFilter>(
      m, "VelocityFilter",
      "Turns the velocity that a program wants into the nearest one that keeps the links apart\n"
      "from all that cameras see and the model knows. Not a certified safety function. For one\n"
      "thread.")
      .def(py::init<const std::shared_ptr<Robot>&, const VelocityFilterSettings&>(),
           py::arg("robot"),
           py::arg_v("settings", VelocityFilterSettings{}, "VelocityFilterSettings()"))
      .def("update", &NamedFilter::update, py::arg("result"), py::arg("position"),
           py::arg("velocity"), py::arg("wanted"), py::arg("weight") = py::none(),
           "By name, or in the order of RobotModel.joint_names: the joints that the result is "
           "about\n"
           "(rad, m), how fast they move until they obey, the velocity that is wanted, and how "
           "much\n"
           "a difference from that counts, above 0; None: all alike.");
}

}  // namespace

void bind_control(py::module_& m) {
  bind_rows(m);
  bind_filter(m);
}

}  // namespace berth::python
