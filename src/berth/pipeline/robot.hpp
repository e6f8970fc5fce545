#pragma once

#include <memory>
#include <string>
#include <vector>

#include "berth/distance/settings.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/robot/attachment.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

class LinkMeshes;
struct KnownModel;
struct RobotPatches;
struct SamplePoints;

/// How requests about a robot are answered, whichever cameras see it.
struct EvaluationSettings {
  DistanceSettings distance;
  /// Whether results tell what the cameras cannot know (LinkResult::visibility).
  bool visibility = true;
  /// How many pairs of each link are told, its own and LinkResult::candidates together.
  int candidates = 1;
  /// Whether each pair tells how its distance changes with the joints (ToldPair::gradient).
  bool gradient = false;
  TimeSettings time;

  bool operator==(const EvaluationSettings&) const = default;
};

/// The list of these settings but `time`, which has a list of its own.
template <SettingsOf<EvaluationSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit_settings(s.distance, visit);
  visit(
      {"visibility",
       {},
       "whether to tell how much of each link and of the space around its answer the cameras see"},
      s.visibility);
  visit({"candidates",
         {.least = 1, .most = 8},
         "how many pairs of each link are told, at least 5 cm apart on it: what a controller needs "
         "between two obstacles"},
        s.candidates);
  visit({"gradient", {}, "whether each pair tells how its distance changes with each joint"},
        s.gradient);
}

/// A robot and what is asked about it: constant once made, shared by all views, observers and
/// askers, and their threads.
class Robot {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected.
  explicit Robot(RobotModel model, EvaluationSettings settings = {},
                 std::vector<Attachment> attached = {});

  /// With all that is attached to it.
  const RobotModel& model() const { return model_; }
  /// Without what is attached.
  const RobotModel& bare() const { return bare_; }
  const std::vector<Attachment>& attached() const { return attached_; }
  /// The same robot with this on it, and nothing else. Throws as the constructor does.
  std::shared_ptr<const Robot> with(std::vector<Attachment> attached) const;
  const EvaluationSettings& settings() const { return settings_; }
  const std::shared_ptr<const LinkMeshes>& meshes() const { return meshes_; }
  const std::shared_ptr<const RobotPatches>& patches() const { return patches_; }
  /// The links' eighths, each a link of its own. Made by the first call, which takes as long as a
  /// robot does.
  const RobotPatches& eighths() const;
  /// Where it is looked for what the cameras see of the robot.
  const SamplePoints& sample_points() const { return *sample_points_; }
  /// Which links are looked at for each other. Found by the first call, which takes milliseconds.
  const KnownModel& known() const;

 private:
  RobotModel bare_;
  std::vector<Attachment> attached_;
  RobotModel model_;
  EvaluationSettings settings_;
  std::shared_ptr<const LinkMeshes> meshes_;
  std::shared_ptr<const RobotPatches> patches_;
  std::shared_ptr<const SamplePoints> sample_points_;
  struct Known;
  std::shared_ptr<Known> known_;
  struct Eighths;
  std::shared_ptr<Eighths> eighths_;
  /// Shared by all that have the same bare robot.
  struct Touching;
  std::shared_ptr<Touching> touching_;

  bool has_nothing_on(std::size_t link) const;

  friend std::shared_ptr<const Robot> with_settings(const std::shared_ptr<const Robot>& robot,
                                                    const EvaluationSettings& settings);
};

/// The robot as it is once it has taken something up. Constant robots are not changed: make views
/// (with_robot), observers and askers of the new one, and ask no frames of the former.
/// Throws as with_attachment does, and for a name that is attached already.
std::shared_ptr<const Robot> attach(const Robot& robot, const Attachment& attachment);

/// And once it has put it down. Throws std::invalid_argument where nothing of this name is
/// attached.
std::shared_ptr<const Robot> detach(const Robot& robot, const std::string& name);

/// The same robot, asked otherwise; `robot` itself where the settings are the same. Throws as its
/// constructor does.
std::shared_ptr<const Robot> with_settings(const std::shared_ptr<const Robot>& robot,
                                           const EvaluationSettings& settings);

}  // namespace berth
