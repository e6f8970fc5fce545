#pragma once

#include <atomic>
#include <cstdint>

namespace berth::mesh {

/// A number that no call has returned before: what has the same one is the same.
inline std::uint64_t next_serial_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace berth::mesh
