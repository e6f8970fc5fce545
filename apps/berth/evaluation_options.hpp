// The options for how distances are found.
#pragma once

#include <map>
#include <string>

#include "berth/pipeline/robot.hpp"
#include "thesis/method.hpp"
#include "thesis/settings.hpp"

namespace CLI {
class App;
}

namespace berth::app {

/// What the command line says about the evaluation; what it does not say is left to the scene file
/// or, without one, to the defaults.
struct EvaluationArguments {
  /// Settings by name, as they were written.
  std::map<std::string, std::string, std::less<>> given;

  /// Both throw std::invalid_argument for values outside their domain, the second one also for
  /// those that the method does not have.
  EvaluationSettings over(EvaluationSettings settings) const;
  ImageDistanceSettings over(ImageDistanceSettings settings, Method method) const;
};

/// For `run`.
void add_evaluation(CLI::App& command, EvaluationArguments& arguments);

/// For `evaluate`: --method, and the settings of all methods.
void add_methods(CLI::App& command, Method& method, EvaluationArguments& arguments);

}  // namespace berth::app
