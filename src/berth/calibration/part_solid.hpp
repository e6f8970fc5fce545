// Inside calibration/ only: from the cells of a surface to the body behind it.
#pragma once

#include "berth/calibration/carried_cells.hpp"
#include "berth/calibration/closed_surface.hpp"

namespace berth {

/// The piece with what belongs to it that was seen from one side only: readings of what moves
/// within kGrown_m of it. Surfaces that only hide something are closed by the hull of all these;
/// what was ever seen free is no part of it. Last come the cells within `hidden_m` of it that no
/// view looks into: there the thing may reach farther than it was seen.
SolidCells solid_of(const CarriedCells& piece, const std::vector<EvidenceView>& views,
                    const std::vector<MovingReading>& readings, double hidden_m);

/// Whether no view looks into the point of a link's frame.
bool is_hidden(const Eigen::Vector3d& p_L_m, std::size_t link,
               const std::vector<EvidenceView>& views);

inline constexpr double kGrown_m = 0.03;

}  // namespace berth
