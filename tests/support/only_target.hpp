#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace berth {

/// Makes the vector code use this one of hwy::SupportedTargets() until the end of the scope.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { use(target); }
  ~OnlyTarget() { use(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

/// Calls action(name) with each instruction set that this machine has.
template <class Action>
void on_every_target(Action action) {
  std::int64_t targets = hwy::SupportedTargets();
  for (; targets != 0; targets &= targets - 1) {
    const std::int64_t target = targets & -targets;
    const OnlyTarget only(target);
    action(hwy::TargetName(target));
  }
}

}  // namespace berth
