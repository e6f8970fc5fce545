#include "thesis/image_query.hpp"

#include <optional>
#include <stdexcept>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/render/robot_renderer.hpp"
#include "thesis/image_method.hpp"
#include "thesis/image_result.hpp"

namespace berth {

struct ImageQuery::Parts {
  Parts(std::shared_ptr<const Robot> of, Method named, const ImageSettings& with,
        std::unique_ptr<ImageMethod> by)
      : robot(std::move(of)),
        settings(settings_of(*robot, with)),
        method(std::move(by)),
        result(empty_image_result(*robot, named, with)) {}

  RobotRenderer& renderer_of(const std::shared_ptr<const MountedCamera>& mounted);
  const ImageResult& evaluate(const Frame& frame, const RobotImage& asked);

  std::shared_ptr<const Robot> robot;
  ImageDistanceSettings settings;
  std::unique_ptr<ImageMethod> method;
  /// Of the camera that was asked last, made at the first request at other joint angles.
  std::optional<RobotRenderer> renderer;
  std::shared_ptr<const MountedCamera> rendered_view;
  RobotImage image;
  JointState newest;
  SearchableDepth searchable;
  /// Of which frame and exposure it is: one that is observed anew keeps its address.
  const Frame* prepared = nullptr;
  std::uint64_t prepared_number = 0;
  LinkDistances distances;
  ImageResult result;
};

ImageQuery::ImageQuery(std::shared_ptr<const Robot> robot, Method named,
                       const ImageSettings& settings, std::unique_ptr<ImageMethod> method)
    : parts_(std::make_unique<Parts>(std::move(robot), named, settings, std::move(method))) {}

ImageQuery::ImageQuery(std::shared_ptr<const Robot> robot, Method method,
                       const ImageSettings& settings)
    : ImageQuery(std::move(robot), method, settings, make_image_method(method)) {}

ImageQuery::~ImageQuery() = default;
ImageQuery::ImageQuery(ImageQuery&&) noexcept = default;
ImageQuery& ImageQuery::operator=(ImageQuery&&) noexcept = default;

const RobotImage& ImageQuery::robot_image() const { return parts_->image; }

void ImageQuery::prepare(const Frame& frame) {
  if (parts_->prepared == &frame && parts_->prepared_number == frame.number) return;
  parts_->searchable.build(frame.obstacles.depth_m);
  parts_->prepared = &frame;
  parts_->prepared_number = frame.number;
}

const ImageResult& ImageQuery::ask(const Frame& frame, const RequestedJoints& joints,
                                   std::optional<double> now_s) {
  TimeStatus joints_status = TimeStatus::ok;
  const JointState* state = joints.read(now_s, parts_->newest, joints_status);
  const std::optional<double> stamp_s = state ? std::optional(state->stamp_s) : std::nullopt;
  const CameraState camera =
      camera_state(&frame, now_s.value_or(frame.stamp_s), parts_->robot->settings().time);
  ImageResult& result = parts_->result;
  tell_fates(frame, result.cameras.front());
  if (!begin_image_result(*parts_->robot, frame, camera, stamp_s, joints_status, now_s, result)) {
    return result;
  }
  prepare(frame);
  if (!state) {
    result.pose.X_BL = frame.pose.X_BL;
    return parts_->evaluate(frame, frame.robot);
  }
  forward_kinematics(parts_->robot->model(), state->position, result.pose);
  parts_->renderer_of(frame.mounted).render(result.pose, frame.X_BC, parts_->image);
  return parts_->evaluate(frame, parts_->image);
}

const ImageResult& ImageQuery::Parts::evaluate(const Frame& frame, const RobotImage& asked) {
  method->evaluate(
      {frame.mounted->camera(), asked, robot->model().link_count(), searchable, settings},
      distances);
  tell_image_distances(distances, frame.X_BC, result);
  return result;
}

RobotRenderer& ImageQuery::Parts::renderer_of(const std::shared_ptr<const MountedCamera>& mounted) {
  if (rendered_view == mounted) return *renderer;
  rendered_view = mounted;
  return renderer.emplace(robot->meshes(), mounted->camera());
}

}  // namespace berth
