#include "berth/calibration/detection_map.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "berth/calibration/drawn_ball.hpp"
#include "berth/calibration/robot_reach.hpp"
#include "berth/calibration/swallowed.hpp"

namespace berth {
namespace {

constexpr double kNotInView = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostDraws = 100;
/// This number of draws, none missed, proves as much as 100 of which one is missed.
constexpr int kEnoughInView = 50;
constexpr int kLeastInView = 20;
constexpr double kMostPlaces = 600;

/// A grid over the ball whose cubes have so large an edge that there are not too many.
void make_places(DetectionMap& map) {
  const double radius_m = map.reach.radius_m;
  const double volume_m3 = 4 / 3.0 * EIGEN_PI * std::pow(radius_m, 3);
  map.step_m = std::max(0.05, std::ceil(100 * std::cbrt(volume_m3 / kMostPlaces)) / 100);
  const int most = static_cast<int>(radius_m / map.step_m);
  for (int z = -most; z <= most; ++z) {
    for (int y = -most; y <= most; ++y) {
      for (int x = -most; x <= most; ++x) {
        const Eigen::Vector3d off_m = map.step_m * Eigen::Vector3d(x, y, z);
        if (off_m.norm() <= radius_m) map.places_B_m.push_back(map.reach.center_B_m + off_m);
      }
    }
  }
}

/// What became of the draws of one diameter at one place.
struct Tally {
  int in_view = 0;
  bool is_missed = false;

  bool is_settled() const { return is_missed || in_view >= kEnoughInView; }
};

/// What became of one ball.
enum class Sight : std::uint8_t { none, missed, told };

/// Balls of one camera's image that are far enough from one another to be drawn at once.
struct Batch {
  std::size_t camera;
  std::vector<std::size_t> places;
  std::vector<DrawnBall> balls;
};

class Measurement {
 public:
  Measurement(const std::vector<DetectionCamera>& cameras, DetectionMap& map)
      : cameras_(cameras), map_(map) {
    const std::size_t count = map.places_B_m.size();
    map.cameras.resize(cameras.size());
    for (std::size_t by = 0; by <= cameras.size(); ++by) {
      told_by(by).least_m.assign(count, std::numeric_limits<double>::infinity());
    }
    is_open_.assign((cameras.size() + 1) * count, true);
  }

  void draw_all_of(double diameter_m, const std::function<void()>& pause) {
    tallies_.assign(is_open_.size(), {});
    for (int draw = 0; draw < kMostDraws; ++draw) {
      pause();
      sights_.assign(is_open_.size(), Sight::none);
      place_balls(draw, diameter_m / 2);
      look_at_batches(draw);
      count();
    }
    take_passed(diameter_m);
  }

 private:
  std::size_t place_count() const { return map_.places_B_m.size(); }
  /// The cameras' results, and behind them that of the cell.
  DetectedDiameters& told_by(std::size_t by) {
    return by < cameras_.size() ? map_.cameras[by] : map_.cell;
  }
  std::size_t index(std::size_t by, std::size_t place) const { return by * place_count() + place; }

  bool is_asked(std::size_t by, std::size_t place) const {
    const std::size_t i = index(by, place);
    return is_open_[i] && !tallies_[i].is_settled();
  }
  bool is_asked(std::size_t place) const {
    for (std::size_t by = 0; by <= cameras_.size(); ++by) {
      if (is_asked(by, place)) return true;
    }
    return false;
  }

  const DetectionImage& image(std::size_t camera, int draw) const {
    const auto& images = cameras_[camera].images;
    return images[images.size() * static_cast<std::size_t>(draw) / kMostDraws];
  }

  /// Fills batches_.
  void place_balls(int draw, double radius_m) {
    batches_.clear();
    std::vector<BallRoom> rooms;
    for (std::size_t place = 0; place < place_count(); ++place) {
      if (!is_asked(place)) continue;
      const double half_m = map_.step_m / 2;
      Eigen::Vector3d center_B_m = map_.places_B_m[place];
      for (double& x : center_B_m) x += random_(-half_m, half_m);
      const auto balls = balls_at(center_B_m, draw, radius_m);
      for (std::size_t c = 0; c < balls.size(); ++c) {
        if (balls[c]) put(c, place, *balls[c], rooms);
      }
    }
  }

  /// As each camera sees the ball; empty where it cannot be there in one of the images.
  std::vector<std::optional<DrawnBall>> balls_at(const Eigen::Vector3d& center_B_m, int draw,
                                                 double radius_m) const {
    std::vector<std::optional<DrawnBall>> balls;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      BallPlace found;
      if (!cameras_[c].images.empty()) {
        found = ball_at(cameras_[c].camera, image(c, draw), center_B_m, radius_m);
      }
      if (!found.is_possible) return {};
      balls.push_back(found.ball);
    }
    return balls;
  }

  /// Into the first batch of the camera that has room.
  void put(std::size_t camera, std::size_t place, const DrawnBall& ball,
           std::vector<BallRoom>& rooms) {
    std::size_t b = 0;
    while (b < batches_.size() &&
           !(batches_[b].camera == camera && rooms[b].take(cameras_[camera].camera, ball)))
      ++b;
    if (b == batches_.size()) {
      batches_.push_back({camera, {}, {}});
      rooms.emplace_back(cameras_[camera].camera).take(cameras_[camera].camera, ball);
    }
    batches_[b].places.push_back(place);
    batches_[b].balls.push_back(ball);
  }

  void look_at_batches(int draw) {
    tbb::parallel_for(std::size_t{0}, batches_.size(), [&](std::size_t b) {
      const Batch& batch = batches_[b];
      const DetectionCamera& camera = cameras_[batch.camera];
      const DetectionImage& at = image(batch.camera, draw);
      auto& [filter, drawn] = scratch_.local();
      drawn = at.depth_m;
      for (const DrawnBall& ball : batch.balls) draw_ball(camera.camera, at.depth_m, ball, drawn);
      const ObstacleImage& left = filter.run(
          {&camera.camera, drawn, &at.robot, &camera.self_filter, &camera.sensor, &at.soft}, drawn);
      for (std::size_t i = 0; i < batch.balls.size(); ++i) {
        const bool is_left = is_told(batch.balls[i], at.depth_m, drawn, left);
        sights_[index(batch.camera, batch.places[i])] = is_left ? Sight::told : Sight::missed;
      }
    });
  }

  void count() {
    const std::size_t cell = cameras_.size();
    for (std::size_t place = 0; place < place_count(); ++place) {
      Sight& by_any = sights_[index(cell, place)];
      for (std::size_t c = 0; c < cell; ++c) {
        by_any = std::max(by_any, sights_[index(c, place)]);
      }
    }
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      if (tallies_[i].is_settled()) continue;
      tallies_[i].in_view += sights_[i] != Sight::none;
      tallies_[i].is_missed |= sights_[i] == Sight::missed;
    }
  }

  void take_passed(double diameter_m) {
    for (std::size_t by = 0; by <= cameras_.size(); ++by) {
      for (std::size_t place = 0; place < place_count(); ++place) {
        const std::size_t i = index(by, place);
        if (!is_open_[i] || tallies_[i].is_missed) continue;
        const bool is_in_view = tallies_[i].in_view >= kLeastInView;
        told_by(by).least_m[place] = is_in_view ? diameter_m : kNotInView;
        is_open_[i] = false;
      }
    }
  }

  struct Scratch {
    DrawnImageFilter filter;
    DepthImage drawn;
  };

  const std::vector<DetectionCamera>& cameras_;
  DetectionMap& map_;
  RepeatableRandom random_;
  /// Whether nothing is known yet, by camera and place; behind them those of the cell.
  std::vector<char> is_open_;
  std::vector<Tally> tallies_;
  std::vector<Sight> sights_;
  std::vector<Batch> batches_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace

int DetectedDiameters::in_view() const {
  return static_cast<int>(
      std::ranges::count_if(least_m, [](double one_m) { return !std::isnan(one_m); }));
}

int DetectedDiameters::told(double diameter_m) const {
  return static_cast<int>(
      std::ranges::count_if(least_m, [&](double one_m) { return one_m <= diameter_m; }));
}

double DetectedDiameters::median_m() const {
  std::vector<double> seen_m;
  std::ranges::copy_if(least_m, std::back_inserter(seen_m),
                       [](double one_m) { return !std::isnan(one_m); });
  if (seen_m.empty()) return kNotInView;
  const auto middle = seen_m.begin() + static_cast<std::ptrdiff_t>(seen_m.size() / 2);
  std::ranges::nth_element(seen_m, middle);
  return *middle;
}

double DetectedDiameters::worst_m() const {
  double worst_m = kNotInView;
  for (const double one_m : least_m) worst_m = std::fmax(worst_m, one_m);
  return worst_m;
}

std::size_t DetectedDiameters::worst_place() const {
  const double worst = worst_m();
  const auto at = std::ranges::find(least_m, worst);
  return at == least_m.end() ? 0 : static_cast<std::size_t>(at - least_m.begin());
}

DetectionMap measure_detection(const std::vector<DetectionCamera>& cameras, const RobotReach& reach,
                               const std::function<void()>& pause) {
  DetectionMap map;
  map.reach = reach;
  if (cameras.empty() || !(reach.radius_m > 0)) return map;
  make_places(map);
  Measurement measurement(cameras, map);
  for (const double diameter_m : kDrawnDiameters_m) measurement.draw_all_of(diameter_m, pause);
  return map;
}

}  // namespace berth
