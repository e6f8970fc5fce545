#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "berth/pipeline/request.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/types/closest_pair.hpp"
#include "berth/types/status.hpp"
#include "berth/types/verdict.hpp"

namespace berth {

class KnownWorkspace;

/// How much room the links need.
struct ConfigurationMargins {
  /// Of every moved link, finite and at least 0.
  double margin_m = 0.03;
  /// Other margins, by the links' names.
  std::vector<std::pair<std::string, double>> of_links = {};
  /// These are not asked about.
  std::vector<std::string> without = {};
  /// Of the pairs of LinkResult::known: to the environment, the robot's other links and other
  /// robots. None: they are not asked about, and `free` says nothing of them.
  std::optional<double> known_margin_m = std::nullopt;
};

/// Whether a robot would be free at each of very many configurations, or on motions between them,
/// for what the cameras see now: for planners and sampling controllers. Verdicts speak of the
/// distances that Query gives, occupied and unknown alike (D8), and with known_margin_m of those to
/// what is known: `free` and `near` are certified.
///
/// Once prepared, any number of threads may ask; asking allocates nothing once warm.
class ConfigurationCheck {
 public:
  /// Covers the links with balls: up to a tenth of a second for each moved one.
  explicit ConfigurationCheck(std::shared_ptr<const Robot> robot);
  ~ConfigurationCheck();
  ConfigurationCheck(const ConfigurationCheck&) = delete;
  ConfigurationCheck& operator=(const ConfigurationCheck&) = delete;

  /// Takes up the newest frame of each camera, as Query::ask does: ages are judged at now_s, or at
  /// the newest of their stamps; X_WB is where the root stands in the configurations. Takes some
  /// ten milliseconds. The frames have to outlive the questions. Nobody may ask meanwhile. Returns
  /// degraded where a camera is left out or not relied on: more may be free than with it. Where it
  /// is stale, nothing is known, and all verdicts are `undecided`.
  ResultStatus prepare(const NewestFrames& frames, std::optional<double> now_s = {},
                       const std::optional<Pose>& X_WB = {});

  static constexpr double kMostMotion = 100;  ///< rad or m

  /// One verdict for each configuration: positions in the order of RobotModel::joints, one
  /// configuration after another. Spread over the threads that TBB has. Throws
  /// std::invalid_argument where numbers do not fit, are not finite, or a link is not known.
  void ask(std::span<const double> positions, const ConfigurationMargins& margins,
           std::span<Verdict> verdicts) const;

  /// The same for straight motions in joint space, from each configuration of `from` to that of
  /// `to` at its place. A motion is near where one of its configurations is shown to be. One in
  /// which a joint goes by more than kMostMotion is refused: it is cut into parts.
  void ask_motions(std::span<const double> from, std::span<const double> to,
                   const ConfigurationMargins& margins, std::span<Verdict> verdicts) const;

  /// Has the exact search decide what is undecided, up to a millisecond each. What is still
  /// undecided then is as near to its margin as the distances' tolerance. Links' own margins count.
  void resolve(std::span<const double> positions, const ConfigurationMargins& margins,
               std::span<Verdict> verdicts) const;

  const Robot& robot() const { return *robot_; }

 private:
  struct State;
  struct Margins;
  void find_margins(const ConfigurationMargins& margins, Margins& out) const;
  /// Hands parts of the verdicts to `check`, on all threads.
  template <class Check>
  void check_all(const ConfigurationMargins& margins, std::span<Verdict> verdicts,
                 const Check& check) const;
  void require(std::span<const double> positions, std::size_t verdicts) const;
  /// The least of all links' distances, and of their bounds.
  KnownPair find_known(const JointState& joints, KnownWorkspace& workspace) const;

  std::shared_ptr<const Robot> robot_;
  std::unique_ptr<State> state_;
};

}  // namespace berth
