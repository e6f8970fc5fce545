#include "lab/watch/mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace berth::lab {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

void keep_images(OpenCamera& camera) {
  for (std::size_t k = 0; k < camera.kept_depth_m.size(); ++k) {
    camera.kept_depth_m[k] = std::make_shared<const DepthImage>(camera.read_depth(k));
  }
}

template <class Change>
auto each_image(Change change) {
  return [change](OpenScene& scene, std::size_t c) {
    OpenCamera& camera = scene.cameras[c];
    for (std::size_t k = 0; k < camera.kept_depth_m.size(); ++k) {
      DepthImage image = camera.read_depth(k);
      change(image);
      camera.kept_depth_m[k] = std::make_shared<const DepthImage>(std::move(image));
    }
  };
}

template <class Change>
auto each_reading(Change change) {
  return each_image([change](DepthImage& image) {
    for (float& z_m : image.pixels()) z_m = change(z_m);
  });
}

auto scaled_depth(float factor) {
  return [factor](OpenScene& scene, std::size_t c) {
    // The images first: they are read by the scale that the scene has.
    each_reading([factor](float z_m) { return factor * z_m; })(scene, c);
    scene.cameras[c].source.depth_scale_m *= factor;
  };
}

template <class Change>
auto other_mount(Change change) {
  return [change](OpenScene& scene, std::size_t c) {
    CameraMount mount = scene.cameras[c].mounted->mount();
    change(mount);
    set_mount(scene, scene.cameras[c], mount);
  };
}

template <class Change>
auto other_rotation(Change change) {
  return other_mount([change](CameraMount& mount) {
    const Eigen::Quaterniond right(mount.X_PC.linear());
    mount.X_PC.linear() = change(right).normalized().toRotationMatrix();
  });
}

/// Of the joints, whichever camera looks.
template <class Change>
auto each_position(Change change) {
  return [change](OpenScene& scene, std::size_t) {
    for (OpenCamera& camera : scene.cameras) {
      for (JointState& joints : camera.at_exposure) change(joints.position);
    }
  };
}

void rpy_in_degrees(OpenScene& scene, std::size_t c) {
  OpenCamera& camera = scene.cameras[c];
  CameraMount mount = camera.mounted->mount();
  // yaw, pitch, roll.
  const Eigen::Vector3d ypr = mount.X_PC.linear().eulerAngles(2, 1, 0) / kDegree_rad;
  camera.source.rpy_rad = Eigen::Vector3d(ypr.z(), ypr.y(), ypr.x());
  mount.X_PC.linear() = (Eigen::AngleAxisd(ypr.x(), Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(ypr.y(), Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(ypr.z(), Eigen::Vector3d::UnitX()))
                            .toRotationMatrix();
  set_mount(scene, camera, mount);
}

auto shifted_joints(int shift) {
  return [shift](OpenScene& scene, std::size_t c) {
    std::vector<JointState>& joints = scene.cameras[c].at_exposure;
    const std::vector<JointState> right = joints;
    const int last = static_cast<int>(joints.size()) - 1;
    for (int k = 0; k <= last; ++k) {
      joints[k].position = right[std::clamp(k + shift, 0, last)].position;
    }
  };
}

/// As if another camera of the same kind had taken the images.
void swap_poses(OpenScene& scene, std::size_t c) {
  OpenCamera& other = scene.cameras[c == 0 ? 1 : 0];
  CameraMount one = scene.cameras[c].mounted->mount(), two = other.mounted->mount();
  std::swap(one.X_PC, two.X_PC);
  set_mount(scene, scene.cameras[c], one);
  set_mount(scene, other, two);
}

void freeze(OpenScene& scene, std::size_t c) {
  keep_images(scene.cameras[c]);
  auto& images = scene.cameras[c].kept_depth_m;
  std::fill(images.begin() + 1, images.end(), images.front());
}

using Mistakes = std::vector<MadeMistake>;

void add_depths(const OpenScene& scene, Mistakes& all) {
  const std::string right =
      fmt::format("depth_scale is {:.6g}", scene.cameras.front().source.depth_scale_m);
  all.push_back({"`depth_scale` 0.01", right, scaled_depth(10)});
  all.push_back({"`depth_scale` 0.0001", right, scaled_depth(0.1F)});
  all.push_back({"millimetres in a float image", right, scaled_depth(1000)});
}

void add_cameras(Mistakes& all) {
  for (const double factor : {0.5, 0.65, 0.8, 1.25, 1.3, 1.5, 2.0}) {
    all.push_back({fmt::format("focal length times {}", factor), "focal length",
                   other_mount([factor](CameraMount& mount) {
                     mount.camera.fx_px *= factor;
                     mount.camera.fy_px *= factor;
                   })});
  }
  for (const double factor : {0.8, 0.88, 1.12, 1.25}) {
    const bool is_slight = factor == 0.88 || factor == 1.12;
    all.push_back({fmt::format("`fx` alone times {}", factor), "fx is",
                   other_mount([factor](CameraMount& mount) { mount.camera.fx_px *= factor; }),
                   is_slight});
    all.push_back({fmt::format("`fy` alone times {}", factor), "fy is",
                   other_mount([factor](CameraMount& mount) { mount.camera.fy_px *= factor; }),
                   is_slight});
  }
  all.push_back({"depth along the ray", "along the ray", [](OpenScene& scene, std::size_t c) {
                   const Camera& camera = scene.cameras[c].mounted->camera();
                   each_image([&](DepthImage& image) {
                     for (int v = 0; v < image.height(); ++v) {
                       for (int u = 0; u < image.width(); ++u) {
                         image(u, v) *= static_cast<float>(point_at(camera, u, v, 1).norm());
                       }
                     }
                   })(scene, c);
                 }});
}

void add_poses(Mistakes& all) {
  using Q = Eigen::Quaterniond;
  const Q body_optical((Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished());
  all.push_back({"`xyz` in millimetres", "millimetres",
                 other_mount([](CameraMount& mount) { mount.X_PC.translation() *= 1000; })});
  all.push_back({"`rpy` in degrees", "rpy is in degrees", rpy_in_degrees});
  all.push_back({"pose mirrored in y", "mirrored in y", other_mount([](CameraMount& mount) {
                   const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
                   mount.X_PC.linear() = mirror * mount.X_PC.linear() * mirror;
                   mount.X_PC.translation().y() *= -1;
                 })});
  all.push_back({"`y` with the wrong sign", "pose's y",
                 other_mount([](CameraMount& mount) { mount.X_PC.translation().y() *= -1; })});
  all.push_back({"base turned by 180 degrees", "180 degrees", other_mount([](CameraMount& mount) {
                   mount.X_PC =
                       Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()) * mount.X_PC;
                 })});
  all.push_back({"pose the other way round", "in the camera's frame",
                 other_mount([](CameraMount& mount) { mount.X_PC = mount.X_PC.inverse(); })});
  all.push_back({"quaternion conjugated", "rotation is inverted",
                 other_rotation([](const Q& q) { return q.conjugate(); })});
  all.push_back({"quaternion w, x, y, z", "w, x, y, z",
                 other_rotation([](const Q& q) { return Q(q.z(), q.w(), q.x(), q.y()); })});
  all.push_back({"pose of a frame with x forward", "x forward",
                 other_rotation([=](const Q& q) { return q * body_optical.conjugate(); })});
}

void add_images(const OpenScene& scene, Mistakes& all) {
  all.push_back({"images mirrored", "images are mirrored", each_image([](DepthImage& image) {
                   for (int v = 0; v < image.height(); ++v) {
                     std::reverse(image.row(v), image.row(v) + image.width());
                   }
                 })});
  if (scene.cameras.size() > 1) {
    all.push_back({"another camera's images", "of camera", swap_poses});
  }
  all.push_back(
      {"dead camera: one depth", "are the same", each_reading([](float) { return 1.5F; })});
  all.push_back({"dead camera: one image", "do not change", freeze});
  all.push_back(
      {"dead camera: no reading", "has a reading", each_reading([](float) { return kNoDepth; })});
}

void add_joints(const OpenScene& scene, Mistakes& all) {
  const auto& joints = scene.robot->model().joints;
  const auto degrees = [types = &joints](std::vector<double>& position) {
    for (std::size_t j = 0; j < position.size(); ++j) {
      if ((*types)[j].type != JointType::prismatic) position[j] /= kDegree_rad;
    }
  };
  all.push_back({"joints in degrees", "joints are in degrees", each_position(degrees)});
  all.push_back({"joints 2 and 3 swapped", fmt::format("{} and {}", joints[1].name, joints[2].name),
                 each_position([](auto& position) { std::swap(position[1], position[2]); })});
  all.push_back({"joints in reverse order", "order is reversed",
                 each_position([](auto& position) { std::ranges::reverse(position); })});
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].type == JointType::prismatic) continue;
    all.push_back({fmt::format("joint {} in degrees", j + 1), joints[j].name,
                   each_position([j](auto& position) { position[j] /= kDegree_rad; }),
                   j + 1 == joints.size()});
    all.push_back({fmt::format("joint {} with the other sign", j + 1), joints[j].name,
                   each_position([j](auto& position) { position[j] *= -1; }),
                   j + 3 >= joints.size()});
  }
  all.push_back({"joints of the image before", "one image later", shifted_joints(-1), true});
}

}  // namespace

std::vector<MadeMistake> mistakes_in(const OpenScene& scene) {
  Mistakes all;
  add_depths(scene, all);
  add_cameras(all);
  add_poses(all);
  add_joints(scene, all);
  add_images(scene, all);
  return all;
}

void set_mount(const OpenScene& scene, OpenCamera& camera, const CameraMount& mount) {
  camera.mounted =
      std::make_shared<const MountedCamera>(scene.robot, mount, camera.mounted->settings());
}

}  // namespace berth::lab
