// fill_mean_directions() against its slow twin, on every instruction set that this machine has.
#include <cmath>
#include <random>

#include "tests/support/only_target.hpp"
#include "tests/distance/mean_direction/plain_mean.hpp"
