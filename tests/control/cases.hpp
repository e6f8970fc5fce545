#pragma once

#include <cstdlib>
#include <string_view>

#include "tests/support/thinned.hpp"

namespace berth {

/// A hundredth of so many cases, unless BERTH_CONTROL_TWIN=full is in the environment.
inline int cases(int full) {
  const char* const set = std::getenv("BERTH_CONTROL_TWIN");
  return set && set == std::string_view("full") ? full : thinned(full / 100);
}

}  // namespace berth
