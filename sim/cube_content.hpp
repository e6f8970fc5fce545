// What a cube of space may hold of the obstacles that several cameras left.
#pragma once

#include <vector>

#include "sim/whole_robot_points.hpp"

namespace berth::sim {

/// Along the axes of the frame B.
struct CentredCube {
  Eigen::Vector3d centre_B;
  double half_m;
};

/// Which points count.
enum class Wanted { reading, obstacle };

enum class Content {
  none,  ///< no point of the cube counts
  some,  ///< nobody knows, or some do
  all,   ///< each point of the cube counts
};

/// Looks at every pixel that a cube projects into.
class CubeContent {
 public:
  /// `space` is kept, not copied.
  explicit CubeContent(const PointSpace& space);
  Content operator()(const CentredCube& cube, Wanted wanted) const;

 private:
  /// What the pixels of one view say of a cube.
  struct Seen {
    bool may_read = false;
    bool may_hide = false;
    bool may_free = false;
    /// Each point is in a surface layer; behind the front of one; seen free.
    bool all_read = false;
    bool all_covered = false;
    bool all_free = false;
    /// In the image of a young view, or outside of it.
    bool is_inside = false;
    bool is_outside = false;
  };
  Seen look(std::size_t k, const CentredCube& cube) const;

  const PointSpace& space_;
  std::vector<Pose> X_CB_;
};

}  // namespace berth::sim
