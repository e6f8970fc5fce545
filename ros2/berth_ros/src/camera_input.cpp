#include "camera_input.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>

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

berth::CameraInfo camera_info_of(const sensor_msgs::msg::CameraInfo& info,
                                 std::optional<bool> is_rectified) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  to_flow_style_yaml(info, text);
  return berth::parse_camera_info("camera_info", text.str(), is_rectified);
}

bool is_same_mount(const berth::CameraMount& a, const berth::CameraMount& b) {
  return is_same(a.camera, b.camera) && a.parent_link == b.parent_link &&
         is_same_place(a.X_PC, b.X_PC);
}

CameraInput::CameraInput(rclcpp_lifecycle::LifecycleNode& node,
                         const std::shared_ptr<CallbackGate>& gate, rclcpp::Node& images,
                         CameraSettings settings, std::string world_frame, StampClock& clock,
                         const Transforms& transforms, OnFrame on_frame)
    : settings_(std::move(settings)),
      world_frame_(std::move(world_frame)),
      clock_(clock),
      transforms_(transforms),
      on_frame_(std::move(on_frame)),
      group_(node.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive)),
      image_group_(images.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive)) {
  rclcpp::QoS qos = rclcpp::SensorDataQoS().keep_last(1);
  if (settings_.is_reliable) qos.reliable();
  rclcpp::SubscriptionOptions options;
  options.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();
  options.callback_group = group_;
  info_ = node.create_subscription<sensor_msgs::msg::CameraInfo>(
      settings_.topic_prefix + "camera_info", qos,
      [this, gate](const sensor_msgs::msg::CameraInfo::ConstSharedPtr& info) {
        gate->run([&] { on_info(info); });
      },
      options);
  options.callback_group = image_group_;
  image_ = image_transport::create_subscription(
      &images,
      node.get_node_topics_interface()->resolve_topic_name(settings_.topic_prefix + "depth_image"),
      [this](const ImageMessage::ConstSharedPtr& image) { on_image(image); },
      settings_.image_transport, qos.get_rmw_qos_profile(), options);
}

void CameraInput::use(std::shared_ptr<const berth::Robot> robot,
                      std::shared_ptr<const berth::JointIntake> joints,
                      const berth::CameraSettings& settings) {
  // Its thread ends once the mutex is free: it may be in on_frame_, which asks for frames.
  std::unique_ptr<berth::LiveCamera> before;
  const std::lock_guard lock(mutex_);
  before = take_live();
  robot_ = std::move(robot);
  joints_ = std::move(joints);
  settings_.settings = settings;
  mount_.reset();
}

std::unique_ptr<berth::LiveCamera> CameraInput::take_live() {
  const std::lock_guard lock(live_mutex_);
  const auto frame = live_ ? live_->newest() : nullptr;
  if (frame) found_mount_ = frame->mounted->mount(), found_ = frame->watch;
  return std::move(live_);
}

berth::CameraWatch CameraInput::found(const berth::CameraMount& mount) const {
  if (!found_mount_) return {};
  berth::CameraMount before = *found_mount_;
  if (moves_) before.X_PC = mount.X_PC;
  return is_same_mount(before, mount) ? found_ : berth::CameraWatch();
}

void CameraInput::distrust(const std::optional<berth::CameraMount>& mount) {
  const std::lock_guard lock(mutex_);
  distrusted_ = mount;
  const std::lock_guard lock_live(live_mutex_);
  if (live_) live_->distrust(is_distrusted(live_->mounted()->mount()));
}

void CameraInput::look_again() {
  const std::lock_guard lock(live_mutex_);
  if (live_) live_->look_again();
}

std::shared_ptr<const berth::Frame> CameraInput::newest(const berth::Robot* robot) const {
  const std::lock_guard lock(live_mutex_);
  auto frame = live_ ? live_->newest() : nullptr;
  return frame && frame->mounted->robot().get() == robot ? frame : nullptr;
}

CameraReport CameraInput::report() const {
  CameraReport report;
  {
    const std::lock_guard lock(place_mutex_);
    report.pose_trouble = place_trouble_;
  }
  const std::lock_guard lock(mutex_);
  report.trouble = trouble_;
  report.pose_from = !mount_ ? "nowhere yet" : takes_scene_pose_ ? "scene" : "TF";
  if (live_) {
    report.counts = live_->counts();
    report.newest = live_->newest();
    if (report.trouble.empty()) report.trouble = report.counts.failure;
  }
  report.refused = refused_;
  report.mounts = mounts_;
  report.rate = rate_;
  return report;
}

void CameraInput::refuse(const std::string& why) {
  ++refused_;
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
  if (told_) told_->header.stamp = info.header.stamp;
  if (told_ == info) return;
  told_ = info;
  camera_.reset();
  rectification_.reset();
  mount_.reset();
  try {
    camera_ = camera_info_of(info, settings_.is_rectified);
    if (camera_->lens || settings_.depth_is == berth::DepthIs::along_ray) {
      rectification_ = std::make_unique<const berth::Rectification>(camera_->camera, camera_->lens,
                                                                    settings_.depth_is);
    }
    frame_id_ = info.header.frame_id;
    info_trouble_.clear();
    trouble_ = "no image yet";
  } catch (const std::exception& error) {
    info_trouble_ = error.what();
    refuse(info_trouble_);
  }
  before = take_live();
}

void CameraInput::require_frame_id(const ImageMessage& image) {
  const std::string& frame_id = image.header.frame_id;
  if (frame_id_.empty()) frame_id_ = frame_id;
  if (frame_id == frame_id_) return;
  throw std::invalid_argument("an image of the frame \"" + frame_id + "\"; expected \"" +
                              frame_id_ + "\", that of camera_info or of the images before");
}

void CameraInput::find_mount(const ImageMessage& image) {
  std::string why = "the image has no frame_id; expected the camera's optical frame";
  if (settings_.pose_source != PoseSource::scene) {
    berth::CameraMount mount;
    mount.parent_link = transforms_.link_above(robot_->model(), image.header.frame_id);
    std::optional<ToldPose> told;
    if (!image.header.frame_id.empty()) {
      told = transforms_.newest(mount.parent_link, image.header.frame_id, why);
    }
    if (told) {
      mount.X_PC = told->X_PF;
      // What moves is placed image by image.
      const bool is_same = mount_ && !takes_scene_pose_ &&
                           mount_->parent_link == mount.parent_link &&
                           (!told->is_static || is_same_place(mount_->X_PC, mount.X_PC));
      is_known_to_tf_ = true;
      takes_scene_pose_ = false;
      moves_ = !told->is_static;
      if (!is_same) mount_at(mount);
      return;
    }
  }
  if (settings_.pose_source != PoseSource::tf && settings_.scene_mount && !is_known_to_tf_) {
    takes_scene_pose_ = true;
    if (!mount_) mount_at(*settings_.scene_mount);
    return;
  }
  throw std::invalid_argument(why);
}

void CameraInput::mount_at(const berth::CameraMount& mount) {
  mount_ = mount;
  ++mounts_;
  retired_ = take_live();
}

void CameraInput::make_live(const ImageMessage& image) {
  berth::CameraMount mount = *mount_;
  mount.camera = rectification_ ? rectification_->camera() : camera_->camera;
  mount.name = settings_.name;
  const auto mounted =
      std::make_shared<const berth::MountedCamera>(robot_, mount, settings_.settings);
  const PlaceSource source{takes_scene_pose_ ? std::string() : image.header.frame_id,
                           mount.parent_link, robot_->model().links.front().name,
                           robot_->settings().time.max_joints_age_s};
  auto live = std::make_unique<berth::LiveCamera>(
      mounted, *joints_, settings_.live,
      [this, kept = joints_](const std::shared_ptr<const berth::Frame>& frame,
                             berth::DepthView depth_m, const std::shared_ptr<const void>& with) {
        on_frame_(frame, depth_m, std::static_pointer_cast<const ImageMessage>(with));
      },
      [this, source](double stamp_s) { return place_at(source, stamp_s); }, found(mount));
  live->distrust(is_distrusted(mount));
  const std::lock_guard lock(live_mutex_);
  live_ = std::move(live);
}

std::optional<berth::PlaceAtExposure> CameraInput::place_at(const PlaceSource& source,
                                                            double stamp_s) const {
  berth::PlaceAtExposure place;
  const rclcpp::Time stamp(clock_.stamp(stamp_s + settings_.live.clock_offset_s));
  std::string why;
  const auto find = [&](const std::string& parent, const std::string& frame, auto& out) {
    const auto told = transforms_.at(parent, frame, stamp, source.max_gap_s, why);
    if (told) out = told->X_PF;
    return told.has_value();
  };
  const bool is_found = (source.optical_frame.empty() ||
                         find(source.parent_link, source.optical_frame, place.X_PC)) &&
                        (world_frame_.empty() || find(world_frame_, source.root_link, place.X_WB));
  const std::lock_guard lock(place_mutex_);
  place_trouble_ = why;
  return is_found ? std::optional(place) : std::nullopt;
}

void CameraInput::make_ready(const ImageMessage& image) {
  if (!robot_) throw std::invalid_argument("an image came, and there is no robot model yet");
  require_frame_id(image);
  find_mount(image);
  if (!live_) make_live(image);
}

void CameraInput::on_image(const std::shared_ptr<const ImageMessage>& image) {
  take_image(image);
  std::unique_ptr<berth::LiveCamera> before;
  const std::lock_guard lock(mutex_);
  before = std::move(retired_);
}

void CameraInput::read_image(const ImageMessage& image, berth::DepthImage& depth_m) {
  berth::read_raw_depth(raw_of(image), camera_->camera, settings_.units,
                        rectification_ ? given_m_ : depth_m);
  if (rectification_) rectification_->apply(given_m_, depth_m);
}

void CameraInput::take_image(const std::shared_ptr<const ImageMessage>& image) {
  const std::lock_guard lock(mutex_);
  if (!camera_) {
    // Of both that come together either may be first.
    if (early_image_) refuse(info_trouble_);
    early_image_ = image;
    return;
  }
  try {
    const double stamp_s = clock_.seconds(image->header.stamp);
    rate_.add(stamp_s);
    make_ready(*image);
    berth::DepthImage depth_m = live_->spare_image();
    read_image(*image, depth_m);
    live_->push(stamp_s, std::move(depth_m), image);
    trouble_.clear();
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

}  // namespace berth_ros
