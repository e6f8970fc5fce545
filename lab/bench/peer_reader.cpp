// No method: the time that memory takes to hand over the images.
#include "lab/bench/peer.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/bench/peer_reader.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth::lab {
namespace HWY_NAMESPACE {

/// Four sums side by side: none waits for the one before.
std::uint64_t sum_of_words(const std::uint64_t* words, std::size_t count) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<std::uint64_t> lanes;
  const std::size_t step = hn::Lanes(lanes);
  auto a = hn::Zero(lanes);
  auto b = a;
  auto c = a;
  auto d = a;
  for (std::size_t i = 0; i + 4 * step <= count; i += 4 * step) {
    a = hn::Xor(a, hn::LoadU(lanes, words + i));
    b = hn::Xor(b, hn::LoadU(lanes, words + i + step));
    c = hn::Xor(c, hn::LoadU(lanes, words + i + 2 * step));
    d = hn::Xor(d, hn::LoadU(lanes, words + i + 3 * step));
  }
  return hn::GetLane(hn::SumOfLanes(lanes, hn::Xor(hn::Xor(a, b), hn::Xor(c, d))));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::lab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::lab {

HWY_EXPORT(sum_of_words);

namespace {

template <class T>
std::uint64_t read_all(const std::vector<T>& pixels) {
  return HWY_DYNAMIC_DISPATCH(sum_of_words)(reinterpret_cast<const std::uint64_t*>(pixels.data()),
                                            pixels.size() * sizeof(T) / sizeof(std::uint64_t));
}

class Reader : public Peer {
 public:
  std::string name() const override { return "nothing: read the images"; }
  std::string lacks() const override { return "an answer"; }
  void prepare(const BenchScene& scene) override {
    sum_ = read_all(scene.obstacle_depth_m.pixels());
  }
  void evaluate(const BenchScene& scene, PeerDistances&) override {
    sum_ = read_all(scene.robot.depth_m.pixels()) + read_all(scene.robot.link_id.pixels());
  }

 private:
  /// Kept, so that the compiler cannot leave the reading out.
  volatile std::uint64_t sum_ = 0;
};

}  // namespace

std::unique_ptr<Peer> make_reader() { return std::make_unique<Reader>(); }

}  // namespace berth::lab
#endif  // HWY_ONCE
