#pragma once

namespace berth {

/// How many of `count` random cases a test runs: all, or a tenth where they are ten to a hundred
/// times as slow: under a sanitizer, with vector code for one lane (BERTH_SCALAR), in an emulator.
template <class Count>
constexpr Count thinned(Count count) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(BERTH_THINNED)
  return (count + 9) / 10;
#else
  return count;
#endif
}

}  // namespace berth
