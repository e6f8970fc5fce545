// What each program does around its work, and how it ends.
#pragma once

#include <functional>

namespace berth::app {

/// Does the work with this number of threads (0: as many as there are processors), and gives the
/// exit status: 0, 1 where it could not be done, 130 where the user stopped it; both are said on
/// standard error, with the program's name.
int carry_out(const char* program_name, int threads, const std::function<void()>& work);

}  // namespace berth::app
