"""How images are asked for, and what is said of those that get lost on their way."""
import os
import sys
import unittest

import cv2
import launch_testing.actions
import numpy as np
import pytest
from ament_index_python.packages import get_packages_with_prefixes
from diagnostic_msgs.msg import DiagnosticStatus
from launch import LaunchDescription
from launch_ros.actions import Node
from rclpy.qos import ReliabilityPolicy, qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FOCAL, FRAME, HEIGHT, URDF, WIDTH, LivingRobot, depth_m, transform  # noqa: E402

HAS_COMPRESSED = "compressed_depth_image_transport" in get_packages_with_prefixes()

LENS = [-0.25, 0.05, 0.0, 0.0, 0.0]
MATRIX = [FOCAL, 0.0, 31.5, 0.0, FOCAL, 23.5, 0.0, 0.0, 1.0]


def bent_ranges_m(image_m):
    """What a camera with this lens gives of the same, as distances along the rays."""
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    pixels = np.stack([u, v], -1).reshape(-1, 1, 2).astype(float)
    x, y = cv2.undistortPoints(pixels, np.reshape(MATRIX, (3, 3)), np.array(LENS)).reshape(HEIGHT, WIDTH, 2).transpose(2, 0, 1)
    straight = [np.clip(np.rint(FOCAL * at + middle).astype(int), 0, size - 1) for at, middle, size in ((y, 23.5, HEIGHT), (x, 31.5, WIDTH))]
    return (image_m[tuple(straight)] * np.sqrt(x * x + y * y + 1)).astype("float32")


@pytest.mark.launch_test
def generate_test_description():
    cameras = ["front", "bent", "reliable", "overridden"] + ["packed"] * HAS_COMPRESSED
    packed = {"packed.image_transport": "compressedDepth"} if HAS_COMPRESSED else {}
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": cameras, "question_rate_hz": 50.0, "reliable.reliability": "reliable",
            "bent.rectified": False, "bent.depth_is": "ray",
            "qos_overrides./overridden/depth_image.subscription.reliability": "reliable",
            "qos_overrides./overridden/depth_image.subscription.depth": 7, **packed}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Images(LivingRobot):
    images_so_far, lost_of_three = 0, 0

    def step(self, **changes):
        type(self).images_so_far += 1
        is_lost = self.images_so_far % 3 < self.lost_of_three
        super().step(**({"image": None} if is_lost else {}), **changes)

    def quality(self, camera):
        topic = f"/{camera}/depth_image"
        self.assertTrue(self.until(lambda: self.node.get_subscriptions_info_by_topic(topic)))
        return self.node.get_subscriptions_info_by_topic(topic)[0].qos_profile

    def test_01_best_effort_unless_told_otherwise(self):
        self.assertEqual(self.quality("front").reliability, ReliabilityPolicy.BEST_EFFORT)
        self.assertEqual(self.quality("reliable").reliability, ReliabilityPolicy.RELIABLE)
        overridden = self.quality("overridden")
        self.assertEqual(overridden.reliability, ReliabilityPolicy.RELIABLE)

    def test_02_images_that_get_lost_are_counted_and_the_buffer_is_named(self):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        self.expect_said("camera front", "ok")
        type(self).lost_of_three = 1
        self.expect_said("camera front", "of 20 images a second arrive", "DDS receive buffer")
        with self.lock:
            status = self.diagnostics["camera front"]
        self.assertEqual(status.level, DiagnosticStatus.WARN)
        values = {pair.key: float(pair.value) for pair in status.values if pair.key.startswith("images a second that")}
        print(status.message, values)
        self.assertAlmostEqual(values["images a second that the camera sends"], 20, delta=1)
        self.assertAlmostEqual(values["images a second that arrive"], 13.3, delta=2)
        self.assertTrue(self.until(lambda: self.logged("images of camera front", "DDS receive buffer")))

    def test_03_where_none_arrives_any_more_the_buffer_is_named_too(self):
        type(self).lost_of_three = 3
        self.expect_said("camera front", "too_old", "; before: ", "DDS receive buffer")
        type(self).lost_of_three = 1
        self.expect_said("camera front", "of 20 images a second arrive")

    def test_04_all_that_arrive_again_are_well(self):
        type(self).lost_of_three = 0
        self.expect_said("camera front", "ok")

    def test_05_a_reliable_sender_reaches_them_all(self):
        for camera in ("reliable", "overridden"):
            publisher = self.node.create_publisher(Image, f"{camera}/depth_image", 1)
            self.assertTrue(self.until(lambda publisher=publisher: publisher.get_subscription_count() == 1))

    def test_06_a_lens_that_bends_and_depth_along_the_ray_are_read(self):
        publisher = self.node.create_publisher(Image, "bent/depth_image", qos_profile_sensor_data)
        infos = self.node.create_publisher(CameraInfo, "bent/camera_info", qos_profile_sensor_data)
        info = CameraInfo(width=WIDTH, height=HEIGHT, k=MATRIX, distortion_model="plumb_bob", d=LENS)
        info.header.frame_id = FRAME
        with_post_m = depth_m()
        with_post_m[10:38, 61:] = 0.75
        ranges_m = bent_ranges_m(with_post_m)

        def post():
            arms = [link.occupied for link in self.newest.links if link.link == "arm"] if self.newest else []
            return arms[0] if arms and arms[0].camera == "bent" else None

        def finds_the_post():
            infos.publish(info)
            publisher.publish(self.image(data=ranges_m.tobytes()))
            # The edge of the surface's 3 cm, within two pixels: as it came it would be at x = 0.355, and 9 cm farther away.
            return post() and abs(post().obstacle_point_base_m.x - 0.39) < 0.02 and abs(post().obstacle_point_base_m.z + 0.22) < 0.01
        is_read = self.until(lambda: finds_the_post() and self.message("camera bent") == "ok")
        self.assertTrue(is_read, f"{self.message('camera bent')}: {post()}")

    @unittest.skipUnless(HAS_COMPRESSED, "compressed_depth_image_transport is not installed")
    def test_07_compressed_images_are_taken(self):
        publisher = self.node.create_publisher(CompressedImage, "packed/depth_image/compressedDepth", qos_profile_sensor_data)
        infos = self.node.create_publisher(CameraInfo, "packed/camera_info", qos_profile_sensor_data)
        info = CameraInfo(width=WIDTH, height=HEIGHT, k=MATRIX)
        info.header.frame_id = FRAME
        _, png = cv2.imencode(".png", (1000 * self.depth).round().astype(np.uint16))
        # Before the PNG: how depth was quantized, which is nothing where it is in mm.
        packed = CompressedImage(format="16UC1; compressedDepth png", data=bytes(12) + png.tobytes())
        packed.header.frame_id = FRAME

        def is_taken():
            infos.publish(info)
            packed.header.stamp = self.time_of(self.now_s)
            publisher.publish(packed)
            return self.message("camera packed") == "ok"
        self.assertTrue(self.until(is_taken), self.message("camera packed"))
