#pragma once

#include <limits>
#include <memory>

#include "berth/pipeline/exposure.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct FrameSpace;

/// What one depth image reports, ready for any number of requests; constant while it is asked.
struct Frame : Exposure {
  Frame();
  ~Frame();
  Frame(Frame&&) noexcept;
  Frame& operator=(Frame&&) noexcept;

  /// The robot at that time.
  RobotImage robot;
  ObstacleImage obstacles;
  /// Never null but in a frame that was moved from.
  std::unique_ptr<FrameSpace> space;
  /// Whether a smaller share than kLeastReadOfImage of the sensor's pixels has a reading: a camera
  /// that is covered, or failed.
  bool is_blind = false;
  /// Whether the camera knows where it can read, or has been told what it means where it does not:
  /// else nobody reports what gives no reading, such as black clothes.
  bool tells_unread = false;
  /// The share of the image's pixels that have no reading where the empty cell has one; where the
  /// camera does not know it, of all that have none and do not show the robot. NaN without an
  /// image.
  double unread_share = std::numeric_limits<double>::quiet_NaN();
};

/// Of an image's pixels. One whose range is short, or who stands outdoors, still reads many more.
inline constexpr double kLeastReadOfImage = 0.01;

/// Empties the images of a frame whose time is not ok, so that no older image stays under the new
/// stamp.
void clear_images(const Camera& camera, Frame& frame);

}  // namespace berth
