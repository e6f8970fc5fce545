#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "berth/space/aged_depth.hpp"
#include "berth/space/camera_space.hpp"
#include "berth/space/cubes.hpp"
#include "berth/space/free_depth.hpp"
#include "berth/types/guarded_box.hpp"

namespace berth {

/// A frame's space, and where its camera stood when it was exposed.
struct PosedSpace {
  const CameraSpace* space = nullptr;
  /// The pose of the optical frame C in the robot's root frame B.
  Pose X_BC = Pose::Identity();
  /// By how much the frame is older than the newest of the set.
  double age_s = 0;
};

/// A view with what its age leaves of its free space.
struct FreeingCamera {
  const CameraSpace* space = nullptr;
  Pose X_BC = Pose::Identity();
  Pose X_CB = Pose::Identity();
  double age_s = 0;
  /// E at this age; null where the view frees nothing.
  const DepthWindows* free_depth = nullptr;
};

/// Whether 0 < z < E (D3).
bool is_seen_free(const FreeingCamera& view, const Eigen::Vector3d& p_B);

/// The view that hides a point, and the pixel behind whose reading it lies; (-1, -1) where it lies
/// in no image.
struct HidingPixel {
  int view = -1;
  Pixel pixel;
};

/// Everything that the cameras left: all measured surfaces, and every point that one of them hides
/// and no other one sees free. Which parts of space are hidden is found where somebody asks, once,
/// and kept for all later requests, in bounded memory. Any number of threads may ask at a time.
class UnknownSpace {
 public:
  /// A view that is older than the newest one by more than this frees nothing.
  static constexpr double kMostFreeingAge_s = 0.2;
  static constexpr int kMostViews = 64;

  UnknownSpace();

  /// Begins anew with these views, which have to outlive it; reuses its memory. Nobody may ask
  /// meanwhile. An older view shrinks what it frees (age_free_depth), and frees nothing beyond
  /// kMostFreeingAge_s. `guarded` are never unobserved. Throws std::invalid_argument for more than
  /// kMostViews, an age below 0 or a pose that is not finite. A view that `aged` has at the same
  /// age is not aged again: `aged` has to outlive it then, unchanged.
  void assign(std::span<const PosedSpace> views, const UnknownSpace* aged = nullptr,
              std::span<const GuardedBox> guarded = {});

  std::span<const FreeingCamera> views() const { return views_; }

  /// Whether all that lies behind what hides is hidden, without an end: one camera sees it, and no
  /// other one frees anything. Then it can be searched for by pixels.
  bool is_shadow() const {
    return views_.empty() ||
           (views_.size() == 1 && !views_[0].space->has_environment && !hides_unobserved_);
  }
  /// The view, if it is_shadow(), as if each pixel that hides had a reading where it begins to.
  const FreeingCamera& shadow_view() const { return shadow_view_; }

  /// Another one after each assign(), and no other object's.
  std::uint64_t serial_number() const { return serial_number_; }

  /// The view that hides this point, if it is hidden: farther than H of its pixel in some view, and
  /// before environment's front there, and seen free by no other one (D5); or in no image and no
  /// guarded box, if SpaceSettings::unobserved says that this is unknown.
  std::optional<HidingPixel> hiding_pixel(const Eigen::Vector3d& p_B) const;

  /// Which of the 64 cubes that `cube`, of a level above 0, consists of may hold a hidden point:
  /// one bit each.
  std::uint64_t block(const mesh::Cube& cube) const;

  /// The same, not kept: for a caller that asks for more of them than are kept.
  std::uint64_t find_block(const mesh::Cube& cube) const;

  /// How many of them are kept.
  std::size_t kept_blocks() const;

 private:
  struct Slot {
    std::atomic<std::uint64_t> key{0};
    std::atomic<std::uint64_t> possible{0};
  };
  void build_shadow();
  void age(const PosedSpace& posed, DepthWindows& aged);
  const FreeingCamera* find_aged(const CameraSpace& space, double age_s) const;

  std::uint64_t serial_number_ = 0;
  std::vector<FreeingCamera> views_;
  FreeingCamera shadow_view_;
  CameraSpace shadow_;
  DepthImage shadow_depth_m_;
  bool hides_unobserved_ = false;
  std::vector<GuardedBox> guarded_;
  /// E of the views that have aged.
  std::vector<DepthWindows> aged_;
  AgingWorkspace aging_;
  /// A hash table with open addresses, and which of its slots are in use.
  mutable std::vector<Slot> slots_;
  mutable std::vector<std::uint32_t> used_;
  mutable std::atomic<std::uint32_t> used_count_{0};
};

/// Writes the readings of view k's flying patches that another view frees, and none sees through:
/// behind the robot and beside it a view frees what it does not see. NaN elsewhere. `fate` is that
/// of view k. Returns whether there are any.
bool find_undecided(std::span<const FreeingCamera> views, std::size_t k,
                    const Image<PixelFate>& fate, DepthImage& out_m);

}  // namespace berth
