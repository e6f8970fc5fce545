"""What no single image tells is found over several: a focal length that is a tenth off, of a camera that sees the robot in its middle."""
import os
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
CAMERAS = ["left", "right"]
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
             remappings=[("left/camera_info", "told/camera_info")]),
        launch_testing.actions.ReadyToTest(),
    ])


class Explained(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = node = rclpy.create_node("relay")
        cls.newest, cls.diagnostics, cls.log, cls.focal = None, {}, [], 1.0
        cls.infos = node.create_publisher(CameraInfo, "left/camera_info", qos_profile_sensor_data)
        node.create_subscription(CameraInfo, "told/camera_info", cls.on_info, qos_profile_sensor_data)
        node.create_subscription(LinkDistances, "distances", cls.on_distances, 10)
        node.create_subscription(DiagnosticArray, "/diagnostics", cls.on_diagnostics, 10)
        node.create_subscription(Log, "/rosout", lambda message: cls.log.append(message.msg), 100)
        spin_beside(node)

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    @classmethod
    def on_info(cls, info):
        info.k[0], info.k[4] = cls.focal * info.k[0], cls.focal * info.k[4]
        cls.infos.publish(info)

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
        self.fail(f"{why}: not within {limit_s} s: {self.newest}, {self.status('left')}")

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

    def test_02_a_focal_length_that_is_wrong_by_a_tenth(self):
        for factor in (0.9, 1.1):
            type(self).focal = factor
            named_s = self.until(
                lambda: (self.newest.cameras[0].status, self.newest.status) == (CameraState.IMPLAUSIBLE, LinkDistances.DEGRADED)
                and "focal length" in self.status("left").message, LOOKED_WITHIN_S, f"f by a factor of {factor}")
            print(f"f by a factor of {factor}: named after {named_s:.1f} s: {self.status('left').message}")
            self.assertEqual(self.status("left").level, DiagnosticStatus.ERROR)
            self.assertRegex(self.status("left").message, rf"with a focal length of 25\d px in place of {250 * factor:.0f} px")
            self.assertEqual(self.newest.cameras[1].status, CameraState.OK)
            type(self).focal = 1.0
            back_s = self.until(lambda: self.newest.status == LinkDistances.OK, 20, "mended")
            print(f"mended: OK after {back_s:.1f} s")
        self.assertTrue(self.lines())
        print("\n".join(self.lines()))
