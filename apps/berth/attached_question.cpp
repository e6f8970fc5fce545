#include "apps/berth/attached_question.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "apps/support/interrupt.hpp"
#include "berth/reports/calibration_words.hpp"

namespace berth::app {
namespace {

bool ask(const AttachedPart& part) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return false;
  fmt::print(stderr, "{}\nIs it a part of the robot, and always there? [y/N] ",
             attached_text(part));
  std::string answer;
  std::getline(std::cin, answer);
  stop_if_interrupted();
  return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace

std::function<bool(const AttachedPart&, const CalibrationResult&)> attached_question(
    AttachedChoice choice, const ProgressBar& progress) {
  return [choice, &progress](const AttachedPart& part, const CalibrationResult&) {
    if (choice != AttachedChoice::ask) return choice == AttachedChoice::yes;
    progress.clear();
    return ask(part);
  };
}

}  // namespace berth::app
