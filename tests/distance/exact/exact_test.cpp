// What `exact` promises beyond the answer that all methods have in common.
#include "berth/distance/exact/exact.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "berth/distance/brute_force.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/random_images.hpp"
#include "tests/support/thinned.hpp"
#include "tests/distance/exact/smooth_images.hpp"
