#include "berth/separation/path_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "berth/separation/protective_distance.hpp"

namespace berth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The scale is found to this. Below that of the request before it is looked for at once, then each
/// time so much farther below.
constexpr double kScaleStep = 0.004, kFartherBelow = 3;
/// A stretch is halved so often before it is taken for too near.
constexpr int kMostDepth = 2;

}  // namespace

PathCertificate::PathCertificate(std::shared_ptr<const Robot> robot,
                                 const SeparationSettings& settings,
                                 const std::vector<HullPoints>& hulls)
    : robot_(std::move(robot)), settings_(settings), path_(robot_, hulls) {
  known_.resize(hulls.size() * BrakingPath::kNodes);
  moved_m_.resize(hulls.size() * BrakingPath::kNodes * BrakingPath::kNodes);
  added_m_.resize(hulls.size());
}

PathScale PathCertificate::greatest_scale(const PathRequest& request, double least, double before,
                                          double most) {
  steps_ = 0;
  PathScale out{least, -1};
  if (!(most > least) || !lay(request, most)) return out;
  if (is_shown(request, most)) return {most, -1};
  double too_much = most;
  const auto try_scale = [&](double scale) {
    if (!(scale > out.scale && scale < too_much)) return;
    if (is_shown(request, scale)) {
      out.scale = scale;
    } else {
      too_much = scale;
    }
  };
  try_scale(before);
  for (double fall = kScaleStep; out.scale <= least && too_much - fall > least;
       fall *= kFartherBelow) {
    try_scale(too_much - fall);
  }
  while (too_much - out.scale > kScaleStep) try_scale((out.scale + too_much) / 2);
  out.link = critical_;
  return out;
}

bool PathCertificate::lay(const PathRequest& request, double scale) {
  is_straight_ = request.motion.path.empty();
  const Stopping stopping =
      stopping_from(settings_, scale * request.robot_m_s, request.contact_m_s);
  if (std::isinf(stopping.distance_m)) return false;
  constexpr double kRoom = 1.05;
  double end_s = kRoom * scale * request.travel_time_s;
  if (request.robot_m_s > 0) end_s += kRoom * stopping.distance_m / request.robot_m_s;
  // Where the way becomes slower, as in its corners, the same distance takes more of it.
  constexpr int kMostTries = 4;
  constexpr double kFarther = 1.6;
  for (int i = 0; i < kMostTries; ++i, end_s *= kFarther) {
    if (!path_.lay(request.pose, request.motion, end_s)) return false;
    if (find_needs(request, scale) >= 0) break;
  }
  std::ranges::fill(moved_m_, -1.0);
  for (std::size_t i = 0; i < request.links.size(); ++i) {
    added_m_[i] = request.links[i].added_m;
    for (int n = 0; n < BrakingPath::kNodes; ++n) known(i, n) = {0, kInfinity};
    known(i, 0).clear_m = request.links[i].known_m;
  }
  return true;
}

// Straight on is what is known. The robot may turn and speed up meanwhile, each by what it may
// accelerate at full speed: during the reaction, by what it gained then, and while it brakes on a
// way that bends.
double PathCertificate::turning_m(double scale, double stopping_s, double travel_s) const {
  if (!is_straight_) return 0;
  const double a = scale * settings_.acceleration_m_s2;
  return a * (travel_s * travel_s / 2 + travel_s * stopping_s / 2 + stopping_s * stopping_s / 4);
}

int PathCertificate::find_needs(const PathRequest& request, double scale) {
  const double travelled_s = scale * request.travel_time_s;
  int braked = 0;
  while (braked < BrakingPath::kPieces && path_.time_s(braked) < travelled_s) ++braked;
  const double full_m_s =
      is_straight_ ? request.robot_m_s : std::max(request.planned_m_s, path_.fastest_m_s(braked));
  const Stopping stopping = stopping_from(settings_, scale * full_m_s, request.contact_m_s);
  if (std::isinf(stopping.distance_m)) return -1;
  const double turning_m = this->turning_m(scale, stopping.time_s, request.travel_time_s);
  // Straight on, what was gained in speed goes anywhere; it is in turning_m.
  const double along = is_straight_ && full_m_s > 0 ? request.planned_m_s / full_m_s : 1;
  const double end_m = path_.way_m(braked) + along * stopping.distance_m;
  const auto needed_in = [&](double braking_s) {
    return settings_.human_speed_m_s * (request.reaction_time_s + braking_s) + turning_m;
  };
  most_needed_m_ = needed_in(stopping.time_s);
  // By a table nobody looks farther than to the most (need_in).
  const double most_m_s = settings_.stopping.empty() ? kInfinity : scale * full_m_s;
  for (int n = 0; n < BrakingPath::kNodes; ++n) {
    // Stopping right here takes the longest.
    const double braking_s = along > 0
                                 ? time_to_stop_within_s(settings_, path_.most_way_m(n) / along,
                                                         most_m_s, request.contact_m_s)
                                 : stopping.time_s;
    rising_m_[static_cast<Node>(n)] = needed_in(braking_s);
    if (n >= braked && path_.way_m(n) >= end_m) return n;
  }
  return -1;
}

bool PathCertificate::is_shown(const PathRequest& request, double scale) {
  const int last = find_needs(request, scale);
  if (last < 0) return false;
  // What was too near the last time is the first to be too near now.
  if (critical_ >= 0 && !is_link_clear(request, static_cast<std::size_t>(critical_), last)) {
    return false;
  }
  for (std::size_t i = 0; i < request.links.size(); ++i) {
    if (static_cast<int>(i) == critical_ || is_link_clear(request, i, last)) continue;
    critical_ = static_cast<int>(i);
    return false;
  }
  return true;
}

double PathCertificate::moved_m(std::size_t i, int from, int node) {
  const auto place = (i * BrakingPath::kNodes + static_cast<Node>(from)) * BrakingPath::kNodes +
                     static_cast<Node>(node);
  if (moved_m_[place] < 0) moved_m_[place] = path_.moved_m(i, from, node);
  return moved_m_[place];
}

PathCertificate::PieceNeed PathCertificate::need_in(std::size_t i, int piece) const {
  const auto before = static_cast<Node>(piece), after = before + 1;
  // The nodes' ways are known to some bends; away from the start the root is flat.
  constexpr double kBends = 5;
  const double bend_m = kBends * path_.bend_m(i, piece) + added_m_[i];
  const double most_m = most_needed_m_ + bend_m;
  // At the start the root is steep, and a brake's table may be any curve.
  if (piece == 0 || !settings_.stopping.empty()) {
    return {needed_at(piece + 1) + bend_m, needed_at(piece + 1) + bend_m};
  }
  // The need grows with the root of the way, which lies above the line between two nodes by
  // a quarter of (root q - root p)^2 / (root q + root p), until it is the most.
  const double growth_m = rising_m_[after] - rising_m_[before];
  const double roots_m = rising_m_[after] + rising_m_[before] - 2 * rising_m_[0];
  const double above_m = roots_m > 0 ? growth_m * growth_m / (4 * roots_m) : 0;
  const double from_m = rising_m_[before] + above_m + bend_m;
  const double to_m = rising_m_[after] + above_m + bend_m;
  const bool has_corner = from_m < most_m && most_m < to_m;
  return {std::min(from_m, most_m), std::min(to_m, most_m),
          has_corner ? (most_m - from_m) / (to_m - from_m) : 1};
}

double PathCertificate::needed_for(std::size_t i, int sample, int piece) {
  const PieceNeed need = need_in(i, piece);
  const double before_m = moved_m(i, sample, piece), after_m = moved_m(i, sample, piece + 1);
  return std::max({need.before_m + before_m, need.after_m + after_m,
                   need.after_m + before_m + need.corner * (after_m - before_m)});
}

bool PathCertificate::covers(std::size_t i, int sample, double clear_m, int piece) {
  return clear_m >= needed_for(i, sample, piece);
}

bool PathCertificate::is_covered(std::size_t i, int piece) {
  for (int n = 0; n < BrakingPath::kNodes; ++n) {
    const double clear_m = known(i, n).clear_m;
    if (clear_m > 0 && covers(i, n, clear_m, piece)) return true;
  }
  return false;
}

double PathCertificate::needed_from(std::size_t i, int sample, Stretch stretch) {
  double needed_m = needed_at(sample) + added_m_[i];
  for (int p = stretch.first; p < stretch.last; ++p) {
    needed_m = std::max(needed_m, needed_for(i, sample, p));
  }
  constexpr double kRounding_m = 1e-9;
  return needed_m + kRounding_m;
}

bool PathCertificate::has_room(const PathRequest& request, std::size_t i, int node,
                               double needed_m) {
  Known& at = known(i, node);
  if (at.clear_m >= needed_m) return true;
  if (at.nearest_m < needed_m || steps_ >= kMostSteps) return false;
  const bool unknown = settings_.unknown != UnknownPolicy::ignore;
  const auto look = [&](const UnknownSpace& space, bool with_unknown) {
    const Clearance found = find_clearance(
        robot_->patches()->links[i], path_.X_BL(i, node), space,
        {.needed_m = needed_m, .unknown = with_unknown, .most_steps = kMostSteps - steps_},
        workspace_);
    steps_ += found.steps;
    return found;
  };
  Clearance found = look(request.space, unknown);
  if (found.is_clear && unknown && request.undecided) found = look(*request.undecided, false);
  if (found.is_clear) {
    at.clear_m = needed_m;
  } else {
    // Where the search was given up, no more is asked for either.
    at.nearest_m = std::min<double>(found.nearest_m, needed_m);
  }
  return found.is_clear;
}

bool PathCertificate::is_clear(const PathRequest& request, std::size_t i, Stretch stretch,
                               int depth) {
  while (stretch.first < stretch.last && is_covered(i, stretch.first)) ++stretch.first;
  while (stretch.first < stretch.last && is_covered(i, stretch.last - 1)) --stretch.last;
  if (stretch.first == stretch.last) return true;
  const int middle = (stretch.first + stretch.last) / 2;
  const double from_end_m = needed_from(i, stretch.last, stretch);
  const double from_middle_m = needed_from(i, middle, stretch);
  const int sample = from_end_m <= from_middle_m ? stretch.last : middle;
  const double here_m = needed_at(sample) + added_m_[i];
  if (has_room(request, i, sample, std::min(from_end_m, from_middle_m))) return true;
  if (known(i, sample).nearest_m < here_m) return false;
  if (depth == kMostDepth || stretch.last - stretch.first == 1) return false;
  return is_clear(request, i, {middle, stretch.last}, depth + 1) &&
         is_clear(request, i, {stretch.first, middle}, depth + 1);
}

bool PathCertificate::is_link_clear(const PathRequest& request, std::size_t i, int last) {
  const PathLink& link = request.links[i];
  if (!link.is_moved) return true;
  const double here_m = needed_at(0) + added_m_[i];
  if (last == 0) return link.assumed_m >= here_m && has_room(request, i, 0, here_m);
  if (link.assumed_m < link.known_m) {
    // Where it is, is not known: it may be wherever the link goes.
    for (int p = 0; p < last; ++p) {
      if (!covers(i, 0, link.assumed_m, p)) return false;
    }
  }
  return is_clear(request, i, {0, last}, 0);
}

}  // namespace berth
