#pragma once

#include <memory>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The camera itself. Throws std::invalid_argument where its size or focal lengths are not positive
/// and finite, or its principal point is not finite.
const Camera& checked(const Camera& camera);

/// Throws std::invalid_argument where the camera's pose is not finite.
void require_finite(const Pose& X_BC);

/// The robot's triangles, ready to be drawn: built once, then constant, shared by all renderers and
/// threads.
class LinkMeshes;
/// Which links are drawn. Those without geometry show nothing.
enum class DrawnLinks {
  all,          ///< but ignored ones
  environment,  ///< those of the role environment alone
};
bool is_drawn(const Link& link, DrawnLinks drawn);
std::shared_ptr<const LinkMeshes> build_link_meshes(const RobotModel& model,
                                                    DrawnLinks drawn = DrawnLinks::all);

/// Renders one robot into one camera. Each thread that renders has its own.
class RobotRenderer {
 public:
  /// Throws std::invalid_argument where the camera's size or focal lengths are not positive and
  /// finite.
  RobotRenderer(std::shared_ptr<const LinkMeshes> meshes, const Camera& camera);
  ~RobotRenderer();
  RobotRenderer(RobotRenderer&&) noexcept;
  RobotRenderer& operator=(RobotRenderer&&) noexcept;

  /// Writes R and I (Hirt 2.2.1) to `image`, whose memory it reuses: at each pixel's centre the
  /// nearest triangle; of two links at the same depth the smaller id. `pose` holds all of the
  /// model's links; X_BC is the pose of the camera's optical frame in the root link's frame. What
  /// has z > 0 is drawn. Outlines are right within 0.01 px. On entry `image.extent` has to hold all
  /// robot pixels of `image`, since nothing is cleared outside of it. The image depends neither on
  /// the number of threads (TBB's) nor on the instruction set. Throws std::invalid_argument if X_BC
  /// is not finite, and then leaves `image` as it was.
  void render(const RobotPose& pose, const Pose& X_BC, RobotImage& image);

  /// The same of what lies behind what `first` shows, by more than rounding: the next surface of
  /// each ray, where it leaves a body that is solid. Nothing where `first` shows nothing, which has
  /// the camera's size.
  void render_behind(const RobotPose& pose, const Pose& X_BC, const RobotImage& first,
                     RobotImage& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth
