// One depth image and the joint angles of its exposure: how far is each link from the nearest thing?
// Usage: one_frame robot.urdf
#include <cstdio>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: one_frame robot.urdf\n"), 2;
  const auto robot = std::make_shared<const berth::Robot>(berth::load_robot({.urdf = argv[1]}));

  berth::CameraMount mount;
  mount.camera = {.width_px = 640, .height_px = 480, .fx_px = 525, .fy_px = 525, .cx_px = 319.5, .cy_px = 239.5};
  mount.parent_link = robot->model().links.front().name;
  // The camera stands 2 m before the robot, 0.5 m high, and looks back at it: z forward, x right, y down.
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  berth::ViewSettings settings;
  settings.watch.min_at_robot = 0;  // a made-up image shows no robot, which would make it implausible
  const auto view = std::make_shared<const berth::View>(robot, mount, settings);

  // What the driver of a real camera gives: metres, NaN where there is no reading. Here it is a wall.
  const berth::DepthImage depth_m(640, 480, 2.6F);
  const berth::JointState at_exposure{.stamp_s = 0, .position = std::vector<double>(robot->model().joints.size(), 0.0)};

  berth::Frame frame;
  berth::Observer(view).observe(depth_m, at_exposure, frame);
  berth::Asker asker(robot);
  for (const berth::LinkDistance& link : asker.ask(frame).distances.links) {
    if (link.status != berth::LinkStatus::ok) continue;
    std::printf("%s: %.3f m\n", robot->model().evaluated_link_names()[link.id - 1].c_str(), link.distance_m);
  }
}
