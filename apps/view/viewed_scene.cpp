#include "apps/view/viewed_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <set>
#include <stdexcept>

#include "apps/view/scene_messages.hpp"
#include "apps/view/settings_message.hpp"
#include "apps/view/space_grid.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/scene/former_settings.hpp"
#include "berth/scene/settings_text.hpp"
#include "berth/types/pose.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRequests = 100;
/// Notices that come at once are kept side by side.
constexpr int kNoticeKinds = 8;

/// Empty where it has none.
std::string text_in(const Json& request, const char* key) {
  const auto at = request.find(key);
  return at != request.end() && at->is_string() ? at->get<std::string>() : "";
}

/// What a later request of the same key makes needless; empty where nothing does.
std::string replaced_key(const Json& request) {
  const std::string what = text_in(request, "do");
  const std::string camera = request.contains("camera") ? request["camera"].dump() : "";
  if (what == "show" || what == "space") return what;
  if (what == "pose") return what + camera;
  if (what != "set") return "";
  return fmt::format("{}.{} {}", text_in(request, "group"), text_in(request, "key"), camera);
}

/// A value as a scene file has it.
std::optional<std::string> text_of_value(const Json& value) {
  if (value.is_null()) return std::nullopt;
  if (value.is_number() || value.is_boolean()) return value.dump();
  const std::string text = value.is_string() ? value.get<std::string>() : "";
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  throw std::runtime_error(
      fmt::format("{} is no value; expected a number, true, false or a name", value.dump()));
}

/// At which every camera has an image.
std::size_t first_step_of_all(const std::vector<ImageStep>& steps, std::size_t cameras) {
  std::set<std::size_t> found;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    found.insert(steps[step].camera);
    if (found.size() == cameras) return step;
  }
  return 0;
}

Eigen::Vector3d vector_of(const Json& json) {
  const auto values = json.get<std::array<double, 3>>();
  return {values[0], values[1], values[2]};
}

}  // namespace

ViewedScene::ViewedScene(const fs::path& file, fs::path folder, Publish publish,
                         const std::function<void()>& before_image)
    : folder_(std::move(folder)),
      publish_(std::move(publish)),
      changed_(file),
      scene_(std::make_shared<const OpenScene>(
          open_scene_with_images(changed_.original(), before_image))),
      shown_scene_(scene_),
      shown_(std::make_unique<SceneRun>(*scene_, SceneRun::SingleSteps{})),
      image_numbers_(scene_->cameras.size()),
      timeline_(publish_,
                [this] {
                  {
                    const std::scoped_lock lock(mutex_);
                    has_news_ = true;
                  }
                  wake_.notify_one();
                }),
      data_(publish_) {
  publish_robot();
  publish_("settings", settings_message(changed_));
  show(first_step_of_all(shown_->steps(), scene_->cameras.size()));
  timeline_.start(scene_);
  thread_ = std::thread([this] { work(); });
}

ViewedScene::~ViewedScene() { finish(); }

void ViewedScene::finish() {
  {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void ViewedScene::receive(const std::string& text) {
  Json request = Json::parse(text, nullptr, false);
  const bool is_request = request.is_object() && !text_in(request, "do").empty();
  {
    const std::scoped_lock lock(mutex_);
    const std::string key = is_request ? replaced_key(request) : "";
    if (!key.empty()) {
      std::erase_if(requests_, [&](const Json& one) { return replaced_key(one) == key; });
    }
    if (requests_.size() >= kMostRequests) return;
    requests_.push_back(is_request ? std::move(request) : Json{{"do", "?"}});
  }
  wake_.notify_one();
}

void ViewedScene::work() {
  while (true) {
    std::optional<Json> request;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return is_ending_ || has_news_ || !requests_.empty(); });
      if (is_ending_) return;
      if (!requests_.empty()) {
        request = std::move(requests_.front());
        requests_.pop_front();
      } else {
        has_news_ = false;
      }
    }
    try {
      if (request) {
        carry_out(*request);
      } else {
        show(step_);
      }
    } catch (const nlohmann::json::exception& error) {
      tell(true, fmt::format("not understood: {}", error.what()));
    } catch (const std::exception& error) {
      tell(true, error.what());
    }
  }
}

void ViewedScene::carry_out(const Request& request) {
  const auto what = request.at("do").get<std::string>();
  if (what == "show") return show(request.at("step").get<std::size_t>());
  if (what == "set") return set(request);
  if (what == "pose") return set_pose(request);
  if (what == "space") return show_space(request.at("on").get<bool>());
  if (what == "reset") return change([](ChangedScene& scene) { scene.reset(); });
  if (what == "calibration_data") return data_.start(scene_);
  if (what == "answer_calibration_data") {
    return data_.answer(request.at("part").get<std::string>(), request.at("is_taken").get<bool>());
  }
  if (what == "drop_calibration_data") return data_.drop();
  if (what == "take_calibration_data") {
    if (const auto found = data_.take()) {
      change([&](ChangedScene& scene) { scene.add(found->change, found->attached); });
    }
    return;
  }
  if (what == "save") {
    const fs::path file = changed_.save(folder_, request.at("name").get<std::string>());
    return tell(false, fmt::format("saved as {}", file.string()));
  }
  throw std::runtime_error("not understood; expected a request that the page makes");
}

void ViewedScene::change(const std::function<void(ChangedScene&)>& change) {
  ChangedScene changed = changed_;
  try {
    change(changed);
    auto scene =
        std::make_shared<const OpenScene>(reopen_scene(*scene_, changed.now(), changed.carried()));
    auto shown = std::make_unique<SceneRun>(*scene, SceneRun::SingleSteps{});
    changed_ = std::move(changed);
    shown_ = std::move(shown);
    shown_scene_ = scene;
    const bool carries_other = scene->robot->attached().size() != scene_->robot->attached().size();
    scene_ = std::move(scene);
    timeline_.stop();
    if (carries_other) publish_robot();
    show(step_);
    timeline_.start(scene_);
  } catch (...) {
    // The page has shown what was asked for.
    publish_("settings", settings_message(changed_));
    throw;
  }
  publish_("settings", settings_message(changed_));
  // What was refused before holds no longer.
  tell(false, "");
}

void ViewedScene::publish_robot() {
  publish_("scene", scene_message(*scene_, shown_->steps()));
  publish_("mesh", mesh_message(scene_->robot->model()));
}

void ViewedScene::set(const Request& request) {
  const auto group = request.at("group").get<std::string>();
  const auto key = request.at("key").get<std::string>();
  if (std::find(kSettingGroups.begin(), kSettingGroups.end(), group) == kSettingGroups.end()) {
    throw std::runtime_error(
        fmt::format("group \"{}\": expected one of {}", group, fmt::join(kSettingGroups, ", ")));
  }
  // A file may name it; nobody should write it anew.
  if (std::ranges::count(ended_settings(group), key) > 0) {
    throw std::runtime_error(
        fmt::format("{}.{}: is no setting any more; expected one that has an effect", group, key));
  }
  std::optional<std::size_t> camera;
  if (request.contains("camera") && !request["camera"].is_null()) camera = camera_in(request);
  const std::optional<std::string> text = text_of_value(request.at("value"));
  change([&](ChangedScene& scene) { scene.set(group, key, camera, text); });
}

void ViewedScene::set_pose(const Request& request) {
  const std::size_t camera = camera_in(request);
  std::optional<Pose> X_PC;
  if (!request.at("xyz_m").is_null()) {
    X_PC = Eigen::Translation3d(vector_of(request.at("xyz_m"))) *
           rotation_of_rpy(vector_of(request.at("rpy_rad")));
  }
  change([&](ChangedScene& scene) { scene.set_pose(camera, X_PC); });
}

void ViewedScene::show(std::size_t step) {
  step_ = std::min(step, shown_->steps().size() - 1);
  const StepFinding found = timeline_.find(step_);
  if (const auto learned = timeline_.learned(); learned && learned != shown_scene_) {
    shown_ = std::make_unique<SceneRun>(*learned, SceneRun::SingleSteps{});
    shown_scene_ = learned;
  }
  shown_->go_to(step_, found.result.get());
  Result own = shown_->ask();
  if (found.has_failed) withhold(own);
  std::vector<const Frame*> frames;
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) frames.push_back(shown_->frame(c).get());
  const ShownStep of{step_, !found.result && !found.has_failed};
  publish_("shown",
           shown_message(scene_->robot->model(), found.result ? *found.result : own, frames, of));
  publish_images();
  if (has_space_) publish_space();
}

void ViewedScene::publish_images() {
  const int stride = shown_stride(page_cameras(*scene_));
  for (std::size_t c = 0; c < image_numbers_.size(); ++c) {
    const std::shared_ptr<const Frame> frame = shown_->frame(c);
    if (!frame || frame->number == image_numbers_[c]) continue;
    image_numbers_[c] = frame->number;
    publish_(fmt::format("image {}", c),
             image_message(c, shown_->frame_number(c), shown_->sensor_depth_m(c), *frame, stride));
  }
}

void ViewedScene::show_space(bool is_on) {
  has_space_ = is_on;
  publish_space();
}

void ViewedScene::publish_space() {
  const Frame* newest = shown_->frame_set().newest();
  SpaceGrid grid;
  if (has_space_ && newest) {
    const OpenScene& scene = *scene_;
    grid = find_space_grid(shown_->frame_set(),
                           box_around(scene.robot->model(), newest->pose,
                                      0.5 * scene.robot->settings().distance.range_m));
  }
  publish_("space", space_message(grid));
}

std::size_t ViewedScene::camera_in(const Request& request) const {
  const auto camera = request.at("camera").get<std::size_t>();
  if (camera < scene_->cameras.size()) return camera;
  throw std::runtime_error(
      fmt::format("camera {}: expected a number from 0 to {}", camera, scene_->cameras.size() - 1));
}

void ViewedScene::tell(bool is_refused, const std::string& text) {
  publish_(
      fmt::format("notice {}", notices_ % kNoticeKinds),
      json_message(
          {{"type", "notice"}, {"number", notices_}, {"is_refused", is_refused}, {"text", text}}));
  ++notices_;
}

}  // namespace berth::app
