#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "berth/distance/known_model.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "bindings.hpp"

namespace berth::python {
namespace {

std::vector<std::string> joint_names(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  return names;
}

std::vector<bool> moving_links(const RobotModel& model) {
  std::vector<bool> moving;
  for (const std::size_t link : model.evaluated_links) moving.push_back(model.is_moved(link));
  return moving;
}

GeometryKind geometry_of(const std::string& name) {
  if (name == "visual") return GeometryKind::visual;
  if (name == "collision") return GeometryKind::collision;
  throw std::invalid_argument(
      fmt::format("geometry: \"{}\"; expected one of visual, collision", name));
}

std::shared_ptr<RobotModel> load(
    const std::filesystem::path& urdf,
    const std::map<std::string, std::filesystem::path>& package_paths, const std::string& geometry,
    const std::vector<std::string>& environment_links, const std::vector<std::string>& ignore_links,
    const std::vector<std::string>& guarded_links, const std::optional<std::string>& urdf_text,
    const std::vector<std::array<std::string, 2>>& allowed_contacts,
    const std::optional<std::filesystem::path>& srdf, const std::vector<OtherRobot>& others) {
  const RobotSettings settings{urdf,
                               package_paths,
                               geometry_of(geometry),
                               environment_links,
                               ignore_links,
                               guarded_links,
                               urdf_text,
                               allowed_contacts,
                               srdf.value_or(std::filesystem::path()),
                               others};
  const py::gil_scoped_release release;
  return std::make_shared<RobotModel>(load_robot(settings));
}

py::dict link_poses(const RobotModel& model, const py::object& joints) {
  RobotPose pose;
  forward_kinematics(model, joints_of(model, joints, 0).position, pose);
  py::dict poses;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    poses[py::str(model.links[i].name)] = array_of(pose.X_BL[i]);
  }
  return poses;
}

std::shared_ptr<Robot> make_robot(const RobotModel& model, const EvaluationSettings& evaluation,
                                  const TimeSettings& time) {
  EvaluationSettings settings = evaluation;
  settings.time = time;
  const py::gil_scoped_release release;
  return std::make_shared<Robot>(model, settings);
}

/// A JointBuffer and the names in the order of a robot's joints.
class NamedJointBuffer {
 public:
  NamedJointBuffer(const RobotModel& model, std::size_t capacity)
      : buffer(model, capacity), model_(model) {}

  TimeStatus push(double stamp_s, const py::object& joints) {
    if (!py::isinstance<py::dict>(joints)) {
      return buffer.push(stamp_s, joint_names(model_), joints_of(model_, joints, stamp_s).position);
    }
    std::vector<std::string> names;
    std::vector<double> positions;
    for (const auto& [name, position] : py::reinterpret_borrow<py::dict>(joints)) {
      names.push_back(py::str(name));
      positions.push_back(joint_position_of(names.back(), position));
    }
    return buffer.push(stamp_s, names, positions);
  }

  JointBuffer buffer;

 private:
  RobotModel model_;
};

}  // namespace

const JointBuffer& buffer_of(const py::handle& joints) {
  return joints.cast<NamedJointBuffer&>().buffer;
}
bool is_buffer(const py::handle& joints) { return py::isinstance<NamedJointBuffer>(joints); }

void bind_robot(py::module_& m) {
  py::class_<RobotModel, std::shared_ptr<RobotModel>>(
      m, "RobotModel", "A robot as its URDF tells; frame B is its root link.")
      .def_readonly("name", &RobotModel::name, "str: the robot's name")
      .def_property_readonly("joint_names", &joint_names,
                             "List[str]: joints that a position is given for, in this order")
      .def_property_readonly("link_names", &RobotModel::evaluated_link_names,
                             "List[str]: links whose distances are asked for, in this order")
      .def_property_readonly("link_is_moved", &moving_links,
                             "List[bool]: whether a joint moves the link; of each of link_names")
      .def("link_poses", &link_poses, py::arg("joints"),
           "The pose X_BL of each link, 4 x 4, by name, with these joints (rad, m).")
      .def("__repr__", [](const RobotModel& model) {
        return fmt::format("RobotModel({}, {} links, {} joints)", model.name, model.link_count(),
                           model.joints.size());
      });
  py::class_<OtherRobot>(m, "OtherRobot",
                         "A robot with a URDF of its own beside the first one, for load_robot().")
      .def(
          py::init([](const std::filesystem::path& urdf, const std::string& prefix,
                      const std::string& parent, const py::object& X_PR,
                      const std::map<std::string, std::filesystem::path>& package_paths) {
            return OtherRobot{urdf, package_paths, prefix, parent, pose_of(X_PR, "X_PR")};
          }),
          py::arg("urdf"), py::arg("prefix"), py::arg("parent"), py::arg("X_PR"),
          py::arg("package_paths") = std::map<std::string, std::filesystem::path>{},
          "prefix stands before the names of its links and joints. X_PR (4 x 4) is the pose of its "
          "root\n"
          "link in the frame of `parent`, a link of the first robot or of one before it.");
  m.def("load_robot", &load, py::arg("urdf"),
        py::arg("package_paths") = std::map<std::string, std::filesystem::path>{},
        py::arg("geometry") = "visual", py::arg("environment_links") = std::vector<std::string>{},
        py::arg("ignore_links") = std::vector<std::string>{},
        py::arg("guarded_links") = std::vector<std::string>{}, py::arg("urdf_text") = std::nullopt,
        py::arg("allowed_contacts") = std::vector<std::array<std::string, 2>>{},
        py::arg("srdf") = std::nullopt, py::arg("others") = std::vector<OtherRobot>{},
        "Loads a URDF and its meshes. Links in environment_links are environment: filtered out of "
        "the\n"
        "images, not evaluated. Nobody can be in the boxes of guarded_links. geometry: visual or "
        "collision.\n"
        "allowed_contacts are pairs of links that may touch, srdf names more; others are robots "
        "beside it.\n"
        "Raises FileNotFoundError or "
        "ValueError that names file, place, value and what was expected.");
  py::class_<Robot, std::shared_ptr<Robot>>(
      m, "Robot", "A robot, and how requests about it are answered. Constant; share it.")
      .def(py::init(&make_robot), py::arg("model"),
           py::arg_v("evaluation", EvaluationSettings{}, "EvaluationSettings()"),
           py::arg_v("time", TimeSettings{}, "TimeSettings()"))
      .def_property_readonly(
          "left_out",
          [](const Robot& robot) {
            std::vector<std::tuple<std::string, std::string, std::string>> pairs;
            const auto name = [&](std::size_t link) { return robot.model().links[link].name; };
            for (const LeftOutPair& pair : robot.known().left_out) {
              pairs.emplace_back(name(pair.link), name(pair.other), name_of(pair.reason));
            }
            return pairs;
          },
          "List[Tuple[str, str, str]]: pairs of links whose distance is not looked for, and why: "
          "fixed, neighbours, always_touch, srdf or allowed")
      .def_property_readonly("model", &Robot::model, py::return_value_policy::reference_internal,
                             "RobotModel: its links and joints")
      .def_property_readonly("evaluation", &Robot::settings,
                             "EvaluationSettings: how distances are looked for")
      .def_property_readonly(
          "time", [](const Robot& robot) { return robot.settings().time; },
          "TimeSettings: how old is too old");
  py::class_<NamedJointBuffer>(m, "JointBuffer",
                               "The newest joint samples of a running robot. One thread may push\n"
                               "while others ask.")
      .def(py::init<const RobotModel&, std::size_t>(), py::arg("model"), py::arg("capacity") = 500)
      .def("push", &NamedJointBuffer::push, py::arg("stamp_s"), py::arg("joints"),
           "Adds a sample: positions by name (others are passed over) or in the robot's order.\n"
           "What is not ok is not kept.")
      .def(
          "clear", [](NamedJointBuffer& joints) { joints.buffer.clear(); },
          "Forgets all: for a clock that was set back.")
      .def_property_readonly(
          "newest_stamp_s",
          [](const NamedJointBuffer& joints) { return joints.buffer.newest_stamp_s(); },
          "float: NaN where there is no sample");
}

}  // namespace berth::python
