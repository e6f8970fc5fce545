#include "berth/files/edit_distance.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace berth {

int edit_distance(std::string_view a, std::string_view b) {
  // row[j] is the distance of a's first i characters and b's first j.
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(),
                           [word](std::string_view left, std::string_view right) {
                             return edit_distance(word, left) < edit_distance(word, right);
                           });
}

}  // namespace berth
