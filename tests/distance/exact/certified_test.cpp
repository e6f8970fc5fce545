// What `exact` promises where it may end before it knows the answer: a bound below the true
// distance and a pair above it.
#include <gtest/gtest.h>

#include <cmath>

#include "berth/distance/brute_force.hpp"
#include "berth/distance/exact/exact.hpp"
#include "tests/support/random_images.hpp"
#include "tests/support/thinned.hpp"
#include "tests/distance/exact/smooth_images.hpp"
