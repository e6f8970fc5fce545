// One depth image and the joint angles of its exposure: how far is each link from the nearest
// thing? Usage: one_frame robot.urdf
#include <cstdio>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: one_frame robot.urdf\n"), 2;
  const auto robot = std::make_shared<const berth::Robot>(berth::load_robot({.urdf = argv[1]}));

  berth::CameraMount mount;
  mount.camera = {.width_px = 640,
                  .height_px = 480,
                  .fx_px = 525,
                  .fy_px = 525,
                  .cx_px = 319.5,
                  .cy_px = 239.5};
  mount.parent_link = robot->model().links.front().name;
  // The camera stands 2 m before the robot, 0.5 m high, and looks back at it: z forward, x right, y
  // down.
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  // A real camera has berth::settings_of_real_camera(): an image that does not show the robot is
  // not used then.
  const auto mounted = std::make_shared<const berth::MountedCamera>(robot, mount);

  // What the driver of a real camera gives: metres, NaN where there is no reading. Here it is a
  // wall.
  const berth::DepthImage depth_m(640, 480, 2.6F);
  const berth::JointState at_exposure{
      .stamp_s = 0, .position = std::vector<double>(robot->model().joints.size(), 0.0)};

  berth::Frame frame;
  berth::Observer(mounted).observe(depth_m, at_exposure, frame);
  berth::Query query(robot);
  for (const berth::LinkResult& link : query.ask({.frames = frame}).links) {
    if (link.has_distance()) std::printf("%s: %.3f m\n", link.link.c_str(), link.distance_m);
  }
}
