#pragma once

#include <cstddef>

namespace berth {

/// Calls of operator new so far, by all threads: the library that holds this replaces it for the
/// whole program.
std::size_t allocation_count();
/// The same of the thread that asks.
std::size_t allocation_count_of_this_thread();

}  // namespace berth
