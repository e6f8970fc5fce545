#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "berth/pipeline/result.hpp"

namespace berth {

/// Where a result is not the recorded one.
struct ReplayDifference {
  /// Such as "links[arm_link_3].distance_m", with names as in JSON.
  std::string field;
  /// Both values as JSON.
  std::string recorded;
  std::string replayed;
};

/// Does once more what a Recorder recorded: makes frames of its images, prepares spaces, asks, and
/// updates the monitor, in its order, in this thread.
///
///     Replay replay("stop.mcap");
///     while (replay.next()) use(replay.result());
///
/// Results are the recorded ones to the last bit, on the same version of berth and a processor with
/// the same vector instructions. What a deadline or a stop_token cut short cannot be found again.
class Replay {
 public:
  /// Looks through the whole file. Throws std::runtime_error with file, what is wrong and what was
  /// expected: no MCAP file, one that is cut off or damaged, a part that is missing, no recording
  /// of berth, a setting outside of its domain.
  explicit Replay(const std::filesystem::path& file);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Asks the next request; false where there is none. Throws std::runtime_error for a message that
  /// is none of berth's.
  bool next();

  /// The rest of them is about that request. Its number in the recorder's life, and its time: what
  /// was told for now, else that of the newest image; s.
  std::int64_t number() const;
  double time_s() const;
  const Result& result() const;
  /// A line of berth/result/3.
  const std::string& recorded() const;
  /// None where both are the same to the last bit.
  const std::optional<ReplayDifference>& difference() const;
  /// The difference as a sentence, with what explains it where that is known; empty: none.
  std::string text() const;
  /// Images that are missing between this request and the one before, because the disk was too
  /// slow.
  std::int64_t lost_images() const;
  std::int64_t lost_requests() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// What replay() found.
struct ReplaySummary {
  std::int64_t requests = 0;
  /// How many results are not the recorded ones.
  std::int64_t different = 0;
  /// Replay::text() of the first of them.
  std::string first_difference;
  std::int64_t lost_images = 0;
  std::int64_t lost_requests = 0;
};

/// Replays a whole recording. Throws as Replay does.
ReplaySummary replay(const std::filesystem::path& file);

}  // namespace berth
