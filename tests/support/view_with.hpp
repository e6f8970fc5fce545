// A view once more, with other settings.
#pragma once

#include <memory>

#include "berth/pipeline/view.hpp"

namespace berth::testing {

inline std::shared_ptr<const View> view_with(const View& view, const ViewSettings& settings) {
  return std::make_shared<const View>(view.robot(), view.mount(), settings);
}

/// Of a robot of its own.
inline std::shared_ptr<const View> view_with(const View& view, const EvaluationSettings& evaluation,
                                             const ViewSettings& settings) {
  return std::make_shared<const View>(
      std::make_shared<const Robot>(view.robot()->model(), evaluation), view.mount(), settings);
}

/// How questions are answered that compare images.
inline EvaluationSettings exact_evaluation() {
  EvaluationSettings settings;
  settings.method = Method::exact;
  return settings;
}

}  // namespace berth::testing
