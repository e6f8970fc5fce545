// Inside separation/ only: the greatest speed whose stop is clear all along the robot's way.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "berth/distance/clearance.hpp"
#include "berth/separation/braking_path.hpp"
#include "berth/separation/settings.hpp"

namespace berth {

/// What one link needs, and what is known of it where it is now.
struct PathLink {
  /// No joint moves it: it needs nothing.
  bool is_moved = false;
  /// C + Z_d + Z_r.
  double added_m = 0;
  /// Nothing is nearer to it now, by what the cameras see.
  double known_m = 0;
  /// Something else may be so near now, by a policy for what is not known; known_m or less.
  double assumed_m = 0;
};

/// The arguments of the certificate.
struct PathRequest {
  const RobotPose& pose;
  const PlannedMotion& motion;
  const UnknownSpace& space;
  /// FrameSet::undecided(), which is unknown space as well; null: there is none.
  const UnknownSpace* undecided = nullptr;
  /// From the exposure to the moment at which the robot begins to brake.
  double reaction_time_s = 0;
  /// From the joints' stamp to that moment.
  double travel_time_s = 0;
  /// Of the robot's fastest point, at full speed, and with what it may gain.
  double planned_m_s = 0;
  double robot_m_s = 0;
  /// At this speed it need not brake any more: a contact is tolerable.
  double contact_m_s = 0;
  std::span<const PathLink> links;
};

/// The scale that was found.
struct PathScale {
  double scale = 0;
  /// The link that lets the robot go no faster, by its place; -1: none.
  int link = -1;
};

/// For all links and all places x where the robot may be from the request until it stands, or a
/// contact is tolerable:
///   lower bound(link at x) >= v_h (T_r + T(x)) + C + Z_d + Z_r
/// T(x) is how long it may brake and still be at x, whatever it did during the reaction time. Of
/// no place in between only a sample is looked at: what a bound at one pose says of the others is
/// less by how far the link moves. Once made, nothing allocates.
class PathCertificate {
 public:
  /// Pieces that all clearances of one request may take apart, most of them of less than a
  /// microsecond. What they did not show by then is taken for too near.
  static constexpr int kMostSteps = 200;

  PathCertificate(std::shared_ptr<const Robot> robot, const SeparationSettings& settings,
                  const std::vector<HullPoints>& hulls);

  /// The greatest scale of at most `most` that is shown, at least `least`, which is taken for
  /// shown. Begins at `before`, that of the request before.
  PathScale greatest_scale(const PathRequest& request, double least, double before, double most);
  /// Pieces that the last request's clearances took apart.
  int steps() const { return steps_; }
  /// The place of the link that is looked at first, since it was the first that was too near; -1:
  /// none was yet.
  int critical_link() const { return critical_; }
  void begin_with(int critical_link) { critical_ = critical_link; }

 private:
  using Node = std::size_t;
  /// What was found out of a link at a node.
  struct Known {
    double clear_m = 0;
    double nearest_m = 0;
  };
  /// What a link needs at both ends of a piece, so that it has what it needs in between: what is
  /// needed there lies below the line between both, or below one up to a corner, at this share of
  /// the piece, and then as much as at the end. How far the link moves lies below a line, too.
  struct PieceNeed {
    double before_m;
    double after_m;
    double corner = 1;
  };
  /// A part of the way, from a node to another.
  struct Stretch {
    int first;
    int last;
  };

  bool lay(const PathRequest& request, double scale);
  bool is_shown(const PathRequest& request, double scale);
  /// Sets rising_m_ and most_needed_m_; the node where the robot stands, -1 where the
  /// way is not known so far.
  int find_needs(const PathRequest& request, double scale);
  double turning_m(double scale, double stopping_s, double travel_s) const;
  bool is_link_clear(const PathRequest& request, std::size_t i, int last);
  bool is_clear(const PathRequest& request, std::size_t i, Stretch stretch, int depth);
  bool covers(std::size_t i, int sample, double clear_m, int piece);
  bool is_covered(std::size_t i, int piece);
  /// Without what each link adds.
  double needed_at(int node) const {
    return std::min(most_needed_m_, rising_m_[static_cast<Node>(node)]);
  }
  PieceNeed need_in(std::size_t i, int piece) const;
  /// How much room at a sample shows that all of the piece has what it needs.
  double needed_for(std::size_t i, int sample, int piece);
  double needed_from(std::size_t i, int sample, Stretch stretch);
  /// Whether the link has so much room at a node; asks where it is not known yet.
  bool has_room(const PathRequest& request, std::size_t i, int node, double needed_m);
  double moved_m(std::size_t i, int from, int node);
  Known& known(std::size_t i, int node) {
    return known_[i * BrakingPath::kNodes + static_cast<Node>(node)];
  }

  std::shared_ptr<const Robot> robot_;
  SeparationSettings settings_;
  BrakingPath path_;
  ClearanceWorkspace workspace_;
  std::vector<Known> known_;
  /// By link and both nodes; negative where not known yet.
  std::vector<double> moved_m_;
  std::vector<double> added_m_;
  /// The need grows with the way, up to the most.
  std::array<double, BrakingPath::kNodes> rising_m_ = {};
  double most_needed_m_ = 0;
  bool is_straight_ = true;
  int critical_ = -1;
  int steps_ = 0;
};

}  // namespace berth
