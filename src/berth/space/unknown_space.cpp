#include "berth/space/unknown_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "berth/space/blocks.hpp"
#include "berth/space/serial_number.hpp"

namespace berth {
namespace {

/// Blocks that are kept; more of them are found anew each time.
constexpr std::uint32_t kMostBlocks = 1u << 15;
constexpr std::uint32_t kSlots = 2 * kMostBlocks;
/// The key of a slot that somebody is filling.
constexpr std::uint64_t kBusy = ~std::uint64_t{0};

std::uint32_t hash(std::uint64_t key) {
  return static_cast<std::uint32_t>((key * 0x9E3779B97F4A7C15u) >> 40) % kSlots;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

/// Whether it lies in the image of a view that may free something.
bool is_observed(std::span<const FreeingCamera> views, const Eigen::Vector3d& p_B) {
  return std::ranges::any_of(views, [&](const FreeingCamera& view) {
    return view.free_depth && pixel_of(view.space->camera, view.X_CB * p_B);
  });
}

}  // namespace

bool is_seen_free(const FreeingCamera& view, const Eigen::Vector3d& p_B) {
  if (view.free_depth == nullptr) return false;
  const Eigen::Vector3d p_C = view.X_CB * p_B;
  const auto pixel = pixel_of(view.space->camera, p_C);
  return pixel && p_C.z() < in_metres((*view.free_depth)(pixel->u, pixel->v));
}

UnknownSpace::UnknownSpace() : slots_(kSlots), used_(kMostBlocks) {}

void UnknownSpace::age(const PosedSpace& posed, DepthWindows& aged) {
  const CameraSpace& space = *posed.space;
  age_free_depth(space.camera, space.sensor_depth, space.own_free_depth,
                 space.has_environment ? &space.environment_front.left : nullptr,
                 space.settings.obstacle_speed_m_s * posed.age_s, aging_, aged);
  build_depth_windows(aged);
}

void UnknownSpace::assign(std::span<const PosedSpace> views, const UnknownSpace* aged,
                          std::span<const GuardedBox> guarded) {
  require(views.size() <= kMostViews, "more than 64 views, expected at most 64");
  for (const PosedSpace& view : views) {
    require(view.age_s >= 0, "age_s of a view, expected a number of at least 0");
    require(view.X_BC.matrix().allFinite(), "X_BC of a view, expected a pose of finite numbers");
  }
  const std::uint32_t used = std::min(used_count_.load(), kMostBlocks);
  for (std::uint32_t i = 0; i < used; ++i) slots_[used_[i]].key.store(0);
  used_count_.store(0);

  serial_number_ = mesh::next_serial_number();
  views_.clear();
  hides_unobserved_ = std::ranges::any_of(views, [](const PosedSpace& view) {
    return view.space->settings.unobserved == Unobserved::unknown;
  });
  guarded_.assign(guarded.begin(), guarded.end());
  aged_.resize(std::max(aged_.size(), views.size()));
  for (std::size_t k = 0; k < views.size(); ++k) {
    const CameraSpace& space = *views[k].space;
    const double age_s = views[k].age_s;
    FreeingCamera view{&space, views[k].X_BC, views[k].X_BC.inverse(), age_s, nullptr};
    const FreeingCamera* const same = aged ? aged->find_aged(space, age_s) : nullptr;
    if (!space.has_free_depth || age_s > kMostFreeingAge_s) {
      // Frees nothing.
    } else if (age_s == 0 || views.size() < 2) {
      view.free_depth = &space.free_depth;
    } else if (same) {
      view.free_depth = same->free_depth;
    } else {
      age(views[k], aged_[k]);
      view.free_depth = &aged_[k];
    }
    views_.push_back(view);
  }
  if (views_.size() == 1 && is_shadow()) build_shadow();
}

void UnknownSpace::build_shadow() {
  shadow_view_ = views_[0];
  const CameraSpace& space = *views_[0].space;
  if (!space.hides_without_reading) return;
  const Camera& camera = shadow_.camera = space.camera;
  shadow_.settings = space.settings;
  if (shadow_depth_m_.width() != camera.width_px || shadow_depth_m_.height() != camera.height_px) {
    shadow_depth_m_.resize(camera.width_px, camera.height_px, kNoDepth);
  }
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const float reading_m = space.obstacle_depth_m(u, v);
      const DepthUnits from = space.hidden_depth(u, v);
      const float hides_m = from == kEndlessUnits ? kNoDepth : in_metres(from);
      // A `hole` may hide from before the reading on that is kept in its place.
      shadow_depth_m_(u, v) = std::fmin(hides_m, reading_m);
    }
  }
  shadow_.obstacle_depth_m = shadow_depth_m_;
  build_depth_cells(shadow_depth_m_, shadow_.cells);
  shadow_view_.space = &shadow_;
}

const FreeingCamera* UnknownSpace::find_aged(const CameraSpace& space, double age_s) const {
  if (views_.size() < 2) return nullptr;
  const auto same = std::ranges::find_if(views_, [&](const FreeingCamera& view) {
    return view.space == &space && view.age_s == age_s && view.free_depth;
  });
  return same == views_.end() ? nullptr : &*same;
}

std::optional<HidingPixel> UnknownSpace::hiding_pixel(const Eigen::Vector3d& p_B) const {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const CameraSpace& space = *views_[k].space;
    const Eigen::Vector3d p_C = views_[k].X_CB * p_B;
    const auto pixel = pixel_of(space.camera, p_C);
    // One that was made for readings alone hides nothing.
    if (!pixel || !space.has_free_depth) continue;
    if (!(p_C.z() > in_metres(space.hidden_depth(pixel->u, pixel->v)))) continue;
    const PixelRect rect{pixel->u, pixel->v, pixel->u + 1, pixel->v + 1};
    if (space.has_environment && p_C.z() >= greatest_of_m(space.environment_front, rect)) continue;
    bool is_free = false;
    for (std::size_t j = 0; j < views_.size() && !is_free; ++j) {
      is_free = j != k && is_seen_free(views_[j], p_B);
    }
    if (!is_free) return HidingPixel{static_cast<int>(k), *pixel};
  }
  if (!hides_unobserved_ || views_.empty() || is_observed(views_, p_B)) return std::nullopt;
  if (is_guarded(guarded_, p_B)) return std::nullopt;
  return HidingPixel{0, {-1, -1}};
}

std::uint64_t UnknownSpace::find_block(const mesh::Cube& cube) const {
  std::uint64_t block = mesh::find_block(views_, cube);
  if (hides_unobserved_) block |= mesh::find_unobserved(views_, guarded_, cube);
  return block;
}

std::uint64_t UnknownSpace::block(const mesh::Cube& cube) const {
  constexpr int kMostProbes = 32;
  const std::uint64_t key = cube.key();
  std::uint32_t place = hash(key);
  Slot* slot = nullptr;
  for (int probe = 0; probe < kMostProbes; ++probe, place = (place + 1) % kSlots) {
    const std::uint64_t found = slots_[place].key.load(std::memory_order_acquire);
    if (found == key) return slots_[place].possible.load(std::memory_order_relaxed);
    if (found != 0) continue;
    slot = &slots_[place];
    break;
  }
  const std::uint64_t block = find_block(cube);
  std::uint64_t expected = 0;
  if (slot == nullptr || used_count_.load(std::memory_order_relaxed) >= kMostBlocks ||
      !slot->key.compare_exchange_strong(expected, kBusy)) {
    return block;
  }
  const std::uint32_t number = used_count_.fetch_add(1);
  if (number >= kMostBlocks) {
    slot->key.store(0);
    return block;
  }
  used_[number] = place;
  slot->possible.store(block, std::memory_order_relaxed);
  slot->key.store(key, std::memory_order_release);
  return block;
}

std::size_t UnknownSpace::kept_blocks() const { return std::min(used_count_.load(), kMostBlocks); }

namespace {

/// Whether all readings around the point's pixel lie behind it.
bool sees_through(const FreeingCamera& view, const Eigen::Vector3d& p_B_m) {
  const CameraSpace& space = *view.space;
  const Eigen::Vector3d p_C_m = view.X_CB * p_B_m;
  const auto pixel = pixel_of(space.camera, p_C_m);
  if (!view.free_depth || !pixel) return false;
  const PixelRect around = clip({pixel->u - 1, pixel->v - 1, pixel->u + 2, pixel->v + 2},
                                space.camera.width_px, space.camera.height_px);
  DepthUnits least = kEndlessUnits;
  for (int v = around.v_begin; v < around.v_end; ++v) {
    const DepthUnits* const row = space.sensor_depth.row(v);
    least = std::min(least, *std::min_element(row + around.u_begin, row + around.u_end));
  }
  // Without a reading nothing was seen.
  if (least == kEndlessUnits) return false;
  const double moved_m = space.settings.obstacle_speed_m_s * view.age_s;
  return p_C_m.z() < in_metres(least) - space.settings.free_space_margin_m - moved_m;
}

}  // namespace

bool find_undecided(std::span<const FreeingCamera> views, std::size_t k,
                    const Image<PixelFate>& fate, DepthImage& out_m) {
  const FreeingCamera& view = views[k];
  const Camera& camera = view.space->camera;
  out_m.resize(camera.width_px, camera.height_px, kNoDepth);
  bool has_any = false;
  for (int v = 0; v < camera.height_px; ++v) {
    const PixelFate* const row = fate.row(v);
    // Most rows have none.
    constexpr auto kPatch = static_cast<int>(PixelFate::flying_patch);
    if (std::memchr(row, kPatch, static_cast<std::size_t>(camera.width_px)) == nullptr) continue;
    for (int u = 0; u < camera.width_px; ++u) {
      if (row[u] != PixelFate::flying_patch) continue;
      const double z_m = in_metres(view.space->sensor_depth(u, v));
      const Eigen::Vector3d p_B_m =
          view.X_BC * Eigen::Vector3d(z_m * (u - camera.cx_px) / camera.fx_px,
                                      z_m * (v - camera.cy_px) / camera.fy_px, z_m);
      bool is_freed = false, is_seen = false;
      for (std::size_t j = 0; j < views.size() && !is_seen; ++j) {
        if (j == k) continue;
        is_seen = sees_through(views[j], p_B_m);
        is_freed = is_freed || is_seen_free(views[j], p_B_m);
      }
      if (is_seen || !is_freed) continue;
      out_m(u, v) = static_cast<float>(z_m);
      has_any = true;
    }
  }
  return has_any;
}

}  // namespace berth
