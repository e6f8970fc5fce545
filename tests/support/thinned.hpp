#pragma once

namespace berth {

/// How many of `count` random cases a test runs: all, or a tenth under a sanitizer, which makes
/// them ten times as slow.
template <class Count>
constexpr Count thinned(Count count) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return (count + 9) / 10;
#else
  return count;
#endif
}

}  // namespace berth
