#include "sim/contact_check.hpp"

#include <algorithm>

namespace berth::sim {
namespace {

/// FCL is asked at once where the least distance falls by more than this.
constexpr double kFall_m = 0.02;

}  // namespace

void ContactCheck::add(ContactSample sample) {
  const double at_least_m = clearance_.at_least(sample.pose, sample.X_BP);
  if (sample.fastest_m_s < kMoving_m_s) {
    next_s_ = sample.time_s + std::max(0.0, at_least_m) / fastest_m_s_;
    if (at_least_m > 0 || has_touched_) return;
    has_touched_ = clearance_.at(sample.pose, sample.X_BP) <= 0;
    return;
  }
  if (at_least_m < least_moving_m_ - kFall_m) measure(sample);
  const double room_m = at_least_m - std::max(0.0, least_moving_m_);
  next_s_ = sample.time_s + std::max(0.0, room_m) / fastest_m_s_;
  if (room_m < 0) open_.push_back({at_least_m, std::move(sample)});
}

void ContactCheck::measure(const ContactSample& sample) {
  const double clearance_m = clearance_.at(sample.pose, sample.X_BP);
  least_moving_m_ = std::min(least_moving_m_, clearance_m);
  if (clearance_m > 0) return;
  has_touched_ = true;
  contact_m_s_ = std::max(contact_m_s_, sample.fastest_m_s);
}

void ContactCheck::finish() {
  std::ranges::sort(open_, {}, &Open::at_least_m);
  for (const Open& open : open_) {
    if (open.at_least_m >= least_moving_m_ || least_moving_m_ <= 0) break;
    measure(open.sample);
  }
  // Where they met, the fastest counts.
  const auto faster = [](const Open& a, const Open& b) {
    return a.sample.fastest_m_s > b.sample.fastest_m_s;
  };
  std::ranges::sort(open_, faster);
  for (const Open& open : open_) {
    if (least_moving_m_ > 0 || open.sample.fastest_m_s <= contact_m_s_) break;
    if (open.at_least_m <= 0) measure(open.sample);
  }
  open_.clear();
}

}  // namespace berth::sim
