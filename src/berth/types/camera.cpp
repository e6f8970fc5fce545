#include "berth/types/camera.hpp"

#include <limits>

namespace berth {

Pose unset_pose() {
  Pose X = Pose::Identity();
  X.matrix().topRows<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  return X;
}

}  // namespace berth
