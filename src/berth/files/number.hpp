#pragma once

#include <optional>
#include <string_view>

namespace berth {

/// The text as a finite number, with a point for decimals whatever the locale is; none where any
/// part of the text is something else, or the number is NaN, infinite or too large for a double.
std::optional<double> parse_finite(std::string_view text);

/// The same for whole numbers.
std::optional<int> parse_integer(std::string_view text);

}  // namespace berth
