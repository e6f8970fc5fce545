// The bundled scene's cameras, prepared and not.
#pragma once

#include "berth/pipeline/prepared_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/flying_pixels.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {

using SharedFrames = std::vector<std::shared_ptr<const Frame>>;

inline constexpr float kDefaultTolerance_m = 0.00101F;
/// What cubes of 0.1 mm may leave undecided.
inline constexpr float kUndecidedByCubes_m = 0.0004F;

inline void expect_same(const SpacePair& a, const SpacePair& b) {
  ASSERT_EQ(a.is_known(), b.is_known());
  // A result that is withheld has none.
  ASSERT_EQ(std::isnan(a.lower_bound_m), std::isnan(b.lower_bound_m));
  if (std::isnan(a.lower_bound_m)) return;
  EXPECT_NEAR(a.lower_bound_m, b.lower_bound_m, kDefaultTolerance_m + kUndecidedByCubes_m);
  if (!a.is_known()) return;
  EXPECT_LE(a.lower_bound_m, b.distance_m);
  EXPECT_LE(b.lower_bound_m, a.distance_m);
  EXPECT_LE(a.distance_m - a.lower_bound_m, kDefaultTolerance_m + kUndecidedByCubes_m);
}

/// Both tell the same, but for what is within the tolerance.
inline void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.time.status, b.time.status);
  EXPECT_EQ(std::isnan(a.stamp_s), std::isnan(b.stamp_s));
  if (!std::isnan(a.stamp_s)) {
    EXPECT_EQ(a.stamp_s, b.stamp_s);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t k = 0; k < a.cameras.size(); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(a.cameras[k].status, b.cameras[k].status);
    EXPECT_EQ(a.cameras[k].has_frame, b.cameras[k].has_frame);
    if (is_used(a.cameras[k].status)) {
      EXPECT_EQ(a.cameras[k].X_BC.matrix(), b.cameras[k].X_BC.matrix());
    }
  }
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    SCOPED_TRACE(a.links[i].link);
    EXPECT_EQ(a.links[i].status, b.links[i].status);
    expect_same(static_cast<const SpacePair&>(a.links[i]), b.links[i]);
    expect_same(a.links[i].occupied, b.links[i].occupied);
  }
}

/// The bundled scene's three cameras.
class PreparedScene : public ::testing::Test {
 protected:
  PreparedScene() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    const CameraSettings plain;
    for (const OpenCamera& camera : scene_.cameras) {
      cameras_.push_back(testing::mounted_with(*camera.mounted, plain));
    }
  }

  const std::shared_ptr<const Robot>& robot() const { return scene_.robot; }
  const JointState& joints(std::size_t i) const { return scene_.cameras[0].at_exposure[i]; }

  std::shared_ptr<Frame> observe(std::size_t k, std::size_t i,
                                 const PlaceAtExposure& place = {}) const {
    auto frame = std::make_shared<Frame>();
    const OpenCamera& camera = scene_.cameras[k];
    Observer(cameras_[k]).observe(camera.read_depth(i), camera.at_exposure[i], *frame, {}, place);
    return frame;
  }
  /// The first camera's frame i, and the others' first ones after that.
  SharedFrames observe_all(std::size_t i, const PlaceAtExposure& place = {}) const {
    SharedFrames frames;
    for (std::size_t k = 0; k < cameras_.size(); ++k)
      frames.push_back(observe(k, after(k, i), place));
    return frames;
  }
  std::size_t after(std::size_t k, std::size_t i) const {
    const auto& stamps_s = scene_.cameras[k].source.stamps_s;
    return std::ranges::lower_bound(stamps_s, scene_.cameras[0].source.stamps_s[i]) -
           stamps_s.begin();
  }
  std::shared_ptr<PreparedSpace> prepare(const SharedFrames& frames,
                                         const JointState* joints = nullptr) const {
    auto space = std::make_shared<PreparedSpace>(robot(), frames.size());
    space->prepare(frames, joints);
    return space;
  }
  /// A request about frames alone, with nothing known before.
  Result cold(const SharedFrames& frames, Request request) const {
    request.frames = frames;
    return Query(robot()).ask(request);
  }

  OpenScene scene_;
  std::vector<std::shared_ptr<const MountedCamera>> cameras_;
};

}  // namespace berth
