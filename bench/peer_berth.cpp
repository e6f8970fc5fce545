// berth's own methods.
#include <hwy/targets.h>

#include <optional>

#include "bench/instruction_set.hpp"
#include "bench/peer.hpp"
#include "berth/distance/evaluate.hpp"

namespace berth::bench {
namespace {

DistanceSettings settings_of(const BenchScene& scene) {
  DistanceSettings settings;
  settings.range_m = scene.range_m;
  settings.mean_direction = false;
  return settings;
}

class BerthPeer : public Peer {
 public:
  BerthPeer(Method method, std::string name, std::optional<std::int64_t> target)
      : method_(method), name_(std::move(name)), target_(target) {}

  std::string name() const override { return name_; }
  std::string lacks() const override { return ""; }

  void prepare(const BenchScene& scene) override {
    if (method_ == Method::exact) {
      const Limit limit(target_);
      build_obstacle_tree(scene.obstacle_depth_m, tree_);
    }
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    const Limit limit(target_);
    berth::evaluate(method_, scene.camera, scene.robot, scene.obstacle_depth_m, tree_,
                    scene.link_count, settings_of(scene), workspace_, answer_);
    distances_m.clear();
    for (const LinkDistance& link : answer_.links) {
      distances_m.push_back(link.status == LinkStatus::ok ? std::optional(link.distance_m)
                                                          : std::nullopt);
    }
  }

 private:
  /// Nothing for a method that may use all that the machine has.
  struct Limit {
    explicit Limit(std::optional<std::int64_t> target) {
      if (target) limit.emplace(*target);
    }
    std::optional<InstructionSetLimit> limit;
  };

  Method method_;
  std::string name_;
  std::optional<std::int64_t> target_;
  ObstacleTree tree_;
  EvaluateWorkspace workspace_;
  LinkDistances answer_;
};

}  // namespace

std::unique_ptr<Peer> make_berth_exact() {
  return std::make_unique<BerthPeer>(Method::exact, "berth exact", std::nullopt);
}

std::unique_ptr<Peer> make_berth_exact_avx2() {
  if (!has_more_than_avx2()) return nullptr;
  return std::make_unique<BerthPeer>(Method::exact, "berth exact, AVX2 at most", HWY_AVX2);
}

std::unique_ptr<Peer> make_brute_force() {
  return std::make_unique<BerthPeer>(Method::brute_force, "brute force", std::nullopt);
}

}  // namespace berth::bench
