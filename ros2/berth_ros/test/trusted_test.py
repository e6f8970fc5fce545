"""What a controller relies on: a stop from the first second, no distance without a camera, a log that says what is lost."""
import os
import sys

import launch_testing.actions
import numpy as np
import pytest
from berth_msgs.msg import CameraState, LinkDistances, Separation
from launch import LaunchDescription
from launch_ros.actions import Node
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, TwoCameras, transform  # noqa: E402


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front", "side"], "question_rate_hz": 50.0, "separation.monitor": True, "separation.no_reading": "ignore",
            "separation.not_seen": "ignore", "separation.unknown": "ignore",
            "separation.human_speed_m_s": 0.1, "separation.intrusion_m": 0.0, "evaluation.min_seen_share": 0.0}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Trusted(TwoCameras):
    def test_01_without_a_robot_it_is_a_stop_from_the_first_second(self):
        self.assertTrue(self.until(lambda: self.scale is not None, seconds=5))
        self.assertEqual(self.scale, 0)
        self.assertEqual(self.separation.state, Separation.STOP)
        self.assertIn("no robot model", self.separation.text)

    def test_02_then_it_may_go(self):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(self.is_state(Separation.CLEAR, Separation.REDUCED)), self.separation)
        self.assertTrue(self.separation.has_distance)

    def test_03_a_lost_camera_is_degraded_and_no_distance(self):
        before = self.separation.distance_m
        type(self).side_image = None
        self.assertTrue(self.until(lambda: self.newest.status == LinkDistances.DEGRADED))
        self.assertEqual(self.newest.cameras[1].status, CameraState.TOO_OLD)
        self.assertTrue(self.until(lambda: self.separation.status == LinkDistances.DEGRADED))
        print(f"before {before:.3f} m; without the side camera has_distance {self.separation.has_distance}, "
              f"speed_scale {self.separation.speed_scale}, {self.separation.text!r}")
        self.assertFalse(self.separation.has_distance)
        self.assertTrue(np.isnan(self.separation.distance_m))
        self.assertEqual(self.separation.state, Separation.STOP)
        self.assertIn("camera side is too_old", self.separation.text)
        self.assertTrue(self.until(lambda: self.logged("camera side", "too_old")))
        type(self).side_image = type(self).image
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(lambda: self.logged("camera side", "back after"), seconds=30))
        lines = self.logged("camera side:")
        print("\n".join(lines))
        self.assertEqual(len([line for line in lines if "too_old" in line]), 1, lines)

    def test_04_a_joint_that_no_robot_has_is_a_stop_that_names_it(self):
        self.expect_said("joint states", "joint turn: 1000000000", position=1e9)
        self.assertTrue(self.until(self.is_state(Separation.STOP), position=1e9))
        self.assertRegex(self.separation.text, r"stale: the joint states are \d+\.\d+ s old|exposure")
        self.assertTrue(self.until(self.answers))

    def test_05_seldom_joint_states_are_said(self):
        self.expect_said("joint states", "old; time.max_joints_age_s allows 20 ms", joints=False)
        self.assertTrue(self.until(self.answers))

    def test_06_it_is_a_lifecycle_node(self):
        def change(transition):
            request = ChangeState.Request()
            request.transition.id = transition
            return self.call(ChangeState, "distance_node/change_state", request).success
        self.assertTrue(change(Transition.TRANSITION_DEACTIVATE))
        self.live_for(0.3)
        self.assertEqual(self.scale, 0)
        type(self).newest = None
        self.live_for(0.5)
        self.assertIsNone(self.newest, "an inactive node says nothing")
        self.assertTrue(change(Transition.TRANSITION_ACTIVATE))
        self.assertTrue(self.until(self.answers))
        for transition in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_CLEANUP,
                           Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE):
            self.assertTrue(change(transition))
        self.assertTrue(self.until(self.answers), "it hears the robot and the camera's pose again")
