#include "lab/measure/instruction_set.hpp"

#include <hwy/targets.h>

namespace berth::lab {
namespace {

/// 0: all that there are.
void use_targets(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Highway's lower bits are the better sets.
std::int64_t best_target() { return hwy::SupportedTargets() & -hwy::SupportedTargets(); }

}  // namespace

InstructionSetLimit::InstructionSetLimit(std::int64_t target) { use_targets(target); }
InstructionSetLimit::~InstructionSetLimit() { use_targets(0); }

std::string best_instruction_set() { return hwy::TargetName(best_target()); }

bool has_more_than_avx2() {
  return (hwy::SupportedTargets() & HWY_AVX2) != 0 && best_target() != HWY_AVX2;
}

}  // namespace berth::lab
