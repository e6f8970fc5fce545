#include "lab/closed_loop/sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/moving_arm.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/mesh_distance.hpp"
#include "sim/moving_ray_caster.hpp"
#include "sim/visit.hpp"

namespace berth::lab {
namespace {

constexpr double kStep_s = 0.001;
constexpr int kThings = 4;
/// A link that is told nearer than this is told to touch.
constexpr double kTouching_m = 0.001;
/// From here on there is no contact.
constexpr double kFree_m = 0.05;
/// A greater excess is counted as too large.
constexpr double kTooLarge_m = 0.02;

/// Things around the arm, where it does not reach them.
void add_things(std::uint32_t seed, std::vector<TriangleMesh>& meshes, std::vector<Pose>& X_BP) {
  sim::Random random(seed);
  for (int i = 0; i < kThings; ++i) {
    meshes.push_back(sim::draw_obstacle(random, random(0.08, 0.2)));
    const double angle = random(0, 2 * std::numbers::pi), range_m = random(0.9, 1.3);
    Pose X_BO = Pose::Identity();
    X_BO.translation() =
        Eigen::Vector3d(range_m * std::cos(angle), range_m * std::sin(angle), random(0, 0.6));
    X_BO.linear() = sim::draw_rotation(random).toRotationMatrix();
    X_BP.push_back(X_BO);
  }
}

/// Arm, cell, people and things, as they move.
class World {
 public:
  World(std::uint32_t seed, const std::vector<CellCamera>& cameras)
      : cameras_(cameras),
        model_(cell_model()),
        visit_(sim::VisitKind::reaching, seed),
        arm_(model_, visit_.first_phase()),
        meshes_(visit_.meshes()),
        rays_(all_meshes(seed)) {
    for (const TriangleMesh& mesh : meshes_) trees_.push_back(sim::build_mesh_tree(mesh));
    for (const std::size_t link : model_.evaluated_links) {
      if (model_.is_moved(link))
        moved_.push_back({link, sim::build_mesh_tree(model_.links[link].mesh_L)});
    }
  }

  const RobotModel& model() const { return model_; }
  const std::vector<double>& position_rad() const { return arm_.position_rad(); }
  double duration_s() const { return visit_.duration_s(); }
  void step(double time_s) {
    arm_.step(1, kStep_s);
    X_BP_ = visit_.pose_at(time_s);
    X_BP_.insert(X_BP_.end(), X_BO_.begin(), X_BO_.end());
  }

  /// A camera's ideal image.
  DepthImage look(std::size_t camera) { return cast(camera, X_BP_); }

  /// What it shows of what is in no model.
  DepthImage obstacles_m(std::size_t camera) {
    DepthImage image_m = look(camera);
    const DepthImage modelled_m = cast(camera, sim::nowhere(meshes_.size()));
    auto& pixels = image_m.pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (pixels[i] == modelled_m.pixels()[i]) pixels[i] = kNoDepth;
    }
    return image_m;
  }

  /// Of each link that a joint moves, the nearest points of it and of what is in no model.
  std::vector<sim::SurfacePair> nearest(double range_m) const {
    std::vector<sim::SurfacePair> pairs;
    for (const auto& [link, tree] : moved_) {
      sim::SurfacePair nearest{.distance_m = range_m};
      for (std::size_t i = 0; i < trees_.size(); ++i) {
        const sim::SurfacePair pair = sim::closest_points(tree, arm_.pose().X_BL[link], trees_[i],
                                                          X_BP_[i], nearest.distance_m);
        if (pair.distance_m < nearest.distance_m) nearest = pair;
      }
      pairs.push_back(nearest);
    }
    return pairs;
  }

  /// How the first `cameras` see a point that is not finite where nothing is in range.
  sim::ObstacleSight sight(const Eigen::Vector3d& p_B, const std::vector<DepthImage>& obstacles_m,
                           int cameras) const {
    sim::ObstacleSight best = sim::ObstacleSight::outside;
    for (std::size_t k = 0; k < static_cast<std::size_t>(cameras) && p_B.allFinite(); ++k) {
      const Eigen::Vector3d p_C = cameras_[k].X_BC.inverse() * p_B;
      best = std::min(best, sim::sight_of(p_C, cameras_[k].camera, obstacles_m[k]));
    }
    return best;
  }

 private:
  DepthImage cast(std::size_t camera, const std::vector<Pose>& X_BP) {
    return rays_.cast(cameras_[camera].camera, cameras_[camera].X_BC, all_poses(X_BP));
  }

  std::vector<TriangleMesh> all_meshes(std::uint32_t seed) {
    add_things(seed, meshes_, X_BO_);
    std::vector<TriangleMesh> all;
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (model_.links[i].mesh_L.empty()) continue;
      drawn_links_.push_back(i);
      all.push_back(model_.links[i].mesh_L);
    }
    all.insert(all.end(), meshes_.begin(), meshes_.end());
    return all;
  }

  std::vector<Pose> all_poses(const std::vector<Pose>& X_BP) const {
    std::vector<Pose> all;
    for (const std::size_t link : drawn_links_) all.push_back(arm_.pose().X_BL[link]);
    all.insert(all.end(), X_BP.begin(), X_BP.end());
    return all;
  }

  struct MovedLink {
    std::size_t link;
    sim::MeshTree tree;
  };
  const std::vector<CellCamera>& cameras_;
  const RobotModel& model_;
  sim::Visit visit_;
  MovingArm arm_;
  /// People's parts, then things.
  std::vector<TriangleMesh> meshes_;
  std::vector<Pose> X_BO_;
  std::vector<Pose> X_BP_;
  std::vector<std::size_t> drawn_links_;
  sim::MovingRayCaster rays_;
  std::vector<sim::MeshTree> trees_;
  std::vector<MovedLink> moved_;
};

/// berth under one condition.
class Judged {
 public:
  Judged(const std::shared_ptr<const Robot>& robot, const std::vector<CellCamera>& cameras,
         const SequenceCondition& condition, std::uint32_t seed)
      : condition_(condition), query_(robot), seed_(seed) {
    CameraSettings settings = settings_of_real_camera();
    settings.space = condition.space;
    const std::string& root = robot->model().links.front().name;
    for (int k = 0; k < condition.cameras; ++k) {
      const CellCamera& c = cameras[static_cast<std::size_t>(k)];
      observers_.emplace_back(std::make_shared<const MountedCamera>(
          robot, CameraMount{c.camera, root, c.X_BC, c.name}, settings));
    }
    frames_.resize(observers_.size());
  }

  void see(std::size_t camera, DepthImage depth_m, double stamp_s, const JointBuffer& joints) {
    if (camera >= observers_.size()) return;
    sim::add_errors(condition_.image, ++seed_, depth_m);
    auto frame = std::make_shared<Frame>();
    observers_[camera].observe(depth_m, stamp_s, joints, *frame);
    frames_[camera] = std::move(frame);
  }

  void tell(SequenceInstant& instant) {
    std::size_t i = 0;
    for (const LinkResult& link : query_.ask({.frames = frames_}).links) {
      if (!link.is_moved) continue;
      if (link.is_known()) instant[i].told_m = link.distance_m;
      if (link.occupied.is_known()) instant[i].occupied_m = link.occupied.distance_m;
      ++i;
    }
  }

 private:
  const SequenceCondition& condition_;
  Query query_;
  std::uint32_t seed_;
  std::vector<Observer> observers_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

/// Everything that happens in one encounter.
class Sequence {
 public:
  Sequence(std::uint32_t seed, const std::vector<SequenceCondition>& conditions,
           const SequenceSettings& settings)
      : conditions_(conditions),
        settings_(settings),
        cameras_(cell_cameras()),
        world_(seed, cameras_),
        robot_(std::make_shared<const Robot>(world_.model(), EvaluationSettings{})),
        joints_(world_.model(), 500),
        instants_(conditions.size()) {
    for (const MovableJoint& joint : world_.model().joints) names_.push_back(joint.name);
    for (const SequenceCondition& condition : conditions_) {
      judged_.push_back(std::make_unique<Judged>(robot_, cameras_, condition, seed << 12U));
    }
    // The first one is the last to expose.
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      next_s_.push_back((2 - static_cast<double>(k) / 3) / settings_.image_hz);
    }
  }

  std::vector<std::vector<SequenceInstant>> run() {
    double due_s = settings_.every_s;
    for (int i = 0; i * kStep_s < world_.duration_s(); ++i) {
      const double time_s = i * kStep_s;
      world_.step(time_s);
      joints_.push(time_s, names_, world_.position_rad());
      // Earlier images are not asked.
      const bool is_near = time_s > due_s - 1 / settings_.image_hz;
      const bool has_image = expose(time_s, is_near);
      if (!has_image || time_s < due_s) continue;
      due_s += settings_.every_s;
      judge();
    }
    return std::move(instants_);
  }

 private:
  /// Whether the first camera has exposed.
  bool expose(double time_s, bool is_asked) {
    bool has_image = false;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      if (time_s < next_s_[k]) continue;
      next_s_[k] += 1 / settings_.image_hz;
      has_image |= k == 0;
      if (!is_asked) continue;
      const DepthImage depth_m = world_.look(k);
      for (const auto& judged : judged_) judged->see(k, depth_m, time_s, joints_);
    }
    return has_image;
  }

  void judge() {
    std::vector<DepthImage> now_m;
    for (std::size_t k = 0; k < cameras_.size(); ++k) now_m.push_back(world_.obstacles_m(k));
    const double range_m = robot_->settings().distance.range_m;
    const std::vector<sim::SurfacePair> truth = world_.nearest(range_m);
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      SequenceInstant& instant = instants_[c].emplace_back();
      for (const sim::SurfacePair& pair : truth) {
        instant.push_back({pair.distance_m, range_m, range_m,
                           world_.sight(pair.b_m, now_m, conditions_[c].cameras)});
      }
      judged_[c]->tell(instant);
    }
  }

  const std::vector<SequenceCondition>& conditions_;
  SequenceSettings settings_;
  std::vector<CellCamera> cameras_;
  World world_;
  std::shared_ptr<const Robot> robot_;
  JointBuffer joints_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Judged>> judged_;
  std::vector<double> next_s_;
  std::vector<std::vector<SequenceInstant>> instants_;
};

/// A share of instants or links.
struct Share {
  std::size_t part = 0;
  std::size_t whole = 0;
  double percent() const {
    return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  }
  void add(bool is_part) {
    ++whole;
    part += is_part;
  }
};

std::string row(const SequenceCondition& condition, const std::vector<SequenceInstant>& instants) {
  Share zeros, zero_instants, large, large_instants, phantoms;
  double most_m = 0;
  for (const SequenceInstant& instant : instants) {
    bool has_zero = false, has_large = false;
    for (const SequenceLink& link : instant) {
      const bool is_zero = link.told_m < kTouching_m && link.true_m > kFree_m;
      zeros.add(is_zero);
      has_zero |= is_zero;
      phantoms.add(link.occupied_m < link.true_m - kFree_m);
      if (link.sight != sim::ObstacleSight::covered) continue;
      const double over_m = link.told_m - link.true_m;
      large.add(over_m > kTooLarge_m);
      has_large |= over_m > kTooLarge_m;
      most_m = std::max(most_m, over_m);
    }
    zero_instants.add(has_zero);
    large_instants.add(has_large);
  }
  return fmt::format(
      "| {}, {} camera{} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.0f} | {:.1f} % |\n",
      condition.name, condition.cameras, condition.cameras > 1 ? "s" : "", instants.size(),
      zeros.percent(), zero_instants.percent(), large.percent(), large_instants.percent(),
      1e3 * most_m, phantoms.percent());
}

}  // namespace

std::vector<SequenceCondition> sequence_conditions() {
  SpaceSettings no_closing;
  no_closing.detection_capability_m = 0;
  std::vector<SequenceCondition> conditions;
  for (const int cameras : {1, 2, 3}) conditions.push_back({.name = "clean", .cameras = cameras});
  for (const int cameras : {1, 2, 3}) {
    conditions.push_back({"dark outlines, dropouts", sim::kDarkErrors, {}, cameras});
  }
  conditions.push_back({"… `detection_capability_m: 0`", sim::kDarkErrors, no_closing, 3});
  conditions.push_back({"sensor model", sim::kKinectErrors, {}, 3});
  return conditions;
}

std::vector<std::vector<SequenceInstant>> run_sequence(
    std::uint32_t seed, const std::vector<SequenceCondition>& conditions,
    const SequenceSettings& settings) {
  return Sequence(seed, conditions, settings).run();
}

std::string sequence_table(const std::vector<SequenceCondition>& conditions,
                           const std::vector<std::vector<SequenceInstant>>& instants) {
  std::string table =
      "| images | instants | links at 0 though > 5 cm | instants with one "
      "| > 2 cm too large, in an image | instants with one | greatest [mm] | readings > 5 cm too "
      "small |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (std::size_t c = 0; c < conditions.size(); ++c) table += row(conditions[c], instants[c]);
  return table;
}

}  // namespace berth::lab
