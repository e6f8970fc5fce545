#include "berth/distance/known_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "berth/distance/body_pair.hpp"
#include "berth/distance/last_request.hpp"

namespace berth {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kNoPair = std::numeric_limits<std::size_t>::max();
/// A pair is looked at up to so much farther than this request needs, for the next ones.
constexpr float kAhead_m = 0.05f;

struct BodyState {
  Pose X_BL = Pose::Identity();
  /// How far its points have come since the first request, at most.
  double travel_m = 0;
  /// The nearest of its pairs so far; before one was found, that of the request before.
  std::size_t pair = kNoPair;
  float best_m = kInfinity;
};

struct PairState {
  mesh::BodyPair found;
  /// Its lower bound plus the travel of both bodies when it was found.
  double level_m = 0;
  /// When it was looked at.
  std::uint64_t request = 0;
};

struct Candidate {
  float bound_m;
  std::size_t pair;
};

}  // namespace

struct KnownWorkspace::State {
  const KnownModel* known = nullptr;
  const RobotPose* pose = nullptr;
  MeshRequest request;
  std::uint64_t number = 0;
  std::vector<BodyState> bodies;
  std::vector<PairState> pairs;
  std::vector<Candidate> candidates;

  void begin(const KnownModel& model);
  void begin_anew();
  /// Looks no farther than range_m, and not at all where nothing is nearer than needed_m.
  void look(std::size_t p, float needed_m, float range_m);
  void look_at_candidates();
  void tell(std::vector<KnownPair>& out);

  const KnownBody& body(std::size_t p, std::size_t side) const {
    return known->bodies[known->pairs[p][side]];
  }
  double travel_m(std::size_t p) const {
    return bodies[known->pairs[p][0]].travel_m + bodies[known->pairs[p][1]].travel_m;
  }
  float bound_m(std::size_t p) const {
    return static_cast<float>(std::max(0.0, pairs[p].level_m - travel_m(p)));
  }
  /// Pairs that cannot be nearer than this change nothing for the body.
  float limit_of(std::size_t i) const {
    if (!known->bodies[i].is_asked) return 0;
    const float best_m = bodies[i].best_m;
    if (std::isinf(best_m)) return static_cast<float>(request.range_m);
    const auto tolerance_m = static_cast<float>(request.tolerance_m);
    // Decides whether they touch.
    return best_m > tolerance_m ? best_m - tolerance_m : best_m - mesh::kFinestTolerance_m;
  }
  /// Nor for either of a pair's bodies.
  float limit_m(std::size_t p) const {
    return std::max(limit_of(known->pairs[p][0]), limit_of(known->pairs[p][1]));
  }
};

KnownWorkspace::KnownWorkspace() : state_(std::make_unique<State>()) {}
KnownWorkspace::~KnownWorkspace() = default;
void KnownWorkspace::forget() { state_->known = nullptr; }

void KnownWorkspace::State::begin(const KnownModel& model) {
  ++number;
  const bool is_same = known == &model;
  known = &model;
  bodies.resize(model.bodies.size());
  pairs.resize(model.pairs.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pose& X_BL = pose->X_BL[model.bodies[i].link];
    const LinkPatches& patches = *model.bodies[i].patches;
    if (is_same) bodies[i].travel_m += mesh::moved_at_most_m(patches, bodies[i].X_BL, X_BL);
    bodies[i].X_BL = X_BL;
    bodies[i].best_m = kInfinity;
  }
  if (!is_same) begin_anew();
}

void KnownWorkspace::State::begin_anew() {
  for (BodyState& body : bodies) {
    body.travel_m = 0;
    body.pair = kNoPair;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    pairs[p].found.forget();
    const mesh::LinkBall a = mesh::ball_of(*body(p, 0).patches);
    const mesh::LinkBall b = mesh::ball_of(*body(p, 1).patches);
    const Eigen::Vector3d between_m =
        pose->X_BL[body(p, 0).link] * a.centre_L_m - pose->X_BL[body(p, 1).link] * b.centre_L_m;
    constexpr double kRounding_m = 1e-5;
    pairs[p].level_m = between_m.norm() - a.radius_m - b.radius_m - kRounding_m;
  }
}

void KnownWorkspace::State::look(std::size_t p, float needed_m, float range_m) {
  PairState& pair = pairs[p];
  if (pair.request == number) return;
  pair.request = number;
  const auto tolerance_m = static_cast<float>(request.tolerance_m);
  if (!pair.found.follow(body(p, 0), body(p, 1), *pose, needed_m, tolerance_m)) {
    MeshRequest up_to = request;
    up_to.range_m = std::min<double>(range_m, request.range_m);
    pair.found.find(body(p, 0), body(p, 1), *pose, up_to, bound_m(p));
  }
  pair.level_m = std::max<double>(bound_m(p), pair.found.lower_bound_m()) + travel_m(p);
  for (const std::size_t side : {0, 1}) {
    BodyState& of = bodies[known->pairs[p][side]];
    if (!body(p, side).is_asked || !(pair.found.distance_m() < of.best_m)) continue;
    of.best_m = pair.found.distance_m();
    of.pair = p;
  }
}

void KnownWorkspace::State::look_at_candidates() {
  candidates.clear();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (const float bound_m = this->bound_m(p); bound_m < limit_m(p)) {
      candidates.push_back({bound_m, p});
    }
  }
  std::ranges::sort(candidates, {}, &Candidate::bound_m);
  for (const auto& [bound_m, p] : candidates) {
    if (bound_m < limit_m(p)) look(p, limit_m(p), limit_m(p) + kAhead_m);
  }
}

void KnownWorkspace::State::tell(std::vector<KnownPair>& out) {
  out.assign(known->patches->links.size(), {});
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (known->bodies[i].is_asked) out[i].lower_bound_m = static_cast<float>(request.range_m);
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (const std::size_t side : {0, 1}) {
      if (!body(p, side).is_asked) continue;
      KnownPair& pair = out[known->pairs[p][side]];
      pair.lower_bound_m = std::min(pair.lower_bound_m, bound_m(p));
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const BodyState& of = bodies[i];
    if (!(of.best_m < request.range_m)) continue;
    const mesh::BodyPair& found = pairs[of.pair].found;
    const std::size_t own = known->pairs[of.pair][0] == i ? 0 : 1;
    const auto& mine = own == 0 ? found.link_point_B_m() : found.other_point_B_m();
    const auto& its = own == 0 ? found.other_point_B_m() : found.link_point_B_m();
    out[i].distance_m = of.best_m;
    out[i].lower_bound_m = std::min(out[i].lower_bound_m, of.best_m);
    out[i].robot_point_B_m = mine.cast<float>();
    out[i].obstacle_point_B_m = its.cast<float>();
    out[i].link = static_cast<int>(body(of.pair, 1 - own).link);
  }
}

void known_distances(const KnownModel& known, const RobotPose& pose, const MeshRequest& request,
                     KnownWorkspace& workspace, std::vector<KnownPair>& out) {
  KnownWorkspace::State& state = *workspace.state_;
  state.pose = &pose;
  state.request = request;
  state.begin(known);
  // What was nearest before is near.
  const auto range_m = static_cast<float>(request.range_m);
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    if (state.bodies[i].pair != kNoPair) state.look(state.bodies[i].pair, range_m, range_m);
  }
  state.look_at_candidates();
  state.tell(out);
}

}  // namespace berth
