"""Under a controller_manager: a trajectory pauses where a person comes near, goes on later, and comes to its goal. By the controller's
speed_scaling_input, and retimed for a controller that has none."""
import csv
import os
import sys
import tempfile
import unittest

import launch_testing
import launch_testing.actions
import launch_testing.asserts
import pytest
from launch import LaunchDescription
from launch_ros.actions import Node

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from box_arm import arm_nodes  # noqa: E402

# Three stops of a second, and as much again for people who walk up and away.
TAKES_AT_MOST_S = 280


@pytest.mark.launch_test
@launch_testing.parametrize("controller", ["arm_controller", "plain_controller"])
def generate_test_description(controller):
    out = tempfile.mkdtemp()
    is_retimed = controller == "plain_controller"
    trajectory = Node(package="berth_ros", executable="pause_and_resume", output="screen",
                      parameters=[{"out": out, **({"action": "retime_trajectory/follow_joint_trajectory"} if is_retimed else {})}])
    return LaunchDescription([*arm_nodes(controller), trajectory, launch_testing.actions.ReadyToTest()]), {
        "trajectory": trajectory, "out": out}


class Pause(unittest.TestCase):
    def test_it_comes_to_its_goal_after_three_stops(self, proc_info, trajectory, out):
        proc_info.assertWaitForShutdown(trajectory, timeout=TAKES_AT_MOST_S)
        launch_testing.asserts.assertExitCodes(proc_info, process=trajectory)
        with open(os.path.join(out, "pause_and_resume.csv"), encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertGreater(os.path.getsize(os.path.join(out, "pause_and_resume.png")), 10000)
        standing = [row for row in rows if row["speed_scale"] == 0 and row["person_is_called"] and abs(row["shoulder_rad_s"]) < 0.002]
        self.assertGreater(len(standing), 100)
        self.assertAlmostEqual(rows[-1]["shoulder_rad"], -0.8, delta=0.01)
        self.assertAlmostEqual(rows[-1]["shoulder_rad_s"], 0, delta=0.01)
