"""What no single image tells is found over several: a focal length that is a tenth off, of a camera that sees the robot in its middle."""
import functools
import os
import re
import sys
import time
import unittest

import launch_testing.actions
import pytest
import rclpy
from ament_index_python.packages import get_package_share_directory
from berth_msgs.msg import CameraState, LinkDistances
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from launch import LaunchDescription
from launch_ros.actions import Node
from rcl_interfaces.msg import Log
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import spin_beside  # noqa: E402

SCENE = os.path.join(get_package_share_directory("berth_ros"), "bundled", "scene.yaml")
CAMERAS = ["camera", "left", "right"]
LOOKS = "looked at over several images"
# A look takes ten seconds of one core where something is wrong.
LOOKED_WITHIN_S = 100.0


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "cameras": CAMERAS, "environment_links": ["table"], "question_rate_hz": 20.0, "time.max_frame_age_s": 0.5,
            "time.max_joints_age_s": 0.2}]),
        # camera_info goes through the test, which may change it.
        Node(package="berth_ros", executable="scene_player_node", output="screen", parameters=[{"scene": SCENE}],
             remappings=[(f"{camera}/camera_info", f"told/{camera}/camera_info") for camera in CAMERAS]),
        launch_testing.actions.ReadyToTest(),
    ])


class Explained(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = node = rclpy.create_node("relay")
        cls.newest, cls.diagnostics, cls.log, cls.focal = None, {}, [], dict.fromkeys(CAMERAS, 1.0)
        cls.infos = {camera: node.create_publisher(CameraInfo, f"{camera}/camera_info", qos_profile_sensor_data) for camera in CAMERAS}
        for camera in CAMERAS:
            node.create_subscription(CameraInfo, f"told/{camera}/camera_info", functools.partial(cls.on_info, camera), qos_profile_sensor_data)
        node.create_subscription(LinkDistances, "distances", cls.on_distances, 10)
        node.create_subscription(DiagnosticArray, "/diagnostics", cls.on_diagnostics, 10)
        node.create_subscription(Log, "/rosout", lambda message: cls.log.append(message.msg), 100)
        spin_beside(node)

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    @classmethod
    def on_info(cls, camera, info):
        # Of rectified images P counts.
        info.p[0], info.p[5] = cls.focal[camera] * info.p[0], cls.focal[camera] * info.p[5]
        cls.infos[camera].publish(info)

    @classmethod
    def on_distances(cls, message):
        cls.newest = message

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            cls.diagnostics[status.name.split(": ")[-1]] = status

    def until(self, what, limit_s, why):
        begin = time.monotonic()
        while time.monotonic() < begin + limit_s:
            if self.newest is not None and what():
                return time.monotonic() - begin
            time.sleep(0.05)
        self.fail(f"{why}: not within {limit_s} s: {self.newest}, {[self.status(camera) for camera in CAMERAS]}")

    def status(self, camera):
        return self.diagnostics.get(f"camera {camera}", DiagnosticStatus())

    def looks(self, camera):
        return sum(int(value.value) for value in self.status(camera).values if value.key == LOOKS)

    def lines(self):
        return [line for line in self.log if "over several images" in line]

    def test_01_the_scene_as_it_is_raises_no_alarm(self):
        self.until(lambda: all(self.looks(camera) >= 1 for camera in CAMERAS), LOOKED_WITHIN_S, "a look")
        self.until(lambda: self.newest.status == LinkDistances.OK, 20, "OK")
        self.assertEqual(self.lines(), [])
        for camera in CAMERAS:
            self.assertNotIn("focal", self.status(camera).message)

    def is_named(self, camera, true_px, factor):
        """The focal length is wrong for a while."""
        number = CAMERAS.index(camera)
        self.focal[camera] = factor
        named_s = self.until(
            lambda: (self.newest.cameras[number].status, self.newest.status) == (CameraState.IMPLAUSIBLE, LinkDistances.DEGRADED)
            and "focal length" in self.status(camera).message, LOOKED_WITHIN_S, f"{camera}: f by a factor of {factor}")
        print(f"{camera}: f by a factor of {factor}: named after {named_s:.1f} s: {self.status(camera).message}")
        self.assertEqual(self.status(camera).level, DiagnosticStatus.ERROR)
        told = re.search(r"focal length (?:of|is about) ([\d.]+) px(?: in place of|, not) (\d+)", self.status(camera).message)
        self.assertTrue(told, self.status(camera).message)
        self.assertAlmostEqual(float(told[1]), true_px, delta=0.02 * true_px)
        self.assertAlmostEqual(int(told[2]), factor * true_px, delta=1)
        for other in CAMERAS:
            if other != camera:
                self.assertNotIn("focal", self.status(other).message)
        self.focal[camera] = 1.0
        back_s = self.until(lambda: self.newest.status == LinkDistances.OK, 20, "fixed")
        print(f"fixed: OK after {back_s:.1f} s")

    def test_02_a_focal_length_that_is_wrong_by_a_tenth(self):
        for camera, true_px, factor in (("left", 250, 0.9), ("left", 250, 1.1), ("camera", 525, 1.1), ("right", 400, 1.1)):
            self.is_named(camera, true_px, factor)
        self.assertTrue(self.lines())
        print("\n".join(self.lines()))
