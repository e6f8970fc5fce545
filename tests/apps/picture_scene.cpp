#include "tests/apps/picture_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace berth::app {
namespace {

constexpr double kRange_m = 1.0;

/// A place in the image, in image heights; x from the image's middle.
struct Place {
  double x = 0;
  double y = 0;
};

double distance_to_segment(Place p, Place a, Place b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double t =
      std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

Place place(const DepthImage& image, int u, int v) {
  const double h = image.height();
  return {(u + 0.5 - image.width() / 2.0) / h, (v + 0.5) / h};
}

/// Puts what `shape` covers into the image; shape(place) is a depth in metres, NaN beside it.
template <typename Shape>
void put(DepthImage& image, const Shape& shape) {
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double depth_m = shape(place(image, u, v));
      if (!(depth_m >= image(u, v))) image(u, v) = std::isnan(depth_m) ? image(u, v) : depth_m;
    }
  }
}

/// A bar with round ends; a pixel's depth falls by what its thickness is at that depth.
auto bar(Place a, Place b, double radius, double depth_m) {
  return [=](Place p) -> double {
    const double d = distance_to_segment(p, a, b);
    return d > radius ? NAN : depth_m - depth_m * std::sqrt(radius * radius - d * d);
  };
}

auto box(Place corner, Place opposite, double depth_m) {
  return [=](Place p) -> double {
    const bool in = p.x > corner.x && p.x < opposite.x && p.y > corner.y && p.y < opposite.y;
    return in ? depth_m + 0.25 * (p.x - corner.x) : NAN;
  };
}

double table_depth_m(Place p) {
  const bool on = p.y > 0.80 && p.y < 0.985 && std::abs(p.x) < 0.18 + 0.5 * (p.y - 0.5);
  return on ? 1.3 / (p.y - 0.1) : NAN;
}

DepthImage make_room(int width_px, int height_px) {
  DepthImage room(width_px, height_px, 3.6F);
  put(room, [](Place p) { return p.y > 0.62 ? 2.25 / p.y : NAN; });
  put(room, box({-0.62, 0.52}, {-0.36, 0.86}, 2.1));
  put(room, box({-0.50, 0.05}, {-0.33, 0.30}, 1.9));
  put(room, table_depth_m);
  put(room, bar({0.42, 0.20}, {0.42, 0.22}, 0.075, 1.75));
  put(room, bar({0.42, 0.42}, {0.43, 0.62}, 0.125, 1.75));
  put(room, bar({0.33, 0.38}, {0.235, 0.50}, 0.035, 1.65));
  put(room, bar({0.235, 0.50}, {0.17, 0.42}, 0.03, 1.55));
  put(room, bar({0.38, 0.70}, {0.38, 0.98}, 0.05, 1.75));
  put(room, bar({0.47, 0.70}, {0.47, 0.98}, 0.05, 1.75));
  return room;
}

/// Along the arm from its foot (0) to its hand (1).
Place arm(double s, bool snake) {
  if (snake) return {-0.25 + 0.5 * s, 0.5 + 0.28 * std::cos(5 * std::numbers::pi * s)};
  constexpr Place kJoints[] = {{-0.12, 0.88}, {-0.12, 0.72}, {-0.17, 0.55}, {-0.11, 0.40},
                               {0.0, 0.33},   {0.08, 0.35},  {0.10, 0.43}};
  const int joint = std::min(5, static_cast<int>(6 * s));
  const double t = 6 * s - joint;
  return {std::lerp(kJoints[joint].x, kJoints[joint + 1].x, t),
          std::lerp(kJoints[joint].y, kJoints[joint + 1].y, t)};
}

RobotImage make_robot(int width_px, int height_px, int links) {
  const bool snake = links > 16;
  RobotImage robot{DepthImage(width_px, height_px, kNoDepth),
                   Image<LinkId>(width_px, height_px, kNoLink)};
  for (int i = 0; i + 1 < links; ++i) {
    const double s = double(i) / (links - 1);
    const double radius = snake ? 0.017 : 0.062 * (1 - 0.5 * s);
    DepthImage link(width_px, height_px, kNoDepth);
    put(link,
        bar(arm(s, snake), arm(double(i + 0.92) / (links - 1), snake), radius, 1.6 - 0.1 * s));
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) {
        if (std::isnan(link(u, v)) || robot.depth_m(u, v) <= link(u, v)) continue;
        robot.depth_m(u, v) = link(u, v);
        robot.link_id(u, v) = static_cast<LinkId>(i + 1);
      }
    }
  }
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double table_m = table_depth_m(place(robot.depth_m, u, v));
      if (std::isnan(table_m) || robot.depth_m(u, v) <= table_m) continue;
      robot.depth_m(u, v) = static_cast<float>(table_m);
      robot.link_id(u, v) = kEnvironmentLink;
    }
  }
  return robot;
}

DepthImage make_sensor_depth(const DepthImage& room, const RobotImage& robot) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.004F);
  std::uniform_real_distribution<double> chance(0, 1);
  DepthImage sensor = room;
  for (int v = 0; v < room.height(); ++v) {
    for (int u = 0; u < room.width(); ++u) {
      if (robot.depth_m(u, v) < sensor(u, v)) sensor(u, v) = robot.depth_m(u, v);
      sensor(u, v) += noise(random);
      const Place p = place(room, u, v);
      const bool shadow = u > 6 && std::abs(room(u, v) - room(u - 6, v)) > 0.5;
      const bool glass = std::hypot((p.x + 0.15) / 1.6, p.y - 0.12) < 0.06;
      if (shadow || glass || chance(random) < 0.002) sensor(u, v) = kNoDepth;
    }
  }
  return sensor;
}

bool near_robot(const RobotImage& robot, int u, int v, int radius_px) {
  for (int dv = -radius_px; dv <= radius_px; ++dv) {
    for (int du = -radius_px; du <= radius_px; ++du) {
      const int u2 = std::clamp(u + du, 0, robot.link_id.width() - 1);
      const int v2 = std::clamp(v + dv, 0, robot.link_id.height() - 1);
      const LinkId id = robot.link_id(u2, v2);
      if (id != kNoLink && id != kEnvironmentLink && du * du + dv * dv <= radius_px * radius_px)
        return true;
    }
  }
  return false;
}

PixelFate fate_of(const DepthImage& room, const DepthImage& sensor, const RobotImage& robot, int u,
                  int v) {
  const int pad_px = std::max(2, room.height() / 80);
  const LinkId id = robot.link_id(u, v);
  if (std::isnan(sensor(u, v))) return PixelFate::no_reading;
  if (id == kEnvironmentLink) return PixelFate::environment;
  if (id != kNoLink)
    return room(u, v) < robot.depth_m(u, v) ? PixelFate::obstacle : PixelFate::robot;
  if (near_robot(robot, u, v, pad_px)) return PixelFate::padding;
  if (near_robot(robot, u, v, 2 * pad_px)) return PixelFate::padding;
  const Place p = place(room, u, v);
  if (std::hypot(p.x - 0.07, p.y - 0.70) < 0.022) return PixelFate::flying_patch;
  return PixelFate::obstacle;
}

ObstacleImage make_obstacles(const DepthImage& room, const DepthImage& sensor,
                             const RobotImage& robot) {
  ObstacleImage obstacles{sensor, Image<PixelFate>(room.width(), room.height()), {}, {}};
  for (int v = 0; v < room.height(); ++v) {
    for (int u = 0; u < room.width(); ++u) {
      const PixelFate fate = fate_of(room, sensor, robot, u, v);
      obstacles.fate(u, v) = fate;
      ++obstacles.count[static_cast<std::size_t>(fate)];
      if (fate != PixelFate::obstacle) obstacles.depth_m(u, v) = kNoDepth;
    }
  }
  return obstacles;
}

/// About what a search would find; every step-th pixel is enough for a picture.
PictureLink closest_pair(const RobotImage& robot, const DepthImage& obstacles, LinkId id) {
  const int step = std::max(1, obstacles.height() / 60);
  PictureLink best;
  best.id = id;
  for (int v = 0; v < obstacles.height(); v += step) {
    for (int u = 0; u < obstacles.width(); u += step) {
      if (robot.link_id(u, v) != id) continue;
      if (best.status == LinkStatus::stale) best.status = LinkStatus::none_in_range;
      const double z = robot.depth_m(u, v), m_per_px = z / (0.9 * obstacles.width());
      for (int v2 = 0; v2 < obstacles.height(); v2 += step) {
        for (int u2 = 0; u2 < obstacles.width(); u2 += step) {
          const double behind_m = std::max(0.0, obstacles(u2, v2) - z);
          const auto d =
              static_cast<float>(std::hypot((u2 - u) * m_per_px, (v2 - v) * m_per_px, behind_m));
          if (!(d <= kRange_m) || std::isnan(obstacles(u2, v2)) || best.distance_m <= d) continue;
          best.distance_m = d;
          best.status = LinkStatus::ok;
          best.robot_pixel = {u, v};
          best.obstacle_pixel = {u2, v2};
        }
      }
    }
  }
  return best;
}

}  // namespace

PictureInput PictureScene::input() const {
  return {sensor_depth_m, &robot,   &obstacles,
          &links,         kRange_m, "A made-up frame: an arm, a person, two boxes"};
}

PictureScene make_picture_scene(int width_px, int height_px, int links) {
  PictureScene scene;
  const DepthImage room = make_room(width_px, height_px);
  scene.robot = make_robot(width_px, height_px, links);
  scene.sensor_depth_m = make_sensor_depth(room, scene.robot);
  scene.obstacles = make_obstacles(room, scene.sensor_depth_m, scene.robot);
  for (int id = 1; id <= links; ++id) {
    scene.links.push_back(
        closest_pair(scene.robot, scene.obstacles.depth_m, static_cast<LinkId>(id)));
    scene.links.back().link =
        links > 16 ? fmt::format("segment_{}_of_the_snake_link", id) : fmt::format("link_{}", id);
  }
  PictureLink far;
  far.id = scene.links.front().id;
  far.link = scene.links.front().link;
  far.status = LinkStatus::none_in_range;
  scene.links.front() = far;
  return scene;
}

}  // namespace berth::app
