#include "berth/distance/known_model.hpp"

#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include "berth/distance/body_pair.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth {
namespace {

using Pair = std::array<std::size_t, 2>;

KnownBody body_of(const RobotModel& model, const LinkPatches& patches, std::size_t link) {
  const bool is_evaluated = model.links[link].role == LinkRole::evaluated;
  return {link, &patches, mesh::MeshParts(model.links[link].mesh_L),
          is_evaluated && model.is_moved(link)};
}

/// Without what was allowed to touch.
void append_bodies(const RobotModel& model, KnownModel& known) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.links[i].role != LinkRole::environment) continue;
    known.environment.push_back(build_link_patches(model.links[i].mesh_L));
    known.environment.back().link = i;
  }
  for (const auto* of : {&known.patches->links, &std::as_const(known.environment)}) {
    for (const LinkPatches& patches : *of) {
      known.bodies.push_back(body_of(model, patches, patches.link));
    }
  }
}

/// The link that a chain of fixed joints begins at.
std::size_t begin_of_fixed(const RobotModel& model, std::size_t link) {
  while (model.links[link].parent && !model.links[link].joint.position_index) {
    link = *model.links[link].parent;
  }
  return link;
}

bool hangs_on(const RobotModel& model, std::size_t link, std::size_t other) {
  std::optional<std::size_t> above = model.links[link].parent;
  while (above && model.links[*above].mesh_L.empty()) above = model.links[*above].parent;
  return above == other;
}

std::optional<LeftOutReason> allowed_by(const RobotModel& model, std::size_t a, std::size_t b) {
  std::optional<LeftOutReason> reason;
  for (const AllowedContact& contact : model.allowed_contacts) {
    const auto names = [&](std::size_t i, std::size_t k) {
      return model.links[i].name == contact.link && model.links[k].name == contact.other;
    };
    if (!names(a, b) && !names(b, a)) continue;
    if (!contact.is_of_srdf) return LeftOutReason::allowed;
    reason = LeftOutReason::srdf;
  }
  return reason;
}

std::optional<LeftOutReason> reason_of(const RobotModel& model, std::size_t a, std::size_t b) {
  if (begin_of_fixed(model, a) == begin_of_fixed(model, b)) return LeftOutReason::fixed;
  if (hangs_on(model, a, b) || hangs_on(model, b, a)) return LeftOutReason::neighbours;
  return allowed_by(model, a, b);
}

/// Within the limits; anywhere for a joint that has none.
void draw_positions(const RobotModel& model, std::mt19937& random, std::vector<double>& positions) {
  positions.clear();
  for (const MovableJoint& joint : model.joints) {
    const bool is_limited = joint.lower < joint.upper && joint.upper - joint.lower < 1e3;
    const double lower = is_limited ? joint.lower : -std::numbers::pi;
    const double upper = is_limited ? joint.upper : std::numbers::pi;
    positions.push_back(lower + (upper - lower) * (random() / 4294967296.0));
  }
}

/// Those of the pairs that touch in all drawn poses.
std::vector<Pair> find_always_touching(const RobotModel& model, const KnownModel& known) {
  std::vector<Pair> touching = known.pairs;
  std::mt19937 random(1);
  std::vector<double> positions;
  RobotPose pose;
  std::map<Pair, mesh::TouchSearch> searches;
  for (int i = 0; i < KnownModel::kDrawnPoses && !touching.empty(); ++i) {
    draw_positions(model, random, positions);
    forward_kinematics(model, positions, pose);
    std::erase_if(touching, [&](const Pair& pair) {
      return !searches[pair].is_touching(known.bodies[pair[0]], known.bodies[pair[1]], pose);
    });
  }
  return touching;
}

}  // namespace

std::shared_ptr<const KnownModel> build_known_model(const RobotModel& model,
                                                    std::shared_ptr<const RobotPatches> patches,
                                                    const std::set<Pair>& touching) {
  const auto known = std::make_shared<KnownModel>();
  known->patches = std::move(patches);
  append_bodies(model, *known);
  const auto leave_out = [&](const Pair& pair, LeftOutReason reason) {
    known->left_out.push_back({known->bodies[pair[0]].link, known->bodies[pair[1]].link, reason});
  };
  for (std::size_t a = 0; a < known->bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < known->bodies.size(); ++b) {
      if (!known->bodies[a].is_asked && !known->bodies[b].is_asked) continue;
      const Pair pair = known->bodies[a].is_asked ? Pair{a, b} : Pair{b, a};
      if (known->bodies[a].patches->empty() || known->bodies[b].patches->empty()) continue;
      auto reason = reason_of(model, known->bodies[a].link, known->bodies[b].link);
      if (!reason && touching.contains({known->bodies[pair[0]].link, known->bodies[pair[1]].link}))
        reason = LeftOutReason::always_touch;
      reason ? leave_out(pair, *reason) : known->pairs.push_back(pair);
    }
  }
  for (const Pair& pair : find_always_touching(model, *known)) {
    std::erase(known->pairs, pair);
    leave_out(pair, LeftOutReason::always_touch);
  }
  return known;
}

}  // namespace berth
