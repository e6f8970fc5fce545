"""Under a controller_manager: a velocity controller behind the filter keeps the arm away from a person, and the arm comes to its goal later."""
import os
import sys
import time
import unittest

import launch_testing.actions
import numpy as np
import pytest
import rclpy
from launch import LaunchDescription
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64MultiArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from box_arm import arm_nodes  # noqa: E402

JOINTS = ["shoulder", "elbow"]
GOAL = np.array([0.8, -0.6])
LEAST_M, ERROR_M = 0.3, 0.01  # pause.launch.py's, and what the drawn readings may be wrong by
PERSON_MIN, PERSON_MAX = np.array([1.15, -0.05]), np.array([1.45, 0.45])  # where box_world's stands


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([*arm_nodes("velocity_controller"), launch_testing.actions.ReadyToTest()])


def to_person_m(shoulder, elbow):
    """From the forearm's outline, seen from above: both are as high as each other somewhere."""
    x, y = np.meshgrid(np.linspace(-0.05, 0.45, 101), [-0.07, 0.07])
    turn = shoulder + elbow
    x, y = (0.5 * np.cos(shoulder) + np.cos(turn) * x - np.sin(turn) * y, 0.5 * np.sin(shoulder) + np.sin(turn) * x + np.cos(turn) * y)
    outline = np.stack([x.ravel(), y.ravel()], axis=1)
    return np.linalg.norm(np.maximum(0, np.maximum(PERSON_MIN - outline, outline - PERSON_MAX)), axis=1).min()


class VelocityController(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = rclpy.create_node("velocity_controller_test")
        cls.wanted = cls.node.create_publisher(Float64MultiArray, "wanted_velocity", 10)
        cls.call = cls.node.create_publisher(Bool, "person_is_called", 1)
        cls.at = []
        cls.node.create_subscription(JointState, "joint_states", cls.on_joints, qos_profile_sensor_data)

    @classmethod
    def tearDownClass(cls):
        cls.node.destroy_node()
        rclpy.shutdown()

    @classmethod
    def on_joints(cls, joints):
        if set(JOINTS) <= set(joints.name):
            cls.at.append(np.array([joints.position[joints.name.index(joint)] for joint in JOINTS]))

    def live_for(self, seconds, is_wanted=True):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.at and is_wanted:
                self.wanted.publish(Float64MultiArray(data=np.clip(2 * (GOAL - self.at[-1]), -0.4, 0.4).tolist()))
            rclpy.spin_once(self.node, timeout_sec=0.02)

    def test_1_it_stays_away_from_a_person(self):
        end = time.monotonic() + 60
        while not self.at and time.monotonic() < end:
            self.live_for(0.1, is_wanted=False)
        self.live_for(3, is_wanted=False)
        begin = self.at[-1]
        self.call.publish(Bool(data=True))
        self.live_for(5, is_wanted=False)
        np.testing.assert_allclose(self.at[-1], begin, atol=1e-3)
        del self.at[:]
        while np.linalg.norm(self.at[-1] - begin if self.at else 0) < 0.2 and time.monotonic() < end:
            self.live_for(0.1)
        self.live_for(10)
        near = [to_person_m(*at) for at in self.at]
        print(f"from {near[0]:.3f} m it came to {min(near):.3f} m at least, and to {near[-1]:.3f} m, at {self.at[-1]}")
        self.assertGreater(min(near), LEAST_M - ERROR_M)
        self.assertGreater(np.linalg.norm(self.at[-1] - begin), 0.2)

    def test_2_it_comes_to_its_goal_when_the_person_has_gone(self):
        self.call.publish(Bool(data=False))
        end = time.monotonic() + 60
        while np.abs(self.at[-1] - GOAL).max() > 0.02 and time.monotonic() < end:
            self.live_for(0.5)
        np.testing.assert_allclose(self.at[-1], GOAL, atol=0.02)
