#include "berth/record/recorded_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "berth/files/error.hpp"
#include "berth/record/exact_json.hpp"
#include "berth/robot/plausible_size.hpp"

namespace berth {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kVertexBytes = 3 * sizeof(float);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::uint32_t);

std::string header_of(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
      "y\nproperty float z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      vertices, faces);
}

/// The number after `word` in the header.
std::size_t count_after(std::string_view header, std::string_view word) {
  const std::size_t at = header.find(word);
  std::size_t count = 0;
  for (std::size_t i = at + word.size(); at != std::string_view::npos && i < header.size(); ++i) {
    if (header[i] < '0' || header[i] > '9' || count > std::size_t{1} << 32) break;
    count = 10 * count + static_cast<std::size_t>(header[i] - '0');
  }
  return count;
}

template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

}  // namespace

std::string ply_of(const TriangleMesh& mesh) {
  std::string out = header_of(mesh.vertices_m.size(), mesh.triangles.size());
  const auto append = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) {
    for (int k = 0; k < 3; ++k) append(vertex_m[k]);
  }
  for (const auto& triangle : mesh.triangles) {
    out.push_back(3);
    for (const std::uint32_t corner : triangle) append(corner);
  }
  return out;
}

TriangleMesh mesh_of_ply(std::string_view bytes) {
  const std::string_view header = bytes.substr(0, bytes.find("end_header"));
  const std::size_t vertices = count_after(header, "element vertex ");
  const std::size_t faces = count_after(header, "element face ");
  const std::string expected = header_of(vertices, faces);
  const std::size_t size = expected.size() + vertices * kVertexBytes + faces * kFaceBytes;
  if (!bytes.starts_with(expected) || bytes.size() != size) {
    throw std::runtime_error("no mesh that berth wrote; expected a PLY file of its triangles");
  }
  bytes.remove_prefix(expected.size());
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    Eigen::Vector3f& vertex_m = mesh.vertices_m.emplace_back();
    for (int k = 0; k < 3; ++k) vertex_m[k] = take<float>(bytes);
    if (!vertex_m.allFinite()) {
      throw std::runtime_error(fmt::format("vertex {} is not finite; expected numbers", i));
    }
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const auto corners = take<std::uint8_t>(bytes);
    auto& triangle = mesh.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) corner = take<std::uint32_t>(bytes);
    if (corners == 3 && *std::ranges::max_element(triangle) < vertices) continue;
    throw std::runtime_error(
        fmt::format("face {}: expected 3 corners, each one of {} vertices", i, vertices));
  }
  return mesh;
}

namespace {

constexpr std::array<std::string_view, 4> kJointTypes = {"fixed", "revolute", "continuous",
                                                         "prismatic"};
constexpr std::array<std::string_view, 3> kLinkRoles = {"evaluated", "environment", "ignored"};
constexpr std::string_view name_of(JointType type) {
  return kJointTypes[static_cast<std::size_t>(type)];
}
constexpr std::string_view name_of(LinkRole role) {
  return kLinkRoles[static_cast<std::size_t>(role)];
}
template <class Enum>
Enum one_of(const Json& value, const auto& names) {
  const auto found = std::ranges::find(names, value.get_ref<const std::string&>());
  if (found != names.end()) return static_cast<Enum>(found - names.begin());
  throw std::runtime_error(fmt::format("{}; expected a name that is known", value.dump()));
}

/// Attaches the mesh, and reports under which name; null for one without triangles.
Json append_mesh(const TriangleMesh& mesh, const std::string& of,
                 std::vector<mcap::Attachment>& out) {
  if (mesh.empty()) return Json();
  out.push_back({fmt::format("meshes/{}_{}.ply", out.size(), of), "model/ply", ply_of(mesh)});
  return out.back().name;
}

TriangleMesh read_mesh(const mcap::FileReader& file, const Json& name) {
  if (name.is_null()) return {};
  const auto& text = name.get_ref<const std::string&>();
  try {
    return mesh_of_ply(file.attachment(text).data);
  } catch (const BadFile&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", text, error.what()));
  }
}

Json json_of(const Link& link, std::vector<mcap::Attachment>& out) {
  const Joint& joint = link.joint;
  return {{"name", link.name},
          {"parent", link.parent ? Json(*link.parent) : Json()},
          {"joint",
           {{"name", joint.name},
            {"type", name_of(joint.type)},
            {"X_PJ", exact(joint.X_PJ)},
            {"axis_J", exact(std::span<const double>(joint.axis_J.data(), 3))},
            {"position_index", joint.position_index ? Json(*joint.position_index) : Json()},
            {"multiplier", exact(joint.multiplier)},
            {"offset", exact(joint.offset)}}},
          {"role", name_of(link.role)},
          {"mesh", append_mesh(link.mesh_L, link.name, out)}};
}

std::optional<std::size_t> index_below(const Json& value, std::size_t count, const char* what) {
  if (value.is_null()) return std::nullopt;
  const auto index = value.get<std::size_t>();
  if (index < count) return index;
  throw std::runtime_error(fmt::format("{}: {}; expected less than {}", what, index, count));
}

Joint joint_of(const Json& json, std::size_t positions) {
  Joint joint;
  joint.name = json.at("name").get<std::string>();
  joint.type = one_of<JointType>(json.at("type"), kJointTypes);
  joint.X_PJ = pose_of(json.at("X_PJ"));
  const std::vector<double> axis = numbers_of(json.at("axis_J"));
  if (axis.size() != 3) throw std::runtime_error("axis_J; expected 3 numbers");
  joint.axis_J = Eigen::Vector3d(axis[0], axis[1], axis[2]);
  joint.position_index = index_below(json.at("position_index"), positions, "position_index");
  joint.multiplier = number_of(json.at("multiplier"));
  joint.offset = number_of(json.at("offset"));
  return joint;
}

void append_link(const mcap::FileReader& file, const Json& json, RobotModel& model) {
  Link link;
  link.name = json.at("name").get<std::string>();
  link.parent = index_below(json.at("parent"), model.links.size(), "parent");
  link.joint = joint_of(json.at("joint"), model.joints.size());
  link.role = one_of<LinkRole>(json.at("role"), kLinkRoles);
  link.mesh_L = read_mesh(file, json.at("mesh"));
  if (link.role == LinkRole::environment) link.id = kEnvironmentLink;
  if (link.role == LinkRole::evaluated) {
    model.evaluated_links.push_back(model.links.size());
    link.id = static_cast<LinkId>(model.evaluated_links.size());
  }
  model.links.push_back(std::move(link));
}

RobotModel model_of(const mcap::FileReader& file, const Json& json) {
  RobotModel model;
  model.name = json.at("name").get<std::string>();
  for (const Json& joint : json.at("joints")) {
    model.joints.push_back({joint.at("name").get<std::string>(),
                            one_of<JointType>(joint.at("type"), kJointTypes),
                            number_of(joint.at("lower")), number_of(joint.at("upper"))});
  }
  model.mimic_joints = json.at("mimic_joints").get<std::vector<std::string>>();
  for (const Json& link : json.at("links")) append_link(file, link, model);
  if (model.evaluated_links.empty()) throw std::runtime_error("no link; expected one at least");
  for (const Json& pair : json.value("allowed_contacts", Json::array())) {
    model.allowed_contacts.push_back(
        {pair.at(0).get<std::string>(), pair.at(1).get<std::string>()});
  }
  return model;
}

std::vector<Attachment> attached_of(const mcap::FileReader& file, const Json& json) {
  std::vector<Attachment> all;
  for (const Json& one : json) {
    all.push_back({one.at("name").get<std::string>(), one.at("link").get<std::string>(),
                   read_mesh(file, one.at("mesh")), pose_of(one.at("X_LA")),
                   one.at("is_link").get<bool>(), one.at("is_sharp").get<bool>(),
                   one.value("is_soft", false),
                   one.value("may_touch", std::vector<std::string>())});
  }
  return all;
}

}  // namespace

void append_robot(const Robot& robot, std::vector<mcap::Attachment>& out) {
  const RobotModel& model = robot.bare();
  Json joints = Json::array(), links = Json::array(), attached = Json::array();
  Json contacts = Json::array();
  for (const MovableJoint& joint : model.joints) {
    joints.push_back({{"name", joint.name},
                      {"type", name_of(joint.type)},
                      {"lower", exact(joint.lower)},
                      {"upper", exact(joint.upper)}});
  }
  for (const Link& link : model.links) links.push_back(json_of(link, out));
  for (const AllowedContact& one : model.allowed_contacts) {
    contacts.push_back({one.link, one.other});
  }
  for (const Attachment& one : robot.attached()) {
    attached.push_back({{"name", one.name},
                        {"link", one.link},
                        {"X_LA", exact(one.X_LA)},
                        {"is_link", one.is_link},
                        {"is_sharp", one.is_sharp},
                        {"is_soft", one.is_soft},
                        {"may_touch", one.may_touch},
                        {"mesh", append_mesh(one.mesh_A, one.name, out)}});
  }
  const Json json = {{"name", model.name},
                     {"joints", joints},
                     {"mimic_joints", model.mimic_joints},
                     {"links", links},
                     {"allowed_contacts", contacts},
                     {"attached", attached}};
  out.push_back({std::string(kRobotFile), "application/json", json.dump(1)});
}

std::shared_ptr<const Robot> read_robot(const mcap::FileReader& file,
                                        const EvaluationSettings& settings) {
  const Json json = Json::parse(file.attachment(kRobotFile).data);
  RobotModel model = model_of(file, json);
  require_plausible_size(kRobotFile, model);
  return std::make_shared<const Robot>(std::move(model), settings,
                                       attached_of(file, json.at("attached")));
}

}  // namespace berth
