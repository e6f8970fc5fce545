// How a LiveNode comes to its robot, and to another one.
#include "berth/scene/open_scene.hpp"
#include "live_node.hpp"
#include "robot_description.hpp"

namespace berth_ros {

void LiveNode::load_model(const std::function<berth::RobotModel()>& load) {
  const std::lock_guard making(making_mutex_);
  ++beginnings_;
  on_stop("another robot model comes");
  std::string trouble;
  model_.reset();
  explanations_->forget();
  for (const auto& input : inputs_) input->distrust(std::nullopt);
  {
    const std::lock_guard lock(mutex_);
    // Joints are another robot's; nobody uses half of both.
    live_ = {};
    rhythm_ = {};
  }
  try {
    model_ = load();
    for (const std::string& name : attached_.keep_those_of(*model_)) {
      RCLCPP_WARN(get_logger(), "detached %s: the new robot does not have its link", name.c_str());
    }
    return use(make_robot(attached_.all()));
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    robot_trouble_ = error.what();
  }
  use({});
}

void LiveNode::on_description(const std_msgs::msg::String& description) {
  if (description.data == description_) return;
  description_ = description.data;
  load_model([&] { return load_description(description_, settings_.robot_settings()); });
}

LiveRobot LiveNode::make_robot(const AttachmentList& attached) const {
  const auto& scene = settings_.scene();
  AttachmentList all = scene ? berth::attachments_of(*scene) : AttachmentList();
  all.insert(all.end(), attached.begin(), attached.end());
  LiveRobot made;
  const LiveRobot before = live();
  made.robot = before.robot
                   ? berth::with_settings(before.robot->with(all), settings_.evaluation())
                   : std::make_shared<const berth::Robot>(*model_, settings_.evaluation(), all);
  // Neither settings nor what is attached changes joints: those that came stay.
  made.joints = before.joints;
  made.beginnings = beginnings_;
  if (!made.joints) {
    made.joints = std::make_shared<berth::JointIntake>(*model_, settings_.joint_settings());
  }
  return made;
}

void LiveNode::change_attached(const std::function<void(Attached&)>& change) {
  const auto alive = life_->enter();
  const std::shared_ptr<CallbackGate> gate = this->gate();
  const auto pass = gate->enter();
  const std::lock_guard making(making_mutex_);
  if (!pass || !model_) throw std::runtime_error("there is no robot model yet");
  Attached changed = attached_;
  change(changed);
  // MoveIt may name what is no link of this robot; who attaches by a message is told.
  keep_touched_of(*model_, changed.followed);
  use(make_robot(changed.all()));
  attached_ = std::move(changed);
}

void LiveNode::use(const LiveRobot& made) {
  const std::function<void()> begin = make_for(made);
  on_stop(made.robot ? "the robot is made anew" : "there is no robot model");
  {
    const std::lock_guard lock(mutex_);
    live_ = made;
  }
  const std::vector<CameraSettings> cameras = settings_.cameras();
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    inputs_[i]->use(made.robot, made.joints, cameras[i].settings);
  }
  begin();
}

}  // namespace berth_ros
