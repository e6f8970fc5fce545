"""A camera that is moved under a running node with its defaults is noticed within seconds: its images are not used any more."""
import os
import sys
import time
import unittest

import launch_testing.actions
import numpy as np
import pytest
import rclpy
from ament_index_python.packages import get_package_share_directory
from berth_msgs.msg import CameraState, LinkDistances
from berth_msgs.srv import Attach, Detach
from diagnostic_msgs.msg import DiagnosticArray
from launch import LaunchDescription
from launch_ros.actions import Node
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image
from shape_msgs.msg import SolidPrimitive
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import LATCHED, spin_beside  # noqa: E402

SCENE = os.path.join(get_package_share_directory("berth_ros"), "bundled", "scene.yaml")
CAMERA = "right"
NOTICED = (CameraState.MOVED, CameraState.IMPLAUSIBLE)
NOTICED_WITHIN_S = 10.0
# What the player tells goes through the test, which may change it.
RELAYED = {"/tf_static": "told/tf_static", f"{CAMERA}/depth_image": "told/depth_image", f"{CAMERA}/camera_info": "told/camera_info"}


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "cameras": [CAMERA], "environment_links": ["table"], "question_rate_hz": 50.0}]),
        # It knows a pose before TF tells one.
        Node(package="berth_ros", executable="distance_node", name="with_scene", output="screen", parameters=[{
            "scene": SCENE, "cameras": [CAMERA], "question_rate_hz": 1.0}], remappings=[("distances", "with_scene/distances")]),
        Node(package="berth_ros", executable="scene_player_node", output="screen", parameters=[{"scene": SCENE}],
             remappings=list(RELAYED.items())),
        launch_testing.actions.ReadyToTest(),
    ])


class Moved(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = node = rclpy.create_node("relay")
        cls.newest, cls.transforms, cls.answers, cls.pose_from = None, None, [], None
        cls.tells_transforms = False
        node.create_subscription(DiagnosticArray, "/diagnostics", cls.on_diagnostics, 10)
        cls.off_m, cls.turned_px, cls.focal = 0.0, 0, 1.0
        cls.images = node.create_publisher(Image, f"{CAMERA}/depth_image", qos_profile_sensor_data)
        cls.infos = node.create_publisher(CameraInfo, f"{CAMERA}/camera_info", qos_profile_sensor_data)
        cls.tf_static = node.create_publisher(TFMessage, "/tf_static", LATCHED)
        node.create_subscription(Image, "told/depth_image", cls.on_image, qos_profile_sensor_data)
        node.create_subscription(CameraInfo, "told/camera_info", cls.on_info, qos_profile_sensor_data)
        node.create_subscription(TFMessage, "told/tf_static", cls.on_transforms, LATCHED)
        node.create_subscription(LinkDistances, "distances", cls.on_distances, 10)
        spin_beside(node)

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    @classmethod
    def on_distances(cls, message):
        cls.newest = message
        cls.answers.append(message)

    @classmethod
    def on_image(cls, image):
        if cls.turned_px:
            # A camera that is turned to the side sees its picture go by, and at its edge what it did not see before.
            depth = np.roll(np.frombuffer(bytes(image.data), np.uint16).reshape(image.height, image.width), cls.turned_px, axis=1).copy()
            depth[:, :cls.turned_px] = 0
            image.data = depth.tobytes()
        cls.images.publish(image)

    @classmethod
    def on_info(cls, info):
        # Of rectified images P counts.
        info.p[0], info.p[5] = cls.focal * info.p[0], cls.focal * info.p[5]
        cls.infos.publish(info)

    @classmethod
    def on_transforms(cls, message):
        cls.transforms = message
        if cls.tells_transforms:
            cls.tell_transforms()

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            if status.name.startswith("with_scene: camera"):
                cls.pose_from = {pair.key: pair.value for pair in status.values}.get("pose from", cls.pose_from)

    @classmethod
    def tell_transforms(cls):
        for transform in cls.transforms.transforms:
            transform.transform.translation.x += cls.off_m
        cls.tf_static.publish(cls.transforms)

    def call(self, kind, name, request):
        client = self.node.create_client(kind, f"distance_node/{name}")
        self.assertTrue(client.wait_for_service(10))
        future = client.call_async(request)
        while not future.done():
            time.sleep(0.01)
        return future.result()

    def seconds_until(self, what, limit_s):
        begin = time.monotonic()
        while time.monotonic() < begin + limit_s:
            if self.newest is not None and what(self.newest):
                return time.monotonic() - begin
            time.sleep(0.01)
        self.fail(f"not within {limit_s} s: {self.newest}")

    def is_well(self):
        return self.seconds_until(lambda message: message.status == LinkDistances.OK, 40)

    def is_noticed(self, what):
        def lost(message):
            return message.status != LinkDistances.OK and message.cameras[0].status in NOTICED
        noticed_s = self.seconds_until(lost, NOTICED_WITHIN_S)
        print(f"{what}: noticed after {noticed_s:.1f} s, camera status {self.newest.cameras[0].status}")
        self.assertTrue(all(np.isnan(link.distance_m) for link in self.newest.links))

    def test_00_transforms_count_from_when_on_they_come(self):
        for source in ("scene", "TF"):
            end = time.monotonic() + 40
            while self.pose_from != source and time.monotonic() < end:
                time.sleep(0.1)
            self.assertEqual(self.pose_from, source)
            type(self).tells_transforms = True
            self.tell_transforms()

    def test_01_a_camera_that_stands_still_is_well(self):
        self.is_well()
        time.sleep(4)  # a round of the scene
        self.is_well()

    def test_02_a_pose_that_is_off_by_10_cm(self):
        type(self).off_m = 0.1
        self.tell_transforms()
        self.is_noticed("10 cm off")
        type(self).off_m = -0.1
        self.tell_transforms()
        self.is_well()

    def test_03_a_picture_that_is_turned_by_60_pixels(self):
        type(self).turned_px = 60
        self.is_noticed("turned by 60 px")
        type(self).turned_px = 0
        self.is_well()

    def test_04_a_focal_length_that_is_wrong_by_a_tenth(self):
        for factor in (0.9, 1.1):
            type(self).focal = factor
            self.is_noticed(f"f by a factor of {factor}")
            type(self).focal = 1.0
            self.is_well()

    def test_05_what_was_found_outlives_what_is_made_anew(self):
        self.is_well()
        type(self).turned_px = 60
        self.is_noticed("turned by 60 px")
        part = Attach.Request(name="part", link=self.newest.links[-1].link, shape=SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.05]))
        part.pose.orientation.w = 1.0
        changes = {"a part is attached": lambda: self.call(Attach, "attach", part),
                   "it is detached": lambda: self.call(Detach, "detach", Detach.Request(name="part")),
                   "a setting changes": lambda: self.call(SetParameters, "set_parameters", SetParameters.Request(
                       parameters=[Parameter("evaluation.range_m", value=0.9).to_parameter_msg()])).results[0].successful}
        for what, change in changes.items():
            self.assertTrue(change())
            del self.answers[:]
            time.sleep(3)
            ok = sum(message.status == LinkDistances.OK for message in self.answers)
            print(f"{what}: {ok} of {len(self.answers)} answers are OK")
            with self.subTest(what):
                self.assertEqual(ok, 0)
        type(self).turned_px = 0
        self.is_well()
