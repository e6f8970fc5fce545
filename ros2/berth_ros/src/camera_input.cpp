#include "camera_input.hpp"

#include <algorithm>
#include <stdexcept>

#include "camera_pose.hpp"

namespace berth_ros {
namespace {

bool is_same(const berth::Camera& a, const berth::Camera& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.fx_px == b.fx_px &&
         a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px;
}

}  // namespace

berth::RawDepth raw_of(const sensor_msgs::msg::Image& image) {
  return {image.data,     static_cast<int>(image.width), static_cast<int>(image.height), image.step,
          image.encoding, image.is_bigendian != 0};
}

berth::Camera camera_of(const sensor_msgs::msg::CameraInfo& info, bool is_rectified) {
  const bool is_distorted =
      std::any_of(info.d.begin(), info.d.end(), [](double d) { return d != 0; });
  if (is_distorted && !is_rectified) {
    throw std::invalid_argument(
        "camera_info has distortion; expected rectified images: remap depth_image to a rectified "
        "topic (such as image_rect) and set the parameter rectified");
  }
  if (info.binning_x > 1 || info.binning_y > 1) {
    throw std::invalid_argument("camera_info has binning; expected images of full resolution");
  }
  const auto& roi = info.roi;
  if (roi.x_offset != 0 || roi.y_offset != 0 || (roi.width != 0 && roi.width != info.width) ||
      (roi.height != 0 && roi.height != info.height)) {
    throw std::invalid_argument("camera_info has a region of interest; expected whole images");
  }
  berth::Camera camera{static_cast<int>(info.width), static_cast<int>(info.height), 0, 0, 0, 0};
  if (is_rectified) {
    camera.fx_px = info.p[0], camera.fy_px = info.p[5], camera.cx_px = info.p[2],
    camera.cy_px = info.p[6];
  } else {
    camera.fx_px = info.k[0], camera.fy_px = info.k[4], camera.cx_px = info.k[2],
    camera.cy_px = info.k[5];
  }
  if (info.width == 0 || info.height == 0 || !(camera.fx_px > 0) || !(camera.fy_px > 0)) {
    throw std::invalid_argument(
        "camera_info has no intrinsics; expected those of a calibrated camera");
  }
  return camera;
}

CameraInput::CameraInput(rclcpp::Node& node, CameraSettings settings, StampClock& clock,
                         const tf2_ros::Buffer& tf, OnFrame on_frame)
    : logger_(node.get_logger().get_child(settings.name)),
      settings_(std::move(settings)),
      clock_(clock),
      tf_(tf),
      on_frame_(std::move(on_frame)),
      group_(node.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive)) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = group_;
  const rclcpp::QoS qos = rclcpp::SensorDataQoS().keep_last(1);
  info_ = node.create_subscription<sensor_msgs::msg::CameraInfo>(
      settings_.topic_prefix + "camera_info", qos,
      [this](const sensor_msgs::msg::CameraInfo::ConstSharedPtr& info) { on_info(info); }, options);
  image_ = image_transport::create_subscription(
      &node, settings_.topic_prefix + "depth_image",
      [this](const ImageMessage::ConstSharedPtr& image) { on_image(image); },
      settings_.image_transport, qos.get_rmw_qos_profile(), options);
}

void CameraInput::use(std::shared_ptr<const berth::Robot> robot,
                      std::shared_ptr<const berth::JointIntake> joints,
                      const berth::CameraSettings& view) {
  // Its thread ends once the mutex is free: it may be in on_frame_, which asks for frames.
  std::unique_ptr<berth::LiveCamera> before;
  const std::lock_guard lock(mutex_);
  before = std::move(live_);
  robot_ = std::move(robot);
  joints_ = std::move(joints);
  settings_.view = view;
  mount_.reset();
}

void CameraInput::joints_came() {
  const std::lock_guard lock(mutex_);
  if (live_) live_->joints_came();
}

std::shared_ptr<const berth::Frame> CameraInput::newest(const berth::Robot* robot) const {
  const std::lock_guard lock(mutex_);
  auto frame = live_ ? live_->newest() : nullptr;
  return frame && frame->view->robot().get() == robot ? frame : nullptr;
}

CameraReport CameraInput::report() const {
  const std::lock_guard lock(mutex_);
  CameraReport report;
  report.trouble = trouble_;
  report.pose_from = !mount_ ? "nowhere yet" : takes_scene_pose_ ? "scene" : "TF";
  if (live_) {
    report.counts = live_->counts();
    report.newest = live_->newest();
  }
  report.refused = refused_;
  report.mounts = mounts_;
  return report;
}

void CameraInput::refuse(const std::string& why) {
  ++refused_;
  if (why != trouble_) RCLCPP_WARN(logger_, "%s", why.c_str());
  trouble_ = why;
}

void CameraInput::on_info(const std::shared_ptr<const sensor_msgs::msg::CameraInfo>& info) {
  take_info(*info);
  std::shared_ptr<const ImageMessage> early;
  {
    const std::lock_guard lock(mutex_);
    early = std::move(early_image_);
  }
  if (early) on_image(early);
}

void CameraInput::take_info(const sensor_msgs::msg::CameraInfo& info) {
  std::unique_ptr<berth::LiveCamera> before;
  const std::lock_guard lock(mutex_);
  try {
    const berth::Camera camera = camera_of(info, settings_.is_rectified);
    if (camera_ && is_same(camera, *camera_)) return;
    camera_ = camera;
    trouble_ = "no image yet";
  } catch (const std::invalid_argument& error) {
    camera_.reset();
    refuse(error.what());
  }
  before = std::move(live_);
}

bool CameraInput::find_mount(const ImageMessage& image) {
  std::optional<berth::CameraMount> mount;
  std::string why;
  if (settings_.pose_source != PoseSource::scene && !takes_scene_pose_) {
    mount = mount_from_tf(tf_, robot_->model(), image.header.frame_id, image.header.stamp, why);
  }
  if (!mount && settings_.pose_source != PoseSource::tf && settings_.scene_mount) {
    takes_scene_pose_ = true;
    mount = settings_.scene_mount;
  }
  // A mount that TF told once holds on: what is fixed needs no new word.
  if (!mount) {
    if (!mount_) refuse(why);
    return mount_.has_value();
  }
  if (mount_ && is_same_mount(*mount_, *mount)) return true;
  mount_ = mount;
  ++mounts_;
  retired_ = std::move(live_);
  return true;
}

bool CameraInput::make_ready(const ImageMessage& image) {
  if (!robot_) {
    refuse("an image came, and there is no robot model yet");
    return false;
  }
  if (!find_mount(image)) return false;
  if (live_) return true;
  berth::CameraMount mount = *mount_;
  mount.camera = *camera_;
  mount.name = settings_.name;
  const auto view = std::make_shared<const berth::MountedCamera>(robot_, mount, settings_.view);
  live_ = std::make_unique<berth::LiveCamera>(
      view, *joints_, settings_.live,
      [this, kept = joints_](const berth::Frame& frame, berth::DepthView,
                             const std::shared_ptr<const void>& with) {
        on_frame_(frame, std::static_pointer_cast<const ImageMessage>(with));
      });
  return true;
}

void CameraInput::on_image(const std::shared_ptr<const ImageMessage>& image) {
  take_image(image);
  std::unique_ptr<berth::LiveCamera> before;
  const std::lock_guard lock(mutex_);
  before = std::move(retired_);
}

void CameraInput::take_image(const std::shared_ptr<const ImageMessage>& image) {
  const std::lock_guard lock(mutex_);
  if (!camera_) {
    // Of both that come together either may be first.
    if (early_image_) refuse("images come, and no camera_info that is right");
    early_image_ = image;
    return;
  }
  try {
    if (!make_ready(*image)) return;
    berth::DepthImage depth_m = live_->spare_image();
    berth::read_raw_depth(raw_of(*image), *camera_, settings_.units, depth_m);
    live_->push(clock_.seconds(image->header.stamp), std::move(depth_m), image);
    trouble_.clear();
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

}  // namespace berth_ros
