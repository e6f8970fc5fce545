#pragma once

#include <cstdint>
#include <string>

namespace berth::lab {

/// Keeps berth's vector code from using instruction sets beyond `target` (a bit of Highway) until
/// the end of the scope.
class InstructionSetLimit {
 public:
  explicit InstructionSetLimit(std::int64_t target);
  ~InstructionSetLimit();
  InstructionSetLimit(const InstructionSetLimit&) = delete;
  InstructionSetLimit& operator=(const InstructionSetLimit&) = delete;
};

/// The best one that this machine has, by Highway's name: "AVX3" is AVX-512.
std::string best_instruction_set();
bool has_more_than_avx2();

}  // namespace berth::lab
