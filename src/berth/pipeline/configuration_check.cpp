#include "berth/pipeline/configuration_check.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "berth/distance/ball_check.hpp"
#include "berth/distance/known_distances.hpp"
#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/link_searches.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/plausible_size.hpp"
#include "berth/space/serial_number.hpp"

namespace berth {
namespace {

constexpr float kNotAsked = std::numeric_limits<float>::quiet_NaN();
/// No part of a motion in which no joint moves farther is cut again, rad or m.
constexpr float kLeastStep = 0.002f;

/// All that the moved links may reach lies in this ball in B.
struct Reach {
  Eigen::Vector3d middle_B_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

/// The links from one that moves to the last that does not.
std::vector<std::size_t> moving_chain(const RobotModel& model, std::size_t link) {
  std::vector<std::size_t> chain;
  for (std::optional<std::size_t> i = link; i && model.is_moved(*i); i = model.links[*i].parent) {
    chain.push_back(*i);
  }
  return chain;
}

double slide_m(const RobotModel& model, const Joint& joint) {
  if (joint.type != JointType::prismatic || !joint.position_index) return 0;
  const MovableJoint& of = model.joints[*joint.position_index];
  return std::abs(joint.multiplier) * std::max(std::abs(of.lower), std::abs(of.upper)) +
         std::abs(joint.offset);
}

/// About the first joint, where all hang on the same one.
Reach reach_of(const RobotModel& model) {
  RobotPose pose;
  forward_kinematics(model, std::vector<double>(model.joints.size(), 0.0), pose);
  Reach reach;
  std::vector<std::vector<std::size_t>> chains;
  for (const std::size_t link : model.evaluated_links) {
    if (model.is_moved(link)) chains.push_back(moving_chain(model, link));
  }
  if (chains.empty()) return reach;
  for (const auto& chain : chains) {
    reach.middle_B_m += pose.X_BL[chain.back()].translation() / static_cast<double>(chains.size());
  }
  for (const auto& chain : chains) {
    const Joint& first = model.links[chain.back()].joint;
    double sum_m = (pose.X_BL[chain.back()].translation() - reach.middle_B_m).norm() +
                   slide_m(model, first) + reach_m(model.links[chain.front()].mesh_L);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Joint& joint = model.links[chain[i]].joint;
      sum_m += joint.X_PJ.translation().norm() + slide_m(model, joint);
    }
    reach.radius_m = std::max(reach.radius_m, sum_m);
  }
  // A field takes memory with the third power: 0.4 GB here. Beyond it all is undecided.
  constexpr double kMost_m = 2.5;
  reach.radius_m = std::min(reach.radius_m, kMost_m);
  return reach;
}

/// What the exact search says of a link that one joint moves, at each of some of its places: found
/// where somebody asks for the first time, for all threads.
class FirstLink {
 public:
  FirstLink(const RobotModel& model, const mesh::BallRobot& balls, const mesh::BallLink& link) {
    const std::size_t index = model.evaluated_links[link.id - 1];
    patches_.serial_number = mesh::next_serial_number();
    patches_.links.push_back(build_link_patches(model.links[index].mesh_L));
    patches_.links.back().link = index;
    joint_ = &model.links[moving_chain(model, index).back()].joint;
    if (balls.frames[static_cast<std::size_t>(link.frame)].is_slide) {
      // Limits are not enforced.
      constexpr double kMost_m = 2, kBeyond_m = 0.5;
      const MovableJoint& of = model.joints[*joint_->position_index];
      const auto ends = std::minmax({number_of(std::max(of.lower - kBeyond_m, -kMost_m)),
                                     number_of(std::min(of.upper + kBeyond_m, kMost_m))});
      low_ = ends.first, high_ = ends.second;
    } else {
      lever_m_ = link.balls.centre_m.norm() + link.balls.radius_m;
    }
  }

  void forget() {
    for (auto& cell : cells_) cell.store({kNotAsked, 0});
  }

  mesh::LinkBounds bounds(const RobotModel& model, const FrameSet& frames, float at) {
    // What a float rounds to may lie beyond, or in the cell beside.
    constexpr double kRounding = 1e-5;
    if (!(low_ - kRounding < at && at < high_ + kRounding)) return {0, HUGE_VALF};
    const double width = std::max((high_ - low_) / kCells, kRounding);
    const auto i = std::clamp(static_cast<int>((at - low_) / width), 0, kCells - 1);
    std::atomic<mesh::LinkBounds>& cell = cells_[static_cast<std::size_t>(i)];
    if (const auto known = cell.load(); !std::isnan(known.lower_m)) return known;
    mesh::LinkBounds found = find(model, frames, low_ + (i + 0.5) * width);
    const auto moved_m = static_cast<float>(lever_m_ * (width / 2 + kRounding));
    found = {std::max(0.0f, found.lower_m - moved_m), found.upper_m + moved_m};
    cell.store(found);
    return found;
  }

 private:
  static constexpr int kCells = 256;

  double number_of(double position) const { return joint_->multiplier * position + joint_->offset; }
  mesh::LinkBounds find(const RobotModel& model, const FrameSet& frames, double at) const {
    std::vector<double> positions(model.joints.size(), 0.0);
    positions[*joint_->position_index] = (at - joint_->offset) / joint_->multiplier;
    RobotPose pose;
    forward_kinematics(model, positions, pose);
    MeshWorkspace workspace;
    std::vector<WholeLinkDistance> out;
    mesh::LinkBounds found{HUGE_VALF, HUGE_VALF};
    for (const UnknownSpace* space : {&frames.space(), &frames.undecided()}) {
      if (space->views().empty()) continue;
      mesh_distances(patches_, pose, *space, {.range_m = 0.25}, workspace, out);
      // NaN is no bound.
      const float lower_m = std::max(0.0f, out.front().nearest.lower_bound_m);
      found.lower_m = std::min(found.lower_m, lower_m);
      found.upper_m = std::fmin(found.upper_m, out.front().nearest.distance_m);
    }
    return found;
  }

  const Joint* joint_;
  /// Where the joint may stand, rad or m, and how far its link's points move by each of these.
  double low_ = -std::numbers::pi, high_ = std::numbers::pi, lever_m_ = 1;
  RobotPatches patches_;
  std::array<std::atomic<mesh::LinkBounds>, kCells> cells_;
};

void require_margin(double margin_m) {
  if (std::isfinite(margin_m) && margin_m >= 0) return;
  throw std::invalid_argument(fmt::format(
      "configurations: a margin is {} m; expected a finite number of at least 0", margin_m));
}

}  // namespace

struct ConfigurationCheck::State {
  mesh::BallRobot balls;
  Reach reach;
  FrameSet frames;
  ClearanceField field;
  bool is_known = false;
  /// Of each of the balls' links; null unless one joint alone moves it.
  std::vector<std::unique_ptr<FirstLink>> first;
  mesh::FirstLinkBounds first_link_bounds;
  /// Made by the first request that needs them.
  std::once_flag pairs_made;
  mesh::BallPairs pairs;
};

/// What the check of balls reads besides; a thread's own, so that asking allocates nothing.
struct ConfigurationCheck::Margins {
  std::vector<float> of_ids, of_balls;
  std::vector<std::vector<float>> of_still;
};

ConfigurationCheck::ConfigurationCheck(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), state_(std::make_unique<State>()) {
  State& state = *state_;
  state.balls = mesh::build_ball_robot(robot_->model());
  for (const mesh::BallLink& link : state.balls.links) {
    const bool is_first = state.balls.is_first(link);
    state.first.push_back(is_first ? std::make_unique<FirstLink>(robot_->model(), state.balls, link)
                                   : nullptr);
  }
  state.first_link_bounds = [this](std::size_t l, float at) {
    return state_->first[l]->bounds(robot_->model(), state_->frames, at);
  };
  state.reach = reach_of(robot_->model());
}

ConfigurationCheck::~ConfigurationCheck() = default;

ResultStatus ConfigurationCheck::prepare(const NewestFrames& frames, std::optional<double> now_s,
                                         const std::optional<Pose>& X_WB) {
  State& state = *state_;
  const TimeSettings& time = robot_->settings().time;
  state.is_known = false;
  if (X_WB && !X_WB->matrix().allFinite()) return ResultStatus::stale;
  state.frames.assign(frames.get(), time, now_s, X_WB);
  if (state.frames.used().empty()) return ResultStatus::stale;
  state.field.build(state.frames.space(), state.frames.undecided(), state.reach.middle_B_m,
                    state.reach.radius_m);
  for (const auto& first : state.first) {
    if (first) first->forget();
  }
  state.is_known = true;
  const bool are_all =
      std::ranges::all_of(state.frames.cameras(), is_relied_on, &CameraState::status);
  return are_all ? ResultStatus::ok : ResultStatus::degraded;
}

void ConfigurationCheck::require(std::span<const double> positions, std::size_t verdicts) const {
  const std::size_t joints = robot_->model().joints.size();
  if (positions.size() != joints * verdicts) {
    throw std::invalid_argument(
        fmt::format("configurations: {} numbers; expected {} for {} verdicts and {} joints",
                    positions.size(), joints * verdicts, verdicts, joints));
  }
  const auto bad = std::ranges::find_if(positions, [](double q) { return !std::isfinite(q); });
  if (bad == positions.end()) return;
  const auto at = static_cast<std::size_t>(bad - positions.begin());
  throw std::invalid_argument(fmt::format(
      "configurations: joint \"{}\" of configuration {} is {}; expected a finite number",
      robot_->model().joints[at % joints].name, at / joints, *bad));
}

void ConfigurationCheck::find_margins(const ConfigurationMargins& margins, Margins& out) const {
  require_margin(margins.margin_m);
  if (margins.known_margin_m) require_margin(*margins.known_margin_m);
  const RobotModel& model = robot_->model();
  out.of_ids.assign(model.evaluated_links.size(), static_cast<float>(margins.margin_m));
  const auto of = [&](const std::string& name) -> float& {
    for (std::size_t i = 0; i < out.of_ids.size(); ++i) {
      if (model.links[model.evaluated_links[i]].name == name) return out.of_ids[i];
    }
    throw std::invalid_argument(
        fmt::format("configurations: link \"{}\" is not known; expected one of {}", name,
                    fmt::join(model.evaluated_link_names(), ", ")));
  };
  for (const auto& [name, margin_m] : margins.of_links) {
    require_margin(margin_m);
    of(name) = static_cast<float>(margin_m);
  }
  for (const std::string& name : margins.without) of(name) = kNotAsked;
  out.of_balls.clear();
  for (const mesh::BallLink& link : state_->balls.links) {
    out.of_balls.push_back(out.of_ids[link.id - 1]);
  }
}

template <class Check>
void ConfigurationCheck::check_all(const ConfigurationMargins& margins, std::span<Verdict> verdicts,
                                   const Check& check) const {
  thread_local Margins found;
  // A thread that waits for others may be given another question meanwhile.
  Margins own;
  std::swap(own, found);
  find_margins(margins, own);
  std::ranges::fill(verdicts, Verdict::undecided);
  State& state = *state_;
  mesh::BallRequest request{state.balls, state.field.grid(), own.of_balls, state.first_link_bounds};
  if (margins.known_margin_m) {
    std::call_once(state.pairs_made, [&] {
      state.pairs = mesh::build_ball_pairs(robot_->model(), robot_->known(), state.balls,
                                           state.reach.middle_B_m, state.reach.radius_m);
    });
    const auto margin_m = static_cast<float>(*margins.known_margin_m);
    own.of_still.resize(state.pairs.still.size());
    for (std::size_t i = 0; i < own.of_still.size(); ++i) {
      own.of_still[i].clear();
      for (const bool asks : state.pairs.still[i]->asks) {
        own.of_still[i].push_back(asks ? margin_m : kNotAsked);
      }
    }
    request.pairs = &state.pairs;
    request.pairs_margin_m = margin_m;
    request.still_margins_m = own.of_still;
  }
  constexpr std::size_t kAtATime = 32;
  if (state.is_known) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, verdicts.size(), kAtATime),
                      [&](const auto& range) { check(request, range.begin(), range.size()); });
  }
  std::swap(own, found);
}

void ConfigurationCheck::ask(std::span<const double> positions, const ConfigurationMargins& margins,
                             std::span<Verdict> verdicts) const {
  require(positions, verdicts.size());
  const std::size_t joints = robot_->model().joints.size();
  check_all(margins, verdicts,
            [&](const mesh::BallRequest& request, std::size_t first, std::size_t count) {
              mesh::check_configurations(request, positions.subspan(joints * first, joints * count),
                                         verdicts.subspan(first, count));
            });
}

void ConfigurationCheck::ask_motions(std::span<const double> from, std::span<const double> to,
                                     const ConfigurationMargins& margins,
                                     std::span<Verdict> verdicts) const {
  require(from, verdicts.size());
  require(to, verdicts.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (std::abs(to[k] - from[k]) <= kMostMotion) continue;
    const std::vector<MovableJoint>& all = robot_->model().joints;
    throw std::invalid_argument(
        fmt::format("configurations: joint \"{}\" of motion {} goes by {}; expected at most {}",
                    all[k % all.size()].name, k / all.size(), to[k] - from[k], kMostMotion));
  }
  const std::size_t joints = robot_->model().joints.size();
  check_all(margins, verdicts,
            [&](const mesh::BallRequest& request, std::size_t first, std::size_t count) {
              for (std::size_t i = first; i < first + count; ++i) {
                verdicts[i] = mesh::check_motion(request, from.subspan(joints * i, joints),
                                                 to.subspan(joints * i, joints), kLeastStep);
              }
            });
}

KnownPair ConfigurationCheck::find_known(const JointState& joints,
                                         KnownWorkspace& workspace) const {
  RobotPose pose;
  forward_kinematics(robot_->model(), joints.position, pose);
  std::vector<KnownPair> pairs;
  known_distances(robot_->known(), pose, {.range_m = robot_->settings().distance.range_m},
                  workspace, pairs);
  KnownPair least;
  for (const KnownPair& pair : pairs) {
    least.distance_m = std::fmin(least.distance_m, pair.distance_m);
    least.lower_bound_m = std::fmin(least.lower_bound_m, pair.lower_bound_m);
  }
  return least;
}

void ConfigurationCheck::resolve(std::span<const double> positions,
                                 const ConfigurationMargins& margins,
                                 std::span<Verdict> verdicts) const {
  require(positions, verdicts.size());
  Margins own;
  find_margins(margins, own);
  const std::vector<float>& of_balls = own.of_balls;
  if (!state_->is_known) return;
  const std::size_t joints = robot_->model().joints.size();
  std::vector<std::size_t> open;
  std::vector<JointState> asked;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] != Verdict::undecided) continue;
    open.push_back(i);
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(joints * i);
    asked.push_back({0, {first, first + static_cast<std::ptrdiff_t>(joints)}});
  }
  // No farther than tells on which side of the margins something is, and to the end.
  DistanceSettings settings = robot_->settings().distance;
  float most_m = 0;
  for (const float margin_m : of_balls) most_m = std::fmax(most_m, margin_m);
  settings.range_m = std::min(most_m + 0.001, kRange.most);
  settings.deadline_us.reset();
  std::vector<std::vector<WholeLinkDistance>> found;
  LookAheadSearch(robot_).ask(state_->frames, asked, settings, found);
  KnownWorkspace workspace;
  for (std::size_t k = 0; k < open.size(); ++k) {
    bool is_free = true, is_near = false;
    if (margins.known_margin_m) {
      const KnownPair nearest = find_known(asked[k], workspace);
      is_near = nearest.distance_m <= *margins.known_margin_m;
      // Without a pair there is no bound.
      is_free = !(nearest.lower_bound_m <= *margins.known_margin_m);
    }
    for (std::size_t l = 0; l < of_balls.size(); ++l) {
      const SpacePair& nearest = found[k][state_->balls.links[l].id - 1].nearest;
      if (std::isnan(of_balls[l])) continue;
      is_near = is_near || nearest.distance_m <= of_balls[l];
      is_free = is_free && nearest.lower_bound_m > of_balls[l];
    }
    if (is_near || is_free) verdicts[open[k]] = is_near ? Verdict::near : Verdict::free;
  }
}

}  // namespace berth
