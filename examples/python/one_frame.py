"""How far is each link from the nearest thing? Usage: one_frame.py robot.urdf"""
import sys

import berth
import numpy as np

robot = berth.Robot(berth.load_robot(sys.argv[1]))
camera = berth.Camera(640, 480, 525, 525, 319.5, 239.5)
# The camera stands 2 m before the robot, 0.5 m high, and looks back at it.
X_BC = np.array([[0, 0, -1, 2.0], [1, 0, 0, 0], [0, -1, 0, 0.5], [0, 0, 0, 1]])
# A made-up image shows no robot, which would make the camera implausible.
view = berth.MountedCamera(robot, camera, "base_link", X_BC)
depth_m = np.full((480, 640), 2.6, np.float32)  # what a driver gives; here a wall
frame = berth.Observer(view).observe(depth_m, joints=np.zeros(len(robot.model.joint_names)))
for link in berth.Query(robot).ask(frame).links:
    print(link.link, link.status.name, link.distance_m)
