#include "markers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace berth_ros {
namespace {

using berth_msgs::msg::LinkDistance;
using visualization_msgs::msg::Marker;

std_msgs::msg::ColorRGBA color_of(const LinkDistance& link, double range_m) {
  const double near = 1 - std::clamp(link.distance_m / range_m, 0.0, 1.0);
  std_msgs::msg::ColorRGBA color;
  color.r = static_cast<float>(std::min(1.0, 3 * near));
  color.g = static_cast<float>(std::min(1.0, 1.5 * (1 - near)));
  color.a = link.obstacle_is != LinkDistance::OCCUPIED ? 0.5F : 1.0F;
  return color;
}

Marker marker(const std_msgs::msg::Header& header, const std::string& space, int id, int type) {
  Marker made;
  made.header = header;
  made.ns = space;
  made.id = id;
  made.type = type;
  made.pose.orientation.w = 1;
  return made;
}

geometry_msgs::msg::Point middle_of(const LinkDistance& link) {
  geometry_msgs::msg::Point middle;
  middle.x = (link.robot_point_base_m.x + link.obstacle_point_base_m.x) / 2;
  middle.y = (link.robot_point_base_m.y + link.obstacle_point_base_m.y) / 2;
  middle.z = (link.robot_point_base_m.z + link.obstacle_point_base_m.z) / 2;
  return middle;
}

void add_link(const LinkDistance& link, const std_msgs::msg::Header& header, double range_m,
              std::vector<Marker>& out) {
  const auto color = color_of(link, range_m);
  Marker line = marker(header, "lines", link.id, Marker::LINE_LIST);
  line.scale.x = link.obstacle_is != LinkDistance::OCCUPIED ? 0.002 : 0.005;
  line.color = color;
  line.points = {link.robot_point_base_m, link.obstacle_point_base_m};
  Marker ends = marker(header, "ends", link.id, Marker::SPHERE_LIST);
  ends.scale.x = ends.scale.y = ends.scale.z = 0.02;
  ends.color = color;
  ends.points = line.points;
  Marker length = marker(header, "lengths", link.id, Marker::TEXT_VIEW_FACING);
  length.pose.position = middle_of(link);
  length.scale.z = 0.04;
  length.color.r = length.color.g = length.color.b = length.color.a = 1;
  char text[64];
  std::snprintf(text, sizeof text, "%.3f m", static_cast<double>(link.distance_m));
  length.text = text;
  out.insert(out.end(), {line, ends, length});
}

}  // namespace

visualization_msgs::msg::MarkerArray markers_of(const berth_msgs::msg::LinkDistances& distances) {
  visualization_msgs::msg::MarkerArray out;
  // Lines of links that have none now would stay.
  Marker clear = marker(distances.header, "", 0, Marker::LINE_LIST);
  clear.action = Marker::DELETEALL;
  out.markers.push_back(clear);
  for (const LinkDistance& link : distances.links) {
    if (std::isfinite(link.distance_m)) {
      add_link(link, distances.header, distances.range_m, out.markers);
    }
  }
  return out;
}

}  // namespace berth_ros
