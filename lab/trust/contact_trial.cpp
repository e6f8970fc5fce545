#include "lab/trust/contact_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "lab/measure/each_alone.hpp"
#include "sim/sensor_model.hpp"
#include "sim/structured_light.hpp"

namespace berth::lab {
namespace {

constexpr int kBackgroundFrames = 5;
/// Of the empty cell in each of two poses of the robot, neither that of the scene: what the robot
/// hides later is known. In some images a pixel has no reading.
constexpr std::uint32_t kEmptyImages = 8;
constexpr double kTooFar_m = 0.04;
constexpr double kFalselyNear_m = 0.05;

/// One camera's images.
class ContactSensor {
 public:
  ContactSensor(const sim::ContactScene& scene, const sim::ContactView& view, const ContactCase& of,
                bool has_things)
      : of_(of), rays_(scene, view, has_things) {
    if (of.images == ContactImages::structured_light) {
      view_ = sim::look(rays_.rays());
    } else {
      view_.hit = rays_.rays().cast();
    }
    if (of.scene.kind == sim::ContactKind::black) blacken();
  }

  DepthImage take(std::uint32_t seed) const {
    DepthImage depth_m(view_.hit.width(), view_.hit.height(), kNoDepth);
    if (of_.images == ContactImages::structured_light) {
      sim::Random random(seed);
      const Image<std::uint16_t> depth_mm = sim::sense(view_, random);
      for (std::size_t i = 0; i < depth_mm.pixels().size(); ++i) {
        if (depth_mm.pixels()[i] > 0) depth_m.pixels()[i] = 0.001F * depth_mm.pixels()[i];
      }
      return depth_m;
    }
    for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
      depth_m.pixels()[i] = view_.hit.pixels()[i].depth_m;
    }
    if (of_.images == ContactImages::sensor_model) {
      sim::add_errors(sim::kKinectErrors, seed, depth_m);
    }
    return depth_m;
  }

 private:
  /// No light comes back from the things.
  void blacken() {
    for (std::size_t i = 0; i < view_.hit.pixels().size(); ++i) {
      sim::SurfaceHit& hit = view_.hit.pixels()[i];
      if (!rays_.shows_thing(hit)) continue;
      hit.depth_m = kNoDepth;
      if (!view_.lit.pixels().empty()) view_.lit.pixels()[i] = 0;
    }
  }

  const ContactCase& of_;
  sim::ContactRays rays_;
  sim::CleanView view_;
};

void learn_cell(sim::ContactScene scene, std::size_t camera, const ContactCase& of,
                std::uint32_t seed, Observer& observer) {
  sim::Random random(seed);
  Frame frame;
  for (int pose = 0; pose < 2; ++pose) {
    scene.joints = sim::draw_joints(random, scene.model);
    forward_kinematics(scene.model, scene.joints.position, scene.pose);
    const ContactSensor empty(scene, scene.views[camera], of, false);
    for (std::uint32_t i = 0; i < kEmptyImages; ++i) {
      const DepthImage depth_m = empty.take(seed + pose * kEmptyImages + i);
      observer.observe(depth_m, scene.joints, frame);
      observer.learn_background(depth_m, frame);
    }
  }
}

std::unique_ptr<Frame> observe(const std::shared_ptr<const Robot>& robot,
                               const sim::ContactScene& scene, std::size_t camera,
                               const ContactCase& of, std::uint32_t seed) {
  const sim::ContactView& view = scene.views[camera];
  CameraSettings settings;
  settings.space.unobserved = of.unobserved;
  if (of.knows_cell) settings.sensor.background_frames = kBackgroundFrames;
  const CameraMount mount{view.camera, scene.model.links.front().name, view.X_BC,
                          fmt::format("camera_{}", camera)};
  Observer observer(std::make_shared<const MountedCamera>(robot, mount, settings));
  auto frame = std::make_unique<Frame>();
  if (of.knows_cell) learn_cell(scene, camera, of, seed + 100, observer);
  observer.observe(ContactSensor(scene, view, of, true).take(seed), scene.joints, *frame);
  return frame;
}

ContactLink judge(const LinkResult& link, double truth_m, bool is_covered) {
  const auto length_m = [](const SpacePair& pair) {
    return pair.is_known() ? pair.distance_m : std::numeric_limits<double>::infinity();
  };
  const float outside = link.visibility.space.outside_image;
  return {link.status == LinkStatus::ok || link.status == LinkStatus::none_in_range,
          is_covered,
          std::isnan(outside) ? 0 : outside,
          std::min(truth_m, kTrialRange_m),
          length_m(link),
          length_m(link.occupied)};
}

/// A row of the table: what became of its links.
struct ContactCount {
  int links = 0, untold = 0, uncovered = 0, uncovered_far = 0, assumed = 0, far_one = 0, far = 0,
      occupied_far = 0, near = 0, occupied_near = 0;
  double greatest_m = 0;

  void add(const ContactTrial& trial) {
    for (const ContactLink& link : trial.links) {
      if (!link.is_told) ++untold;
      if (!link.is_told) continue;
      ++links;
      const double over_m = link.too_far_m();
      uncovered += !link.is_covered;
      uncovered_far += !link.is_covered && over_m > kTooFar_m;
      near += over_m < -kFalselyNear_m;
      occupied_near += link.occupied_too_far_m() < -kFalselyNear_m;
      if (!link.is_covered) continue;
      if (trial.is_assumed_away) {
        assumed += over_m > kTooFar_m;
        continue;
      }
      (trial.cameras == 1 ? far_one : far) += over_m > kTooFar_m;
      occupied_far += link.occupied_too_far_m() > kTooFar_m;
      greatest_m = std::max(greatest_m, over_m);
    }
  }
};

std::string row(const ContactCase& of, const ContactCount& c) {
  const bool is_black = of.scene.kind == sim::ContactKind::black;
  return fmt::format("| {}{} | {} | {} | {} | {} | {} | {} | {:.1f} | {} of {} | {} | {} | {} |\n",
                     sim::kContactKindNames[static_cast<std::size_t>(of.scene.kind)],
                     is_black ? of.knows_cell ? ", known cell" : ", unknown cell" : "",
                     kContactImageNames[static_cast<std::size_t>(of.images)], c.links, c.untold,
                     c.occupied_far, c.far_one, c.far, 100 * c.greatest_m, c.uncovered_far,
                     c.uncovered, c.assumed, c.occupied_near, c.near);
}

ContactCount count(const std::vector<TrialRobot>& robots, const ContactCase& of, int first,
                   int scenes, std::string& worst) {
  std::vector<ContactTrial> trials(scenes);
  each_alone(scenes, [&](int i) {
    ContactCase one = of;
    one.scene.cameras = 1 + (first + i) % 3;
    trials[i] = run_contact_trial(robots[(first + i) / 3 % robots.size()], one,
                                  static_cast<std::uint32_t>(first + i));
  });
  ContactCount count;
  for (const ContactTrial& trial : trials) {
    count.add(trial);
    for (std::size_t i = 0; i < trial.links.size(); ++i) {
      const ContactLink& link = trial.links[i];
      const bool is_judged = link.is_told && link.is_covered && !trial.is_assumed_away;
      if (!is_judged || link.too_far_m() <= kTooFar_m) continue;
      worst +=
          fmt::format("{}, {}: {}, seed {}, {} cameras, link {}: truly {:.3f} m, told {:.3f}\n",
                      sim::kContactKindNames[static_cast<std::size_t>(of.scene.kind)],
                      kContactImageNames[static_cast<std::size_t>(of.images)], trial.robot,
                      trial.seed, trial.cameras, i + 1, link.truth_m, link.distance_m);
    }
  }
  return count;
}

std::vector<ContactTrial> run_trials(const std::vector<TrialRobot>& robots, const ContactCase& of,
                                     int first, int scenes) {
  std::vector<ContactTrial> trials(scenes);
  each_alone(scenes, [&](int i) {
    trials[i] = run_contact_trial(robots[(first + i) % robots.size()], of,
                                  static_cast<std::uint32_t>(first + i));
  });
  return trials;
}

}  // namespace

std::string unobserved_table(const std::vector<TrialRobot>& robots, int first, int scenes) {
  std::string text =
      "| `unobserved` | cameras | links told | not told | > 4 cm too far | … of these more than "
      "half of the ball in no image | > 5 cm too near | below 5 cm, truly above 10 cm |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  using Meaning = std::optional<Unobserved>;
  for (const Meaning meaning :
       {Meaning(Unobserved::ignore), Meaning(), Meaning(Unobserved::unknown)}) {
    for (int cameras = 1; cameras <= 4; ++cameras) {
      const ContactCase of{{.kind = sim::ContactKind::beside_images, .cameras = cameras},
                           ContactImages::clean,
                           false,
                           meaning};
      int told = 0, untold = 0, far = 0, far_outside = 0, near = 0, below = 0;
      for (const ContactTrial& trial : run_trials(robots, of, first, scenes)) {
        for (const ContactLink& link : trial.links) {
          ++(link.is_told ? told : untold);
          if (!link.is_told) continue;
          const bool is_far = link.too_far_m() > kTooFar_m;
          far += is_far;
          far_outside += is_far && link.unobserved_share > 0.5;
          near += link.too_far_m() < -kFalselyNear_m;
          below += link.distance_m < 0.05 && link.truth_m > 0.1;
        }
      }
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n",
                          meaning ? name_of(*meaning) : "not set", cameras, told, untold, far,
                          far_outside, near, below);
    }
  }
  return fmt::format("{} scenes in each row, {} robots\n\n{}", scenes, robots.size(), text);
}

ContactTrial run_contact_trial(const TrialRobot& robot, const ContactCase& of, std::uint32_t seed) {
  const sim::ContactScene scene = sim::draw_contact(robot.model, robot.link_trees, of.scene, seed);
  EvaluationSettings settings;
  settings.distance.range_m = kTrialRange_m;
  const auto asked = std::make_shared<const Robot>(scene.model, settings);
  std::vector<std::unique_ptr<Frame>> frames;
  std::vector<const Frame*> newest;
  for (std::size_t k = 0; k < scene.views.size(); ++k) {
    frames.push_back(observe(asked, scene, k, of, 1000 * seed + static_cast<std::uint32_t>(k)));
    newest.push_back(frames.back().get());
  }
  Query query(asked);
  const Result& result = query.ask({newest});
  ContactTrial trial{seed, robot.name, of.scene.cameras, false, {}};
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    trial.links.push_back(judge(result.links[i], scene.truth_m[i], scene.is_covered[i]));
  }
  const auto nearest = std::ranges::min_element(scene.truth_m) - scene.truth_m.begin();
  trial.is_assumed_away = scene.thickness_m < result.links[nearest].assumed_thinner_m;
  return trial;
}

std::string contact_table(const std::vector<TrialRobot>& robots, int first, int scenes) {
  using sim::ContactKind;
  std::string text =
      "| | images | links | not told | `occupied` > 4 cm too far | `distance_m` > 4 cm too far, 1 "
      "camera | … 2 and 3 cameras | greatest [cm] | nearest place unseen, too far | thinner than "
      "assumed, too far | `occupied` > 5 cm too near | `distance_m` > 5 cm too near |\n"
      "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  std::string worst;
  constexpr int kRows = 18;
  scenes = std::max(1, scenes / kRows);
  const auto add = [&](ContactKind kind, ContactImages images, bool knows_cell) {
    const ContactCase of{{.kind = kind}, images, knows_cell};
    text += row(of, count(robots, of, first, scenes, worst));
  };
  for (std::size_t k = 0; k < sim::kContactKindNames.size(); ++k) {
    const auto kind = static_cast<ContactKind>(k);
    for (const ContactImages images :
         {ContactImages::clean, ContactImages::sensor_model, ContactImages::structured_light}) {
      if (kind == ContactKind::black) add(kind, images, true);
      add(kind, images, false);
    }
  }
  return fmt::format("{} scenes in each row, {} robots, 1 to 3 cameras\n\n{}\n{}", scenes,
                     robots.size(), text, worst);
}

}  // namespace berth::lab
