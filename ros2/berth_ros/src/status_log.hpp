#pragma once

#include <map>
#include <rclcpp/logger.hpp>
#include <string>

namespace berth_ros {

/// Writes what is lost, and that it is back, into the log: a line for each change, and for one
/// cause at most one in kQuiet_s. What changed meanwhile is counted in the next line.
class StatusLog {
 public:
  static constexpr double kQuiet_s = 10;

  /// Of the steady clock that it is told by.
  static double now_s();

  /// An input that is missing at first is reported only once it has been missing for `grace_s`.
  StatusLog(rclcpp::Logger logger, double now_s, double grace_s = 2)
      : logger_(std::move(logger)), begin_s_(now_s + grace_s) {}

  /// How a cause stands at this time of a steady clock, to be called again and again; `trouble` is
  /// empty where all is well. With `repeats`, what stays lost is told each kQuiet_s.
  void tell(const std::string& cause, const std::string& trouble, double now_s,
            bool repeats = false);

 private:
  struct Cause {
    std::string trouble;
    bool is_lost = false;
    bool was_told_lost = false;
    double lost_s = 0;
    double back_s = 0;
    double quiet_until_s = 0;
    /// Since the last line.
    int losses = 0;
  };

  void change(const std::string& trouble, double now_s, Cause& cause) const;
  void write(const std::string& name, Cause& cause) const;

  rclcpp::Logger logger_;
  double begin_s_;
  std::map<std::string, Cause> causes_;
};

}  // namespace berth_ros
