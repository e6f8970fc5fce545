// Inside src/berth only.
#pragma once

namespace berth {

/// How many parts of size b hold a.
constexpr int divide_up(int a, int b) { return (a + b - 1) / b; }

}  // namespace berth
