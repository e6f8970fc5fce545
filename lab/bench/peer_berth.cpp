// berth's own methods.
#include <hwy/targets.h>

#include <algorithm>
#include <optional>

#include "lab/bench/peer.hpp"
#include "lab/measure/instruction_set.hpp"
#include "thesis/evaluate.hpp"

namespace berth::lab {
namespace {

/// How far the scene was beside its place when the request before was asked.
constexpr int kMoved_px = 2;

/// How berth is asked.
struct Variant {
  std::string name;
  Method method = Method::exact;
  /// Nothing: all that the machine has.
  std::optional<std::int64_t> instruction_set = std::nullopt;
  int threads = 1;
  /// Begins from the answer before.
  bool warm = false;
  double tolerance_m = 0;
  std::optional<double> deadline_us = std::nullopt;
};

/// The obstacles kMoved_px to the right.
DepthImage moved(const DepthImage& depth_m) {
  DepthImage to_m(depth_m.width(), depth_m.height(), kNoDepth);
  for (int v = 0; v < depth_m.height(); ++v) {
    std::copy(depth_m.row(v), depth_m.row(v) + depth_m.width() - kMoved_px,
              to_m.row(v) + kMoved_px);
  }
  return to_m;
}

class BerthPeer : public Peer {
 public:
  explicit BerthPeer(Variant variant) : variant_(std::move(variant)) {}

  std::string name() const override { return variant_.name; }
  std::string lacks() const override {
    return variant_.method == Method::lattice ? "certainty: misses what its lattice does" : "";
  }
  int threads() const override { return variant_.threads; }

  void load(const BenchScene& scene) override {
    range_m_ = scene.range_m;
    if (!variant_.warm) return;
    const DepthImage before_m = moved(scene.obstacle_depth_m);
    obstacles_.build(before_m);
    before_.links.clear();
    ask(scene, before_);
  }

  void begin() override { answer_ = before_; }

  void prepare(const BenchScene& scene) override {
    if (variant_.method != Method::exact) {
      obstacles_ = SearchableDepth(scene.obstacle_depth_m);
      return;
    }
    const Limit limit(variant_.instruction_set);
    obstacles_.build(scene.obstacle_depth_m);
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    const Limit limit(variant_.instruction_set);
    ask(scene, answer_);
    distances_m.clear();
    for (const LinkDistance& link : answer_.links) {
      distances_m.push_back(link.status == LinkStatus::ok ? std::optional(link.distance_m)
                                                          : std::nullopt);
    }
  }

  std::optional<double> known_to_m() const override {
    if (variant_.method != Method::exact) return std::nullopt;
    double most_m = 0;
    for (const LinkDistance& link : answer_.links) {
      if (link.status == LinkStatus::not_visible) continue;
      const double distance_m = link.status == LinkStatus::ok ? link.distance_m : range_m_;
      most_m = std::max(most_m, distance_m - link.lower_bound_m);
    }
    return most_m;
  }

 private:
  /// Nothing for a method that may use all that the machine has.
  struct Limit {
    explicit Limit(std::optional<std::int64_t> target) {
      if (target) limit.emplace(*target);
    }
    std::optional<InstructionSetLimit> limit;
  };

  void ask(const BenchScene& scene, LinkDistances& answer) {
    ImageDistanceSettings settings;
    settings.range_m = scene.range_m;
    settings.mean_direction = false;
    settings.tolerance_m = variant_.tolerance_m;
    settings.deadline_us = variant_.deadline_us;
    berth::evaluate(variant_.method,
                    {scene.camera, scene.robot, scene.link_count, obstacles_, settings}, workspace_,
                    answer);
  }

  Variant variant_;
  double range_m_ = 0;
  SearchableDepth obstacles_;
  EvaluateWorkspace workspace_;
  /// Empty for a method that begins from nothing.
  LinkDistances before_;
  LinkDistances answer_;
};

}  // namespace

std::unique_ptr<Peer> make_berth_exact() {
  return std::make_unique<BerthPeer>(Variant{.name = "berth exact"});
}

std::vector<std::unique_ptr<Peer>> make_berth_variants() {
  std::vector<std::unique_ptr<Peer>> peers;
  const auto add = [&](Variant variant) {
    peers.push_back(std::make_unique<BerthPeer>(std::move(variant)));
  };
  if (has_more_than_avx2()) {
    add({.name = "berth exact, AVX2 at most", .instruction_set = HWY_AVX2});
  }
  add({.name = "berth exact, warm", .warm = true});
  add({.name = "berth exact, to 1 mm", .tolerance_m = 1e-3});
  add({.name = "berth exact, deadline 0.5 ms", .deadline_us = 500});
  add({.name = "berth exact, 2 threads", .threads = 2});
  add({.name = "berth lattice", .method = Method::lattice});
  return peers;
}

std::unique_ptr<Peer> make_brute_force() {
  return std::make_unique<BerthPeer>(Variant{.name = "brute force", .method = Method::brute_force});
}

}  // namespace berth::lab
