// Inside pipeline/ only: pairs of a link beside its nearest one.
#pragma once

#include <memory>
#include <vector>

#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"

namespace berth {

/// One for each thread.
class CandidateSearch {
 public:
  explicit CandidateSearch(std::shared_ptr<const Robot> robot);

  /// Searches each eighth of each link, for tell() and for a copy that goes on from here.
  void search(const FrameSet& frames, const RobotPose& pose, MeshRequest request);
  /// Writes LinkResult::candidates, after search(); the links have their own pairs.
  void tell(const FrameSet& frames, Result& out);
  /// As Query::forget().
  void forget();

 private:
  std::shared_ptr<const Robot> robot_;
  MeshWorkspace workspace_;
  std::vector<WholeLinkDistance> found_;
  /// The place in Result::links of each eighth's link.
  std::vector<std::size_t> places_;
  /// The eighths, nearest first.
  std::vector<std::size_t> order_;
};

}  // namespace berth
