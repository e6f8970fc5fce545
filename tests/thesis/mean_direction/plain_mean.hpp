#pragma once

#include "tests/thesis/answer.hpp"

namespace berth::testing {

/// The answer of exact with its mean directions.
LinkDistances with_mean(const sim::ImagePair& images, double range_m);

struct PlainMean {
  Eigen::Vector3d direction_C = Eigen::Vector3d::Zero();
  std::int64_t count = 0;
};

/// Section 6 of the definition, pixel by pixel in double: the slow twin of fill_mean_directions().
PlainMean plain_mean(const sim::ImagePair& images, Pixel robot_pixel, double range_m);

/// Fails the test unless every link has the plain count, and a mean direction within max_error.
/// Returns how many links have one.
int expect_plain_means(const sim::ImagePair& images, double range_m,
                       double max_error = kMeanDirectionError);

}  // namespace berth::testing
