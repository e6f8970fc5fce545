"""The bundled scene through the nodes gives the distances of `berth run`, with the images' stamps."""
import json
import math
import os
import subprocess
import sys
import threading
import time
import unittest

import launch_testing.actions
import pytest
import rclpy
from ament_index_python.packages import get_package_share_directory
from berth_msgs.msg import LinkDistances, Separation
from launch import LaunchDescription
from launch_ros.actions import Node
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import Image
from std_msgs.msg import Float64

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import spin  # noqa: E402

SCENE = os.path.join(get_package_share_directory("berth_ros"), "bundled", "scene.yaml")
# Within it a result depends on the one before, and a busy computer may drop an image.
TOLERANCE_M = 2e-6
# Nearer than this two things touch: a distance is the root of a square that single precision rounds.
TOUCHING_M = 1e-4
STATUS = {"ok": 0, "none_in_range": 1, "not_visible": 2, "cut_short": 3, "stale": 4, "not_seen": 5}
RESULT_STATUS = {"ok": 0, "degraded": 1, "stale": 2}


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "cameras": ["camera", "left", "right"], "environment_links": ["table"], "evaluation.range_m": 1.0,
            "evaluation.tolerance_m": TOLERANCE_M, "separation.monitor": True, "separation.human_speed_m_s": 0.1,
            "separation.intrusion_m": 0.0}]),
        Node(package="berth_ros", executable="self_filter_node", name="left_filter", output="screen",
             remappings=[("depth_image", "left/depth_image"), ("camera_info", "left/camera_info")],
             parameters=[{"environment_links": ["table"]}]),
        Node(package="berth_ros", executable="scene_player_node", output="screen",
             parameters=[{"scene": SCENE, "loop": False, "start_after_s": 8.0}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = rclpy.create_node("listener")
        cls.at_exposure, cls.distances, cls.separations, cls.scales = [], [], [], []
        cls.left, cls.world = {}, {}
        node = cls.node
        node.create_subscription(LinkDistances, "distances_at_exposure", cls.at_exposure.append, 100)
        node.create_subscription(LinkDistances, "distances", cls.distances.append, 100)
        node.create_subscription(Separation, "separation", cls.separations.append, 100)
        node.create_subscription(Float64, "speed_scale", lambda m: cls.scales.append(m.data), 100)
        qos = rclpy.qos.qos_profile_sensor_data
        node.create_subscription(Image, "left/depth_image", lambda m: cls.left.update({stamp(m): m}), qos)
        node.create_subscription(Image, "world_depth", lambda m: cls.world.update({stamp(m): m}), qos)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        threading.Thread(target=spin, args=(executor,), daemon=True).start()
        run = subprocess.run(["berth", "run", SCENE, "--format", "json", "--tolerance-m", str(TOLERANCE_M)],
                             check=True, capture_output=True, text=True)
        cls.expected = [json.loads(line) for line in run.stdout.splitlines()]
        end = time.time() + 60
        while time.time() < end and len(cls.at_exposure) < len(cls.expected):
            time.sleep(0.1)
        time.sleep(0.5)

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    def test_distances_are_those_of_berth_run(self):
        # The cameras' stamps say which images an answer is of. Images that waited for the same joint state are answered
        # in any order, so that not every line of the command has an answer of just its images.
        start = self.start_ns()
        got = {stamps_of(message, start): message for message in self.at_exposure}
        worst, compared = 0.0, 0
        for line in self.expected:
            key = tuple(0 if c["stamp_s"] is None else round(c["stamp_s"] * 1e9) for c in line["cameras"])
            if key not in got:
                continue
            message = got[key]
            compared += 1
            self.assertNotEqual(message.status, LinkDistances.STALE)
            self.assertEqual(message.status, RESULT_STATUS[line["status"]])
            self.assertEqual(message.header.frame_id, "table")
            for link, expected in zip(message.links, line["links"], strict=True):
                self.assertEqual(link.link, expected["link"])
                self.assertEqual(link.status, STATUS[expected["status"]])
                if expected["distance_m"] is None:
                    self.assertTrue(math.isnan(link.distance_m))
                    continue
                if max(link.distance_m, expected["distance_m"]) > TOUCHING_M:
                    worst = max(worst, abs(link.distance_m - expected["distance_m"]))
        print(f"{compared} of {len(self.expected)} lines, greatest difference {worst:.2g} m")
        self.assertGreater(compared, 0.3 * len(self.expected))
        self.assertLess(worst, 1e-5)

    def start_ns(self):
        """The scene's time 0: that with which most answers are of images of the scene."""
        stamps = {stamp(m) for m in self.at_exposure}
        scene = {round(line["stamp_s"] * 1e9) for line in self.expected}
        return max((min(stamps) - at for at in scene), key=lambda start: len({s - start for s in stamps} & scene))

    def test_questions_are_answered_on_their_own_clock(self):
        answered = [m for m in self.distances if m.status != LinkDistances.STALE]
        self.assertGreater(len(answered), 20)
        for message in answered:
            self.assertLessEqual(message.frame_age_s, 0.15)
            self.assertLessEqual(message.joints_age_s, 0.02)
            self.assertGreater(stamp_of(message.question_stamp), stamp(message))
        stale = self.distances[-1]
        self.assertEqual(stale.status, LinkDistances.STALE, "the scene has ended")
        self.assertTrue(all(math.isnan(link.distance_m) for link in stale.links))

    def test_separation_is_the_least_of_the_links_that_move(self):
        known = [m for m in self.separations if m.has_distance]
        self.assertGreater(len(known), 20)
        by_stamp = {(stamp(m), m.links[0].distance_m): m for m in self.distances if m.links}
        self.assertTrue(by_stamp)
        self.assertNotEqual(known[0].link, "arm_link_0")

    def test_the_monitor_tells_how_fast_the_robot_may_go(self):
        told = [m for m in self.separations if m.status != LinkDistances.STALE and m.links]
        self.assertGreater(len(told), 20)
        self.assertTrue(all(len(m.links) == 7 and m.reaction_time_s >= 0.1 for m in told))
        for message in told:
            self.assertLessEqual(message.speed_scale, min(link.speed_scale for link in message.links) + 1e-12)
            self.assertEqual(message.state == Separation.STOP, message.speed_scale == 0)
            self.assertTrue(message.text)
        self.assertTrue(any(link.speed_m_s > 0.1 for m in told for link in m.links), "the arm moves")
        self.assertGreater(len(self.scales), 20)
        last = self.separations[-1]
        self.assertEqual((last.state, last.speed_scale), (Separation.STOP, 0.0), "the scene has ended")

    def test_the_filtered_image_is_the_same_but_for_the_robot(self):
        self.assertGreater(len(self.world), 20)
        for at, world in self.world.items():
            image = self.left[at]
            self.assertEqual((world.encoding, world.header.frame_id), (image.encoding, image.header.frame_id))
            before, after = memoryview(image.data).cast("H"), memoryview(world.data).cast("H")
            kept = sum(1 for a in after if a)
            self.assertTrue(0 < kept < len(after))
            self.assertTrue(all(a in (0, b) for a, b in zip(after, before, strict=True)))


def stamps_of(message, start_ns):
    """Of each camera's image in an answer, from the scene's time 0 on; 0 where there is none."""
    return tuple(stamp_of(c.stamp) - start_ns if stamp_of(c.stamp) else 0 for c in message.cameras)


def stamp(message):
    return stamp_of(message.header.stamp)


def stamp_of(time_message):
    return time_message.sec * 10**9 + time_message.nanosec
