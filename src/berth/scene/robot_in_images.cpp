#include "berth/scene/robot_in_images.hpp"

#include <algorithm>
#include <cmath>

#include "berth/files/depth_units.hpp"

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth {
namespace {

std::vector<std::size_t> frames_to_look_at(const OpenCamera& camera, std::size_t most) {
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < camera.exposure_time.size(); ++k) {
    if (camera.exposure_time[k].status == TimeStatus::ok) known.push_back(k);
  }
  if (known.size() <= most) return known;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(known[i * (known.size() - 1) / (most - 1)]);
  return some;
}

void mirror(DepthImage& image) {
  for (int v = 0; v < image.height(); ++v) {
    float* row = image.row(v);
    std::reverse(row, row + image.width());
  }
}

void swap_bytes(const SceneCamera& camera, DepthImage& image) {
  for (float& z_m : image.pixels()) {
    if (std::isnan(z_m)) continue;
    const auto number = static_cast<std::uint16_t>(
        std::lround((z_m - camera.depth_offset_m) / camera.depth_scale_m));
    const auto swapped = static_cast<std::uint16_t>(number >> 8 | number << 8);
    z_m = depth_of(swapped, {camera.depth_scale_m, camera.depth_offset_m});
  }
}

/// From a distance to one along the axis.
void turn_to_axis(const Camera& camera, DepthImage& image) {
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      image(u, v) /= static_cast<float>(point_at(camera, u, v, 1).norm());
    }
  }
}

}  // namespace

RobotInImages::RobotInImages(const OpenScene& scene, std::size_t camera)
    : scene_(scene),
      camera_(camera),
      frames_(frames_to_look_at(scene.cameras[camera], kMostFrames)) {
  const OpenCamera& source = scene.cameras[camera];
  given_.images_of = camera;
  given_.mount = source.mounted->mount();
  for (const std::size_t k : frames_) given_.positions.push_back(source.at_exposure[k].position);
}

const DepthImage& RobotInImages::depth_m(std::size_t camera, std::size_t frame) {
  const auto [place, is_new] = depth_m_.try_emplace({camera, frame});
  const OpenCamera& from = scene_.cameras[camera];
  const Camera& size = this->camera().mounted->camera();
  const Camera& own = from.mounted->camera();
  const bool is_there = frame < from.source.depth.size() && own.width_px == size.width_px &&
                        own.height_px == size.height_px;
  if (is_new && is_there) {
    const SceneCamera& source = from.source;
    const bool has_limits = source.near_m > 0 || std::isfinite(source.far_m);
    place->second = has_limits ? from.read_all_depth(frame) : from.read_depth(frame);
  }
  return place->second;
}

RobotReadings RobotInImages::readings(const CameraBelief& belief) {
  RobotReadings sum;
  for (const RobotReadings& one : readings_of_links(belief)) sum += one;
  return sum;
}

RobotReadings RobotInImages::readings(const CameraBelief& belief, std::size_t i) {
  const MountedCamera mounted(scene_.robot, belief.mount);
  RobotRenderer renderer(scene_.robot->meshes(), belief.mount.camera);
  if (!believe(belief, mounted, renderer, i)) return {};
  return read_robot(changed_m_, robot_, camera().mounted->settings().watch.bias_m);
}

std::vector<RobotReadings> RobotInImages::readings_of_links(const CameraBelief& belief) {
  const MountedCamera mounted(scene_.robot, belief.mount);
  RobotRenderer renderer(scene_.robot->meshes(), belief.mount.camera);
  std::vector<RobotReadings> of_link(scene_.robot->model().evaluated_links.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (!believe(belief, mounted, renderer, i)) continue;
    read_links(changed_m_, robot_, camera().mounted->settings().watch.bias_m, of_link);
  }
  return of_link;
}

bool RobotInImages::believe(const CameraBelief& belief, const MountedCamera& mounted,
                            RobotRenderer& renderer, std::size_t i) {
  const DepthImage& read_m = depth_m(belief.images_of, frames_[i]);
  if (read_m.pixels().empty()) return false;
  changed_m_ = read_m;
  if (belief.is_swapped) swap_bytes(camera().source, changed_m_);
  for (float& z_m : changed_m_.pixels()) z_m *= static_cast<float>(belief.depth_factor);
  if (belief.is_along_ray) turn_to_axis(belief.mount.camera, changed_m_);
  if (belief.is_mirrored) mirror(changed_m_);
  forward_kinematics(scene_.robot->model(), belief.positions[i], pose_);
  renderer.render(pose_, mounted.camera_pose(pose_), robot_);
  return true;
}

}  // namespace berth
