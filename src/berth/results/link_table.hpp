// Inside berth only: tables of links for people.
#pragma once

#include <string>
#include <vector>

#include "berth/pipeline/result.hpp"

namespace berth {

/// A heading, and a line for each link: its name, its status, and columns of numbers.
class LinkTable {
 public:
  using Cells = std::vector<std::string>;

  explicit LinkTable(const Cells& heading);
  void add(const LinkResult& link, const Cells& cells);
  /// Columns are aligned.
  std::string text() const;

 private:
  std::vector<Cells> lines_;
};

/// The numbers of a result's links; those that no joint moves come last: they stand on their table,
/// as near as they always do.
std::vector<std::size_t> moved_first(const Result& result);

/// Such as "0.1234", "0.1230 to 0.1234", "0.9990 or more" or "-"; without bounds the distance
/// alone.
std::string distance_text(const LinkResult& link, bool has_bounds);

std::string pixel_text(Pixel pixel);

}  // namespace berth
