#pragma once

#include <memory>
#include <string>
#include <vector>

#include "berth/pipeline/request.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/pipeline/timeliness.hpp"

namespace berth {

class FrameSet;
class LinkSearches;
class LookAheadSearch;

/// The controller's clock: requests about the newest frames of one to eight cameras. One for each
/// thread; several may ask the same frames at the same time. Between two requests it keeps what
/// the frames left of space, until one of them is replaced or may not be used any more. Once warm,
/// nothing allocates (LookAhead apart).
class Query {
 public:
  /// `camera_names` are those of the cameras that have given no frame yet; a frame knows its own.
  explicit Query(std::shared_ptr<const Robot> robot, std::vector<std::string> camera_names = {});
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  /// Each frame belongs to another camera of one robot. Valid until the next request. Throws
  /// std::invalid_argument for wrong joints, for a JointBuffer without a time, and for a limit of
  /// the look-ahead that is no length.
  const Result& ask(const Request& request);

  /// A request begins with what is known of the one before. After this nothing is known: for who
  /// times requests, or wants the same result again to the last bit.
  void forget();

  const std::vector<std::string>& camera_names() const { return camera_names_; }

  /// What the frames of the last request leave of space.
  const FrameSet& frames() const { return *asked_; }

 private:
  /// Assembles the frames anew where one of them, or what may be done with it, has changed.
  void update_frames(const NewestFrames& newest, double now_s, const std::optional<Pose>& X_WB);
  /// Asks what was prepared, if it is as these cameras and this place of the root need it.
  bool take_prepared(const std::shared_ptr<const PreparedSpace>& prepared,
                     const std::optional<Pose>& X_WB);
  bool has_moved(const std::optional<Pose>& X_WB) const;
  bool has_changed(std::span<const Frame* const> frames) const;
  /// Judges stamps and joints, and reports the pose that is asked about.
  Timeliness find_pose(const JointState* joints, TimeStatus joints_status,
                       std::optional<double> now_s);
  void tell_cameras();
  void tell_ahead(const Request& request);

  std::shared_ptr<const Robot> robot_;
  std::vector<std::string> camera_names_;
  /// That of the requests: the query's own, or what `prepared_` holds.
  const FrameSet* asked_;
  std::unique_ptr<FrameSet> set_;
  std::shared_ptr<const PreparedSpace> prepared_;
  /// Where nothing is known of the request before, what was prepared is taken once more.
  bool goes_on_ = true;
  std::vector<std::uint64_t> numbers_;
  std::optional<Pose> X_WB_;
  std::vector<CameraState> cameras_;
  std::vector<CameraState> before_;
  JointState newest_;
  std::unique_ptr<LinkSearches> searches_;
  std::unique_ptr<LookAheadSearch> ahead_;
  Result result_;
};

/// An empty result for this robot: names of its links, range, nothing known.
void begin_result(const Robot& robot, Result& result);

/// What a camera's newest frame reports on it.
void tell_camera(const Exposure* exposure, const CameraState& state, CameraResult& out);
/// What became of the pixels of its newest image.
void tell_fates(const Frame& frame, CameraResult& out);

}  // namespace berth
