#include "configuration_answers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "berth/pipeline/timeliness.hpp"
#include "berth/results/result_text.hpp"

namespace berth_ros {
namespace {

using Request = ConfigurationAnswers::Request;
using Response = ConfigurationAnswers::Response;
using berth::Verdict;

static_assert(Response::FREE == static_cast<int>(Verdict::free));
static_assert(Response::NEAR == static_cast<int>(Verdict::near));
static_assert(Response::UNDECIDED == static_cast<int>(Verdict::undecided));

/// The place of each name among the robot's joints.
std::vector<std::size_t> places_of(const std::vector<std::string>& names,
                                   const std::vector<berth::MovableJoint>& joints) {
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(joints, name, &berth::MovableJoint::name);
    const std::size_t place = found - joints.begin();
    const bool is_twice = std::ranges::find(places, place) != places.end();
    if (found == joints.end() || is_twice) {
      throw std::invalid_argument("trajectory.joint_names: \"" + name + "\" " +
                                  (is_twice ? "stands twice" : "is no joint of the robot") +
                                  "; expected joints that move by themselves, each once");
    }
    places.push_back(place);
  }
  return places;
}

/// Of joints that a trajectory does not name.
std::vector<double> newest_positions(const RobotNow& now) {
  const double age_s = now.now_s - now.joints.stamp_s;
  const double max_age_s = now.robot->settings().time.max_joints_age_s;
  const bool is_there = now.joints_status == berth::TimeStatus::ok;
  if (is_there && age_s >= -berth::kMostJointsAhead_s && age_s <= max_age_s) {
    return now.joints.position;
  }
  throw std::runtime_error(
      "trajectory.joint_names: not all of the robot's joints, and the joint states are " +
      (is_there ? std::to_string(age_s) + " s old" : std::string(name_of(now.joints_status))) +
      "; expected all joints, or joint states of the last " + std::to_string(max_age_s) + " s");
}

/// One configuration after another.
std::vector<double> positions_of(const trajectory_msgs::msg::JointTrajectory& trajectory,
                                 const RobotNow& now) {
  const std::vector<berth::MovableJoint>& joints = now.robot->model().joints;
  const std::vector<std::size_t> places = places_of(trajectory.joint_names, joints);
  if (trajectory.points.empty()) {
    throw std::invalid_argument("trajectory.points: empty; expected at least one");
  }
  std::vector<double> row(joints.size());
  if (places.size() < joints.size()) row = newest_positions(now);
  std::vector<double> positions;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const std::vector<double>& told = trajectory.points[i].positions;
    if (told.size() != places.size()) {
      throw std::invalid_argument("trajectory.points[" + std::to_string(i) +
                                  "].positions: " + std::to_string(told.size()) +
                                  " numbers; expected " + std::to_string(places.size()));
    }
    for (std::size_t j = 0; j < places.size(); ++j) row[places[j]] = told[j];
    positions.insert(positions.end(), row.begin(), row.end());
  }
  return positions;
}

constexpr double kMostMotion = berth::ConfigurationCheck::kMostMotion;

/// As the check itself does, by the names of the message.
void require_short(const std::vector<double>& positions,
                   const std::vector<berth::MovableJoint>& joints) {
  for (std::size_t k = joints.size(); k < positions.size(); ++k) {
    const double way = std::abs(positions[k] - positions[k - joints.size()]);
    // What is not finite is refused by who asks for configurations.
    if (!std::isfinite(way) || way <= kMostMotion) continue;
    throw std::invalid_argument("trajectory.points[" + std::to_string(k / joints.size()) +
                                "].positions: joint \"" + joints[k % joints.size()].name +
                                "\" moves by " + std::to_string(way) +
                                " from the point before; expected at most " +
                                std::to_string(kMostMotion) + " with check_motions");
  }
}

std::vector<std::uint8_t> bytes_of(const std::vector<Verdict>& verdicts) {
  std::vector<std::uint8_t> bytes(verdicts.size());
  std::ranges::transform(verdicts, bytes.begin(),
                         [](Verdict verdict) { return static_cast<std::uint8_t>(verdict); });
  return bytes;
}

/// The first point that is so, or from which the motion is; -1 where there is none.
template <class IsSo>
int first(const Response& answer, const IsSo& is_so) {
  for (std::size_t i = 0; i < answer.configurations.size(); ++i) {
    const bool has_motion = i < answer.motions.size();
    if (is_so(answer.configurations[i]) || (has_motion && is_so(answer.motions[i]))) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

}  // namespace

void ConfigurationAnswers::answer(const Request& request, Response& response) {
  try {
    find(request, response);
    response.success = true;
  } catch (const std::exception& error) {
    response = Response();
    response.message = error.what();
    response.frame_age_s = std::numeric_limits<double>::quiet_NaN();
    response.first_near = -1;
  }
}

void ConfigurationAnswers::find(const Request& request, Response& response) {
  const RobotNow now = look_();
  const std::vector<double> positions = positions_of(request.trajectory, now);
  if (request.check_motions) require_short(positions, now.robot->model().joints);
  prepare(now);
  berth::ConfigurationMargins margins{.margin_m = request.margin_m, .without = request.without};
  if (!std::isnan(request.known_margin_m)) margins.known_margin_m = request.known_margin_m;
  std::vector<Verdict> verdicts(request.trajectory.points.size());
  check_->ask(positions, margins, verdicts);
  if (request.resolve) check_->resolve(positions, margins, verdicts);
  response.configurations = bytes_of(verdicts);
  if (request.check_motions) {
    const std::size_t joints = now.robot->model().joints.size();
    const std::span<const double> all(positions);
    verdicts.resize(verdicts.size() - 1);
    check_->ask_motions(all.first(all.size() - joints), all.subspan(joints), margins, verdicts);
    response.motions = bytes_of(verdicts);
  }
  response.first_not_free = first(response, [](int verdict) { return verdict != Response::FREE; });
  response.first_near = first(response, [](int verdict) { return verdict == Response::NEAR; });
  const auto by_stamp = [](const auto& frame) { return frame->stamp_s; };
  const auto [oldest, newest] = std::ranges::minmax(now.frames, {}, by_stamp);
  response.stamp = clock_.stamp(newest->stamp_s);
  response.frame_age_s = now.now_s - oldest->stamp_s;
}

void ConfigurationAnswers::prepare(const RobotNow& now) {
  if (!check_ || &check_->robot() != now.robot.get()) {
    check_ = std::make_unique<berth::ConfigurationCheck>(now.robot);
  }
  const berth::ResultStatus status = check_->prepare(now.frames, now.now_s, now.X_WB);
  if (status == berth::ResultStatus::ok) return;
  throw std::runtime_error(std::string(name_of(status)) + trouble(now));
}

std::string ConfigurationAnswers::trouble(const RobotNow& now) const {
  if (now.X_WB && !now.X_WB->matrix().allFinite()) {
    return ": nobody tells where the robot's root stands";
  }
  std::string all;
  for (std::size_t k = 0; k < now.frames.size(); ++k) {
    berth::CameraResult camera;
    static_cast<berth::CameraState&>(camera) =
        berth::camera_state(now.frames[k].get(), now.now_s, now.robot->settings().time);
    camera.camera = camera_names_[k];
    const std::string one = berth::camera_text(camera);
    if (!one.empty()) all += (all.empty() ? ": " : ", ") + one;
  }
  return all;
}

}  // namespace berth_ros
