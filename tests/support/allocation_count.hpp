#pragma once

#include <cstddef>

namespace berth {

/// Calls of operator new so far, by all threads: the library that holds this replaces it for the
/// whole program.
std::size_t allocation_count();

}  // namespace berth
