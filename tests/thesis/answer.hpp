#pragma once

#include <gtest/gtest.h>

#include "sim/random_images.hpp"
#include "tests/support/image_settings.hpp"
#include "thesis/evaluate.hpp"

namespace berth::testing {

/// The methods that find the closest pair; the others may take another one for it.
inline constexpr std::array kExactMethods = {Method::exact, Method::brute_force, Method::gl_exact};

/// Whether it is one of kExactMethods.
bool finds_the_closest(Method method);

/// A test of one method; it skips, visibly, where the method runs on OpenGL and there is none.
class MethodTest : public ::testing::TestWithParam<Method> {
 protected:
  void SetUp() override;
  void TearDown() override;
};

/// What may be used again for the next request.
struct AnswerWorkspace {
  SearchableDepth obstacles;
  EvaluateWorkspace evaluate;
};

/// The answer of a method, which replaces `out`; methods on OpenGL have their memory in
/// shared_gl().
void answer(Method method, const sim::ImagePair& images, DepthView obstacle_depth_m,
            const ImageDistanceSettings& settings, AnswerWorkspace& workspace, LinkDistances& out);
/// With a fresh tree and workspace.
LinkDistances answer(Method method, const sim::ImagePair& images,
                     const ImageDistanceSettings& settings);
/// Without mean directions.
LinkDistances answer(Method method, const sim::ImagePair& images, double range_m = 1.0);

/// Fails the test unless both answers have the same statuses and pixel counts, distances within
/// 1e-5 m (relative above 1 m), each distance is that of its own pair, and all else is unset.
void expect_same_answer(const LinkDistances& expected, const LinkDistances& actual,
                        const sim::ImagePair& images);

/// Fails the test unless the answer may be an approximation of the true one: the same pixel counts,
/// ok only where that is, no distance below the true one by more than 1e-5 m (relative above 1 m),
/// each distance that of its own pair, nothing certified, and all else unset.
void expect_possible_answer(const LinkDistances& truth, const LinkDistances& actual,
                            const sim::ImagePair& images);

/// Fails the test unless the answer is what the method promises beside brute force's.
void expect_answer_of(Method method, const LinkDistances& brute_force, const LinkDistances& actual,
                      const sim::ImagePair& images);

/// Fails the test unless the link has no distance at all.
void expect_no_distance(const LinkDistance& link);

/// Sets a robot pixel.
void put_robot(sim::ImagePair& images, int u, int v, float depth_m, LinkId link = 1);

/// Fills a rectangle of the obstacle image.
void put_obstacle(sim::ImagePair& images, PixelRect rect, float depth_m);

/// Names the tests of a suite that takes methods.
std::string method_test_name(const ::testing::TestParamInfo<Method>& info);

}  // namespace berth::testing
