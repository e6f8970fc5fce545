#include "sim/drawn_hand_camera.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "sim/drawn_camera.hpp"
#include "sim/drawn_obstacles.hpp"

namespace berth::sim {
namespace {

constexpr int kMostHandPlaces = 60;
/// Of the images, to look at quickly.
constexpr int kLook_px = 64;
constexpr double kLeastMovingShare = 0.02;
constexpr double kMostSeenShare = 0.5;
constexpr float kNearest_m = 0.08F;
/// The least share of the poses.
constexpr double kLeastPosesShare = 0.6;

bool is_turned_by_itself(const Joint& joint) {
  const bool turns = joint.type == JointType::revolute || joint.type == JointType::continuous;
  return turns && joint.position_index && joint.multiplier == 1 && joint.offset == 0;
}

/// Indices of the links that a joint turns, from the root to this one.
std::vector<std::size_t> turned_links(const RobotModel& model, std::size_t link) {
  std::vector<std::size_t> chain;
  for (std::optional<std::size_t> i = link; i && model.links[*i].parent;
       i = model.links[*i].parent) {
    if (is_turned_by_itself(model.links[*i].joint)) chain.push_back(*i);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

/// Of each link: whether no joint lies between it and the camera's.
std::vector<bool> carried_along(const RobotModel& model, std::size_t parent) {
  std::vector<std::size_t> part(model.links.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool is_fixed = model.links[i].parent && model.links[i].joint.type == JointType::fixed;
    part[i] = is_fixed ? part[*model.links[i].parent] : i;
  }
  std::vector<bool> carried;
  for (const std::size_t one : part) carried.push_back(one == part[parent]);
  return carried;
}

Eigen::Vector3d draw_surface_point_L(Random& random, const Link& link) {
  const auto& vertices_m = link.mesh_L.vertices_m;
  return vertices_m[random.whole(0, static_cast<int>(vertices_m.size()) - 1)].cast<double>();
}

/// Beside the link's own surface, towards a point of a link that is not carried along.
Pose draw_pose(Random& random, const RobotModel& model, const RobotPose& pose, std::size_t parent,
               const std::vector<bool>& carried) {
  std::size_t other = 0;
  do {
    other = model.evaluated_links[random.whole(0, model.link_count() - 1)];
  } while (carried[other]);
  const Eigen::Vector3d target_B_m =
      pose.X_BL[other] * draw_surface_point_L(random, model.links[other]);
  Pose X_BC;
  const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
  X_BC.translation() = pose.X_BL[parent] * Eigen::Vector3d(random(0.08, 0.25) * direction);
  const Eigen::Vector3d z = (target_B_m - X_BC.translation()).normalized();
  const Eigen::Vector3d x = z.cross(draw_rotation(random) * Eigen::Vector3d::UnitX()).normalized();
  X_BC.linear() << x, z.cross(x), z;
  return X_BC;
}

struct Look {
  double moving_share = 0;
  double most_share = 0;
  float nearest_m = kNoDepth;
};

Look look_at(const RobotModel& model, const RobotPose& pose, const std::vector<bool>& carried,
             const Pose& X_BC, const Camera& camera) {
  const double step = static_cast<double>(camera.width_px) / kLook_px;
  const Camera small{kLook_px,
                     static_cast<int>(camera.height_px / step),
                     camera.fx_px / step,
                     camera.fy_px / step,
                     camera.cx_px / step,
                     camera.cy_px / step};
  const RobotImage image = cast_image(EmbreeRenderer(model, pose, X_BC, small), small);
  Look look;
  std::vector<double> count(model.evaluated_links.size() + 1, 0.0);
  const double pixels = static_cast<double>(image.link_id.pixels().size());
  for (std::size_t i = 0; i < image.link_id.pixels().size(); ++i) {
    const LinkId id = image.link_id.pixels()[i];
    if (id == kNoLink || id == kEnvironmentLink) continue;
    look.nearest_m = std::fmin(look.nearest_m, image.depth_m.pixels()[i]);
    if (!carried[model.evaluated_links[id - 1]]) look.moving_share += 1 / pixels;
    count[id] += 1 / pixels;
  }
  look.most_share = *std::max_element(count.begin(), count.end());
  return look;
}

}  // namespace

std::size_t mount_link(const RobotModel& model, DrawnMount mount) {
  if (mount == DrawnMount::root) return 0;
  std::vector<std::size_t> longest;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const std::vector<std::size_t> chain = turned_links(model, i);
    if (chain.size() > longest.size()) longest = chain;
  }
  if (longest.empty()) throw std::runtime_error("no joint turns a link of robot " + model.name);
  return mount == DrawnMount::hand ? longest.back() : longest[longest.size() / 2];
}

bool place_hand_camera(Random& random, const RobotModel& model, const std::vector<RobotPose>& poses,
                       DrawnMount mount, int width_px, int height_px, CalibrationCamera& camera) {
  camera.parent = mount_link(model, mount);
  const std::vector<bool> carried = carried_along(model, camera.parent);
  for (int i = 0; i < kMostHandPlaces; ++i) {
    camera.camera = draw_camera(random, width_px, height_px);
    camera.X_PC = poses[0].X_BL[camera.parent].inverse() *
                  draw_pose(random, model, poses[0], camera.parent, carried);
    std::size_t seen = 0;
    const bool is_clear = std::all_of(poses.begin(), poses.end(), [&](const RobotPose& pose) {
      const Look look =
          look_at(model, pose, carried, pose.X_BL[camera.parent] * camera.X_PC, camera.camera);
      seen += look.moving_share > kLeastMovingShare;
      return look.most_share < kMostSeenShare && !(look.nearest_m < kNearest_m);
    });
    if (is_clear &&
        static_cast<double>(seen) >= kLeastPosesShare * static_cast<double>(poses.size())) {
      return true;
    }
  }
  return false;
}

}  // namespace berth::sim
