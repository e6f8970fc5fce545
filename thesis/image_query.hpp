#pragma once

#include <memory>
#include <optional>

#include "berth/pipeline/request.hpp"
#include "berth/pipeline/robot.hpp"
#include "thesis/image_result.hpp"

namespace berth {

class ImageMethod;

/// Requests about one camera's images, as the thesis asks them: an image of the robot against one
/// of what may be an obstacle (Hirt 2). Query asks the whole robot instead. One for each thread.
class ImageQuery {
 public:
  /// `method` runs `named`. Throws std::invalid_argument for bad settings.
  ImageQuery(std::shared_ptr<const Robot> robot, Method named, const ImageSettings& settings,
             std::unique_ptr<ImageMethod> method);
  /// A method on the processor. Throws std::invalid_argument for another one.
  ImageQuery(std::shared_ptr<const Robot> robot, Method method, const ImageSettings& settings = {});
  ~ImageQuery();
  ImageQuery(ImageQuery&&) noexcept;
  ImageQuery& operator=(ImageQuery&&) noexcept;

  /// Builds what requests search of this frame, so that the first of them needs not. The frame
  /// stays as it is while it is asked.
  void prepare(const Frame& frame);

  /// The robot as it stood at the exposure, or at other joint angles: then its image is rendered
  /// anew. Ages as for Query. Valid until the next request. Throws std::invalid_argument for wrong
  /// joints, and for a JointBuffer without a time.
  const ImageResult& ask(const Frame& frame, const RequestedJoints& joints = {},
                         std::optional<double> now_s = {});

  /// The robot of the last request at other joint angles.
  const RobotImage& robot_image() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
