#include "attach_actions.hpp"

#include <chrono>

namespace berth_ros {
namespace {

constexpr std::chrono::milliseconds kLookPeriod{20};
constexpr double kUsualTimeout_s = 5;

using Clock = std::chrono::steady_clock;

std::function<void(Attached&)> change_of(const berth_msgs::action::Attach::Goal& goal) {
  const berth::Attachment part = attachment_of(goal);
  return [part](Attached& attached) { attached.told.push_back(part); };
}

std::function<void(Attached&)> change_of(const berth_msgs::action::Detach::Goal& goal) {
  return [name = goal.name](Attached& attached) { attached.detach(name); };
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

AttachActions::AttachActions(rclcpp_lifecycle::LifecycleNode& node, ChangeAttached change,
                             Waiting waiting)
    : change_(std::move(change)),
      waiting_(std::move(waiting)),
      attach_(serve<Attach>(node, "~/attach_part")),
      detach_(serve<Detach>(node, "~/detach_part")),
      timer_(node.create_wall_timer(kLookPeriod, [this] { look(); })) {}

template <class Action>
typename rclcpp_action::Server<Action>::SharedPtr AttachActions::serve(
    rclcpp_lifecycle::LifecycleNode& node, const std::string& name) {
  using Goal = rclcpp_action::ServerGoalHandle<Action>;
  return rclcpp_action::create_server<Action>(
      &node, name,
      [](const rclcpp_action::GoalUUID&, const std::shared_ptr<const typename Action::Goal>&) {
        return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](const std::shared_ptr<Goal>&) { return rclcpp_action::CancelResponse::REJECT; },
      [this](const std::shared_ptr<Goal>& goal) { begin<Action>(goal); });
}

template <class Action>
void AttachActions::begin(const std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>& goal) {
  auto result = std::make_shared<typename Action::Result>();
  try {
    change_(change_of(*goal->get_goal()));
  } catch (const std::exception& error) {
    result->message = error.what();
    return goal->abort(result);
  }
  const double asked_s = goal->get_goal()->timeout_s;
  const double timeout_s = asked_s > 0 ? asked_s : kUsualTimeout_s;
  const Clock::time_point begun = Clock::now();
  pending_.push_back([=](const std::vector<std::string>& waiting_for) {
    if (waiting_for.empty()) {
      goal->succeed(result);
      return true;
    }
    if (std::chrono::duration<double>(Clock::now() - begun).count() > timeout_s) {
      result->message = "no image of the robot as it is now from " + joined(waiting_for);
      goal->abort(result);
      return true;
    }
    auto feedback = std::make_shared<typename Action::Feedback>();
    feedback->waiting_for = waiting_for;
    goal->publish_feedback(feedback);
    return false;
  });
}

void AttachActions::look() {
  if (pending_.empty()) return;
  const std::vector<std::string> waiting_for = waiting_();
  std::erase_if(pending_, [&](const Pending& one) { return one(waiting_for); });
}

}  // namespace berth_ros
