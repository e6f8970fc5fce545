// The options for how distances are found.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "berth/scene/scene_evaluation.hpp"

namespace CLI {
class App;
}

namespace berth::app {

/// What the command line says about the evaluation; what it does not say is left to the scene file
/// or, without one, to the defaults.
struct EvaluationArguments {
  std::optional<std::string> method;
  /// Of `run` alone: three images without meshes and fates cannot tell.
  std::optional<bool> visibility;
  /// Settings of DistanceSettings and ImageSettings by name, as they were written.
  std::map<std::string, std::string, std::less<>> given;

  /// All throw std::invalid_argument for values outside their domain, and for those that the method
  /// does not have.
  ImageDistanceSettings settings_over(ImageDistanceSettings settings, Method method_used) const;
  Method method_over(Method otherwise) const;
  SceneEvaluation over(SceneEvaluation settings) const;
};

/// Three images without meshes cannot be asked by method mesh. Where they can, the help leaves out
/// what belongs to the other methods alone.
void add_evaluation(CLI::App& command, bool has_mesh, EvaluationArguments& arguments);
void add_visibility(CLI::App& command, EvaluationArguments& arguments);

}  // namespace berth::app
