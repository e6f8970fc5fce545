#include "status_log.hpp"

#include <chrono>
#include <rclcpp/logging.hpp>

namespace berth_ros {

double StatusLog::now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void StatusLog::change(const std::string& trouble, double now_s, Cause& cause) const {
  const bool is_lost = !trouble.empty();
  if (is_lost) cause.trouble = trouble;
  if (is_lost == cause.is_lost) return;
  cause.is_lost = is_lost;
  (is_lost ? cause.lost_s : cause.back_s) = now_s;
  // What comes within the grace was never lost.
  if (!is_lost && now_s < begin_s_) cause.losses = 0;
  cause.losses += is_lost;
}

void StatusLog::tell(const std::string& name, const std::string& trouble, double now_s,
                     bool repeats) {
  Cause& cause = causes_[name];
  change(trouble, now_s, cause);
  if (now_s < begin_s_ || now_s < cause.quiet_until_s) return;
  const bool has_news = cause.losses > 0 || cause.is_lost != cause.was_told_lost;
  if (!has_news && !(cause.is_lost && repeats)) return;
  write(name, cause);
  cause.was_told_lost = cause.is_lost;
  cause.losses = 0;
  cause.quiet_until_s = now_s + kQuiet_s;
}

void StatusLog::write(const std::string& name, Cause& cause) const {
  const std::string often =
      cause.losses > 1 ? "; lost " + std::to_string(cause.losses) + " times" : "";
  if (cause.is_lost) {
    RCLCPP_WARN(logger_, "%s: %s%s", name.c_str(), cause.trouble.c_str(), often.c_str());
    return;
  }
  // A loss that nobody has told yet.
  const std::string untold = cause.losses > 0 ? cause.trouble + "; " : "";
  RCLCPP_INFO(logger_, "%s: %sback after %.1f s%s", name.c_str(), untold.c_str(),
              cause.back_s - cause.lost_s, often.c_str());
}

}  // namespace berth_ros
