#pragma once

#include "thesis/exact/exact.hpp"
#include "thesis/lattice/lattice.hpp"
#include "thesis/mean_direction/mean_direction.hpp"
#include "thesis/method.hpp"

namespace berth {

/// The memory of evaluate(), made once and used for every request; one for each thread. It carries
/// nothing from one answer to the next.
struct EvaluateWorkspace {
  ExactWorkspace exact;
  LatticeWorkspace lattice;
  DirectionWorkspace directions;
};

/// For each link the closest pair by one method and, if the settings ask for it, the mean
/// direction.
///
/// Throws std::invalid_argument for bad settings, and unless the method compares images on the
/// processor.
void evaluate(Method method, const ImageRequest& request, EvaluateWorkspace& workspace,
              LinkDistances& out);

}  // namespace berth
