#include "berth/pipeline/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <set>
#include <stdexcept>

#include "berth/distance/known_model.hpp"
#include "berth/distance/link_eighths.hpp"
#include "berth/distance/robot_patches.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {
namespace {

RobotModel with_all(RobotModel model, const std::vector<Attachment>& attached) {
  for (const Attachment& attachment : attached) model = with_attachment(model, attachment);
  return model;
}

auto find_attached(std::vector<Attachment>& attached, const std::string& name) {
  return std::find_if(attached.begin(), attached.end(),
                      [&](const Attachment& attachment) { return attachment.name == name; });
}

}  // namespace

/// Links of the bare robot that always touch do so with more on them, too.
struct Robot::Touching {
  std::mutex mutex;
  std::set<std::array<std::size_t, 2>> pairs;
};

struct Robot::Known {
  std::once_flag is_found;
  std::shared_ptr<const KnownModel> model;
};

struct Robot::Eighths {
  std::once_flag are_made;
  std::shared_ptr<const RobotPatches> patches;
};

Robot::Robot(RobotModel model, EvaluationSettings settings, std::vector<Attachment> attached)
    : bare_(std::move(model)),
      attached_(std::move(attached)),
      model_(with_all(bare_, attached_)),
      settings_(settings),
      meshes_(build_link_meshes(model_)) {
  validate(settings_.distance);
  validate(settings_.time);
  patches_ = build_robot_patches(model_);
  sample_points_ = std::make_shared<const SamplePoints>(berth::sample_points(model_));
  known_ = std::make_shared<Known>();
  eighths_ = std::make_shared<Eighths>();
  touching_ = std::make_shared<Touching>();
}

const RobotPatches& Robot::eighths() const {
  std::call_once(eighths_->are_made, [&] { eighths_->patches = build_link_eighths(model_); });
  return *eighths_->patches;
}

const KnownModel& Robot::known() const {
  std::call_once(known_->is_found, [&] {
    const std::lock_guard lock(touching_->mutex);
    known_->model = build_known_model(model_, patches_, touching_->pairs);
    for (const LeftOutPair& pair : known_->model->left_out) {
      const bool is_bare = has_nothing_on(pair.link) && has_nothing_on(pair.other);
      if (pair.reason == LeftOutReason::always_touch && is_bare) {
        touching_->pairs.insert({pair.link, pair.other});
      }
    }
  });
  return *known_->model;
}

bool Robot::has_nothing_on(std::size_t link) const {
  return link < bare_.links.size() &&
         bare_.links[link].mesh_L.triangles.size() == model_.links[link].mesh_L.triangles.size();
}

std::shared_ptr<const Robot> Robot::with(std::vector<Attachment> attached) const {
  const auto other = std::make_shared<Robot>(bare_, settings_, std::move(attached));
  other->touching_ = touching_;
  return other;
}

std::shared_ptr<const Robot> attach(const Robot& robot, const Attachment& attachment) {
  std::vector<Attachment> attached = robot.attached();
  if (find_attached(attached, attachment.name) != attached.end()) {
    throw std::invalid_argument(fmt::format(
        "attached \"{}\": it is attached already; expected another name", attachment.name));
  }
  attached.push_back(attachment);
  return robot.with(std::move(attached));
}

std::shared_ptr<const Robot> detach(const Robot& robot, const std::string& name) {
  std::vector<Attachment> attached = robot.attached();
  const auto found = find_attached(attached, name);
  if (found == attached.end()) {
    throw std::invalid_argument(
        fmt::format("attached \"{}\": nothing of this name is; expected one that is", name));
  }
  attached.erase(found);
  return robot.with(std::move(attached));
}

std::shared_ptr<const Robot> with_settings(const std::shared_ptr<const Robot>& robot,
                                           const EvaluationSettings& settings) {
  if (settings == robot->settings_) return robot;
  validate(settings.distance);
  validate(settings.time);
  // It shares the meshes, and what is known of the distances around them.
  const auto other = std::make_shared<Robot>(*robot);
  other->settings_ = settings;
  return other;
}

}  // namespace berth
