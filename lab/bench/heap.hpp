#pragma once

#include <malloc.h>

#include <cstdint>

namespace berth::lab {

/// Bytes that the program has allocated and not yet freed.
inline std::int64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

}  // namespace berth::lab
