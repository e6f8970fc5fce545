// A way to find the distances: berth's own, or what a user could take instead.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/bench/bench_scene.hpp"

namespace berth::lab {

/// Per link the distance in metres; nothing where none lies within the scene's range.
using PeerDistances = std::vector<std::optional<float>>;

/// A method has a file of its own, peer_<name>.cpp.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  virtual std::string name() const = 0;
  /// What its answer lacks beside that of brute_force, for the table; empty if nothing.
  virtual std::string lacks() const = 0;
  /// How many may work for it.
  virtual int threads() const { return 1; }
  /// Whether others than its one thread work for it, so that only the clock on the wall shows its
  /// time.
  virtual bool has_company() const { return threads() > 1; }
  /// What can be made ready before any frame comes; not timed.
  virtual void load(const BenchScene&) {}
  /// Before each run; not timed.
  virtual void begin() {}
  /// What has to be made anew for each obstacle image; timed.
  virtual void prepare(const BenchScene& scene) = 0;
  /// All links; timed. `scene` is the one of the last prepare().
  virtual void evaluate(const BenchScene& scene, PeerDistances& distances_m) = 0;
  /// How much the truth may lie below the distances of the last evaluate(), of all links the most,
  /// as the method itself certifies; nothing for one that does not.
  virtual std::optional<double> known_to_m() const { return std::nullopt; }
};

/// berth's exact method on one thread, without an answer to begin from.
std::unique_ptr<Peer> make_berth_exact();
/// The same with AVX2 at most (absent where that is no restriction), from the answer before, on two
/// threads, and allowed to end early.
std::vector<std::unique_ptr<Peer>> make_berth_variants();
std::unique_ptr<Peer> make_brute_force();
std::unique_ptr<Peer> make_nanoflann();
std::unique_ptr<Peer> make_embree();
std::unique_ptr<Peer> make_fcl_octomap(double resolution_m);

/// Reads the three images and answers nothing: the least time of whoever looks at every pixel.
std::unique_ptr<Peer> make_reader();

/// The methods that run on OpenGL, in the current context; from images in memory to the answer,
/// upload and read-back included.
std::vector<std::unique_ptr<Peer>> make_gl_peers();

}  // namespace berth::lab
