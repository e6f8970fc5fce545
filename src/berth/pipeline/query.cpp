#include "berth/pipeline/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/link_searches.hpp"
#include "berth/pipeline/mounted_camera.hpp"

namespace berth {
namespace {

double newest_stamp_s(std::span<const Frame* const> frames) {
  double newest_s = -std::numeric_limits<double>::infinity();
  for (const Frame* frame : frames) {
    if (frame) newest_s = std::max(newest_s, frame->stamp_s);
  }
  return newest_s;
}

/// Of a frame that another image may take the place of, at the same address.
std::uint64_t number_of(const Frame* frame) { return frame ? frame->number : 0; }

/// What it takes part in: readings, and free space.
std::pair<bool, bool> use_of(const CameraState& camera) {
  const bool is_in = is_used(camera.status);
  return {is_in, is_in && camera.status != CameraStatus::blind};
}

bool is_unset(const std::optional<Pose>& X_WB) { return X_WB && !X_WB->matrix().allFinite(); }

bool is_nearer(const std::vector<WholeLinkDistance>& links, double limit_m) {
  return std::ranges::any_of(links, [limit_m](const WholeLinkDistance& link) {
    return link.nearest.lower_bound_m < limit_m;
  });
}

void require_length(double limit_m) {
  if (std::isfinite(limit_m) && limit_m >= 0) return;
  throw std::invalid_argument(fmt::format(
      "look-ahead: the limit is {} m; expected a finite number of at least 0", limit_m));
}

}  // namespace

void begin_result(const Robot& robot, Result& result) {
  const RobotModel& model = robot.model();
  result.range_m = robot.settings().distance.range_m;
  result.has_visibility = robot.settings().visibility;
  result.has_candidates = robot.settings().candidates > 1;
  result.links.resize(model.evaluated_links.size());
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    const std::size_t index = model.evaluated_links[i];
    result.links[i].id = static_cast<LinkId>(i + 1);
    result.links[i].link = model.links[index].name;
    result.links[i].is_moved = model.is_moved(index);
    const std::size_t numbers = robot.settings().gradient ? model.joints.size() : 0;
    for (auto* gradient : result.links[i].gradients()) gradient->resize(numbers);
  }
  withhold(result);
}

void tell_camera(const Exposure* exposure, const CameraState& state, CameraResult& out) {
  static_cast<CameraState&>(out) = state;
  out.has_frame = exposure && exposure->mounted;
  if (!out.has_frame) return;
  if (out.mounted != exposure->mounted) {
    out.mounted = exposure->mounted;
    out.camera = exposure->mounted->mount().name;
  }
  out.X_BC = exposure->X_BC;
}

void tell_fates(const Frame& frame, CameraResult& out) {
  out.self_filter = frame.obstacles.count;
  out.unread_share = frame.unread_share;
  out.tells_unread = frame.tells_unread;
}

Query::Query(std::shared_ptr<const Robot> robot, std::vector<std::string> camera_names)
    : robot_(std::move(robot)),
      camera_names_(std::move(camera_names)),
      asked_(nullptr),
      set_(std::make_unique<FrameSet>()),
      searches_(std::make_unique<LinkSearches>(robot_)) {
  asked_ = set_.get();
  begin_result(*robot_, result_);
  std::vector<std::string> names;
  for (const Link& link : robot_->model().links) names.push_back(link.name);
  result_.link_names = std::make_shared<const std::vector<std::string>>(std::move(names));
  // Here, and not in the first request.
  robot_->known();
}

Query::~Query() = default;

void Query::forget() {
  searches_->forget();
  goes_on_ = false;
}

bool Query::has_changed(std::span<const Frame* const> frames) const {
  if (!std::ranges::equal(frames, set_->frames())) return true;
  if (!std::ranges::equal(frames, numbers_, {}, number_of)) return true;
  return !std::ranges::equal(cameras_, before_, {}, &CameraState::status, &CameraState::status);
}

bool Query::has_moved(const std::optional<Pose>& X_WB) const {
  if (X_WB.has_value() != X_WB_.has_value()) return true;
  return X_WB && X_WB->matrix() != X_WB_->matrix();
}

bool Query::take_prepared(const std::shared_ptr<const PreparedSpace>& prepared,
                          const std::optional<Pose>& X_WB) {
  if (!prepared) return false;
  const FrameSet& set = *prepared->set_;
  if (!std::ranges::equal(cameras_, set.cameras(), {}, use_of, use_of)) return false;
  if (X_WB && !set.is_posed_at(*X_WB)) return false;
  if (asked_ == &set && prepared_ == prepared && goes_on_) return true;
  asked_ = &set;
  prepared_ = prepared;
  goes_on_ = true;
  searches_->go_on_from(*prepared->searches_);
  return true;
}

void Query::update_frames(const NewestFrames& newest, double now_s,
                          const std::optional<Pose>& X_WB) {
  const TimeSettings& settings = robot_->settings().time;
  const std::span<const Frame* const> frames = newest.get();
  before_.swap(cameras_);
  cameras_.clear();
  for (const Frame* frame : frames) cameras_.push_back(camera_state(frame, now_s, settings));
  if (take_prepared(newest.prepared(), X_WB)) return;
  const bool is_same = asked_ == set_.get() && prepared_ == newest.prepared();
  if (is_same && !has_changed(frames) && !has_moved(X_WB)) return;
  X_WB_ = X_WB;
  asked_ = set_.get();
  prepared_ = newest.prepared();
  set_->assign(frames, settings, now_s, is_unset(X_WB) ? std::nullopt : X_WB,
               prepared_ ? prepared_->set_.get() : nullptr);
  numbers_.clear();
  for (const Frame* frame : frames) numbers_.push_back(number_of(frame));
}

Timeliness Query::find_pose(const JointState* joints, TimeStatus joints_status,
                            std::optional<double> now_s) {
  const TimeSettings& settings = robot_->settings().time;
  if (!joints) {
    const Timeliness time = timeliness_of(*asked_, now_s, settings);
    result_.joints_stamp_s = result_.stamp_s;
    if (time.status == TimeStatus::ok) result_.pose.X_BL = asked_->newest()->pose.X_BL;
    return time;
  }
  Timeliness time = timeliness_of(*asked_, joints->stamp_s, now_s, settings);
  result_.joints_stamp_s = joints->stamp_s;
  if (joints_status != TimeStatus::ok) {
    time.status = joints_status;
  } else if (time.status == TimeStatus::ok) {
    forward_kinematics(robot_->model(), joints->position, result_.pose);
  }
  return time;
}

void Query::tell_cameras() {
  result_.cameras.resize(cameras_.size());
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    CameraResult& camera = result_.cameras[k];
    const Frame* frame = asked_->frames()[k];
    tell_camera(frame, cameras_[k], camera);
    if (is_used(cameras_[k].status)) camera.X_BC = asked_->X_BC(k);
    if (camera.has_frame) tell_fates(*frame, camera);
    if (!camera.has_frame && k < camera_names_.size()) camera.camera = camera_names_[k];
  }
}

void Query::tell_ahead(const Request& request) {
  auto& [poses, first_nearer] = result_.ahead;
  first_nearer.reset();
  if (request.ahead.empty() || result_.status == ResultStatus::stale) return poses.clear();
  if (!ahead_) ahead_ = std::make_unique<LookAheadSearch>(robot_);
  ahead_->ask(*asked_, request.ahead, robot_->settings().distance, poses);
  const auto first = std::ranges::find_if(
      poses, [&](const auto& links) { return is_nearer(links, request.nearer_than_m); });
  if (first != poses.end()) first_nearer = first - poses.begin();
}

const Result& Query::ask(const Request& request) {
  const LinkSearches::Clock::time_point begin = LinkSearches::Clock::now();
  require_length(request.nearer_than_m);
  TimeStatus joints_status = TimeStatus::ok;
  const JointState* joints = request.joints.read(request.now_s, newest_, joints_status);
  const std::span<const Frame* const> frames = request.frames.get();
  update_frames(request.frames, request.now_s.value_or(newest_stamp_s(frames)), request.X_WB);
  tell_cameras();
  result_.stamp_s =
      asked_->newest() ? asked_->newest()->stamp_s : std::numeric_limits<double>::quiet_NaN();
  result_.time = find_pose(joints, joints_status, request.now_s);
  if (result_.time.status == TimeStatus::ok && is_unset(request.X_WB)) {
    result_.time.status = TimeStatus::stale_pose;
  }
  if (result_.time.status != TimeStatus::ok) {
    withhold(result_);
  } else {
    result_.status = std::ranges::all_of(cameras_, is_relied_on, &CameraState::status)
                         ? ResultStatus::ok
                         : ResultStatus::degraded;
    searches_->ask(*asked_, result_.pose, begin, request.stop, result_);
    find_nearest(result_);
  }
  tell_ahead(request);
  return result_;
}

}  // namespace berth
