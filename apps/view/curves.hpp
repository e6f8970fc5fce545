#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/page_message.hpp"
#include "berth/pipeline/result.hpp"

namespace berth::app {

/// The curves of each link over time, and how fast the robot may go where that is monitored, of
/// the last results.
class Curves {
 public:
  /// Of `most` results no more are kept; `total` is how many there will be, 0: nobody knows.
  Curves(std::size_t most, std::size_t total) : most_(most), total_(total) {}

  void add(const Result& result);
  /// A sentence for the user; nothing where it is empty.
  void warn(const std::string& text);

  PageMessage message(const std::string& error = "") const;

 private:
  struct LinkPoint {
    float distance_m;
    LinkStatus status;
    bool is_rejected;
  };
  struct Speed {
    double scale;
    SeparationState state;
  };
  struct Column {
    double stamp_s;
    std::vector<LinkPoint> links;
    /// Result::nearest.
    int nearest;
    std::optional<Speed> speed;
  };

  std::size_t most_;
  std::size_t total_;
  std::vector<std::string> warnings_;
  std::deque<Column> columns_;
};

}  // namespace berth::app
