"""Where on its way does the robot come too near? Usage: look_ahead.py scene.yaml"""
import sys

import berth
import numpy as np

scene = berth.open_scene(sys.argv[1])
steps = list(scene)
# The newest frame of each camera, and a straight way through the joints from here to where the recording began.
newest = list({step.frame.camera: step.frame for step in steps}.values())
way = np.linspace(steps[-1].joints, steps[0].joints, 50)
ahead = berth.Query(scene.robot).ask(newest, ahead=way, nearer_than_m=0.1).ahead
moved = np.array(scene.robot.model.link_is_moved)
print("least distance on the way:", np.nanmin(ahead.distance_m[:, moved]), "m")
print("a link may come nearer than 10 cm first at pose", ahead.first_nearer, "of", len(way))
