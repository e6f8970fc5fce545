#pragma once

#include <string_view>
#include <vector>

namespace berth {

/// The least number of characters to insert, drop or replace that makes `a` of `b` (Levenshtein).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance to `word`, the first of equals. There must be one at
/// least.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace berth
