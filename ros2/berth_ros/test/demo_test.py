"""The bundled scene through the nodes gives the distances of `berth run`, with the images' stamps."""
import json
import math
import os
import subprocess
import sys
import time
import unittest

import launch_testing.actions
import pytest
import rclpy
from ament_index_python.packages import get_package_share_directory
from berth_msgs.msg import CameraState, LinkDistances, Separation
from launch import LaunchDescription
from launch_ros.actions import Node
from rcl_interfaces.msg import Log
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import spin_beside  # noqa: E402

SCENE = os.path.join(get_package_share_directory("berth_ros"), "bundled", "scene.yaml")
# Within it a result depends on the one before, and a busy computer may drop an image.
TOLERANCE_M = 2e-6
USUAL_TOLERANCE_M = 1e-3
# A busy computer drops images and answers, and is late: this number is enough to compare, and this late they may be.
LEAST = 5
MAX_FRAME_AGE_S, MAX_JOINTS_AGE_S = 0.5, 0.1
# Nearer than this two things touch: a distance is the root of a square that single precision rounds.
TOUCHING_M = 1e-4
STATUS = {"ok": 0, "none_in_range": 1, "not_visible": 2, "cut_short": 3, "stale": 4, "not_seen": 5, "not_observed": 6}
RESULT_STATUS = {"ok": 0, "degraded": 1, "stale": 2}


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "cameras": ["camera", "left", "right"], "environment_links": ["table"], "evaluation.range_m": 1.0,
            "evaluation.tolerance_m": TOLERANCE_M, "time.max_frame_age_s": MAX_FRAME_AGE_S, "time.max_joints_age_s": MAX_JOINTS_AGE_S,
            "separation.monitor": True, "separation.human_speed_m_s": 0.1,
            "separation.intrusion_m": 0.0}]),
        # With its defaults it stops looking once no distance can change by more than the tolerance.
        Node(package="berth_ros", executable="distance_node", name="usual_node", output="screen", parameters=[{
            "cameras": ["camera", "left", "right"], "environment_links": ["table"], "evaluation.range_m": 1.0,
            "separation.monitor": True, "separation.detection_m": 0.02,
            "question_rate_hz": 10.0}], remappings=[(name, "usual/" + name) for name in ("distances", "separation", "speed_scale", "distances_at_exposure")]),
        Node(package="berth_ros", executable="self_filter_node", name="left_filter", output="screen",
             remappings=[("depth_image", "left/depth_image"), ("camera_info", "left/camera_info")],
             parameters=[{"environment_links": ["table"]}]),
        Node(package="berth_ros", executable="scene_player_node", output="screen",
             parameters=[{"scene": SCENE, "start_after_s": 8.0}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = rclpy.create_node("listener")
        cls.at_exposure, cls.usual, cls.distances, cls.separations, cls.scales = [], [], [], [], []
        cls.left, cls.world, cls.log = {}, {}, []
        node = cls.node
        node.create_subscription(LinkDistances, "distances_at_exposure", cls.at_exposure.append, 100)
        node.create_subscription(LinkDistances, "usual/distances_at_exposure", cls.usual.append, 100)
        node.create_subscription(LinkDistances, "distances", cls.distances.append, 100)
        node.create_subscription(Separation, "separation", cls.separations.append, 100)
        node.create_subscription(Log, "/rosout", lambda m: cls.log.append(m), 100)
        node.create_subscription(Float64, "speed_scale", lambda m: cls.scales.append(m.data), 100)
        qos = rclpy.qos.qos_profile_sensor_data
        node.create_subscription(Image, "left/depth_image", lambda m: keep(cls.left, m, 200), qos)
        node.create_subscription(Image, "world_depth", lambda m: keep(cls.world, m, 100), qos)
        cls.first_joints = []
        node.create_subscription(JointState, "joint_states", lambda m: cls.first_joints or cls.first_joints.append(m), 100)
        spin_beside(node)
        run = subprocess.run(["berth", "run", SCENE, "--format", "json", "--tolerance-m", str(TOLERANCE_M)],
                             check=True, capture_output=True, text=True)
        cls.expected = [json.loads(line) for line in run.stdout.splitlines()]
        cls.period_s = cls.round_s()
        # Played again and again: however busy the computer is, there is enough to compare in the end.
        end = time.time() + 100
        while time.time() < end and not cls.has_enough():
            time.sleep(0.5)
        client = node.create_client(SetParameters, "scene_player_node/set_parameters")
        client.wait_for_service(10)
        client.call(SetParameters.Request(parameters=[Parameter("loop", value=False).to_parameter_msg()]))
        time.sleep(cls.period_s + 1)

    @classmethod
    def has_enough(cls):
        lots = (cls.pairs(cls.at_exposure), cls.pairs(cls.usual), cls.answered(), cls.known(), cls.told(), cls.world)
        return all(len(lot) > LEAST for lot in lots)

    @classmethod
    def answered(cls):
        return [m for m in list(cls.distances) if m.status != LinkDistances.STALE]

    @classmethod
    def known(cls):
        return [m for m in list(cls.separations) if m.has_distance]

    @classmethod
    def told(cls):
        return [m for m in list(cls.separations) if m.status != LinkDistances.STALE and m.links]

    @classmethod
    def round_s(cls):
        """The time of the last joints, which is the scene's end, and the player's pause."""
        with open(os.path.join(os.path.dirname(SCENE), "joints.csv"), encoding="utf-8") as file:
            return float(file.readlines()[-1].split(",")[0]) + 0.1

    @classmethod
    def pairs(cls, answers):
        """Lines of the command and answers of just their images, as the cameras' stamps say. Images that waited for the
        same joint state are answered in any order, so that not every line has one."""
        if not cls.first_joints:
            return []
        start_ns = stamp(cls.first_joints[0])  # of the scene's time 0
        lines = {tuple(0 if c["stamp_s"] is None else round(c["stamp_s"] * 1e3) for c in line["cameras"]): line for line in cls.expected}
        found = []
        for message in list(answers):
            newest_ns = max(stamp_of(c.stamp) for c in message.cameras)
            rounds = max(0, (newest_ns - start_ns) // round(cls.period_s * 1e9))
            at_ns = start_ns + rounds * round(cls.period_s * 1e9)
            key = tuple(round((stamp_of(c.stamp) - at_ns) * 1e-6) if stamp_of(c.stamp) else 0 for c in message.cameras)
            if key in lines and not cls.is_late(lines[key], message):
                found.append((lines[key], message))
        return found

    @staticmethod
    def is_late(line, message):
        """A busy computer asked when an image was too old already: that is another question than the command's."""
        return any(told.status == CameraState.TOO_OLD and of["status"] != "too_old"
                   for told, of in zip(message.cameras, line["cameras"], strict=True))

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    def test_distances_are_those_of_berth_run(self):
        self.assertLess(self.worst_m(self.at_exposure), 1e-5)

    def test_by_default_they_differ_by_the_tolerance_at_most(self):
        self.assertLess(self.worst_m(self.usual), USUAL_TOLERANCE_M + 1e-5)

    def worst_m(self, answers):
        """The greatest difference of any distance."""
        pairs, worst = self.pairs(answers), (0.0, 0.0)
        self.assertGreater(len(pairs), LEAST)
        for line, message in pairs:
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
                    worst = max(worst, (abs(link.distance_m - expected["distance_m"]), expected["distance_m"]))
        print(f"{len(pairs)} of {len(answers)} answers, greatest difference {worst[0]:.2g} m, at a distance of {worst[1]:.4g} m")
        return worst[0]

    def test_questions_are_answered_on_their_own_clock(self):
        answered = self.answered()
        self.assertGreater(len(answered), LEAST)
        for message in answered:
            self.assertLessEqual(message.frame_age_s, MAX_FRAME_AGE_S)
            self.assertLessEqual(message.joints_age_s, MAX_JOINTS_AGE_S)
            self.assertGreater(stamp_of(message.question_stamp), stamp(message))
        stale = self.distances[-1]
        self.assertEqual(stale.status, LinkDistances.STALE, "the scene has ended")
        self.assertTrue(all(math.isnan(link.distance_m) for link in stale.links))

    def test_what_may_hide_from_a_camera_is_logged(self):
        said = [m.msg for m in list(self.log) if m.name == "usual_node" and "protection by camera left: separation.detection_m: 0.02" in m.msg]
        self.assertEqual(len(said), 1, said)
        self.assertIn('expected at least space.detection_capability_m of camera "left", 0.04', said[0])

    def test_separation_is_the_least_of_the_links_that_move(self):
        known = self.known()
        self.assertGreater(len(known), LEAST)
        by_stamp = {(stamp(m), m.links[0].distance_m): m for m in self.distances if m.links}
        self.assertTrue(by_stamp)
        self.assertNotEqual(known[0].link, "arm_link_0")

    def test_the_monitor_tells_how_fast_the_robot_may_go(self):
        told = self.told()
        self.assertGreater(len(told), LEAST)
        self.assertTrue(all(len(m.links) == 7 and m.reaction_time_s >= 0.1 for m in told))
        for message in told:
            self.assertLessEqual(message.speed_scale, min(link.speed_scale for link in message.links) + 1e-12)
            self.assertEqual(message.state == Separation.STOP, message.speed_scale == 0)
            self.assertTrue(message.text)
            self.assertIn(message.basis, ("formula", "path"))
        self.assertTrue(any(link.speed_m_s > 0.1 for m in told for link in m.links), "the arm moves")
        self.assertGreater(len(self.scales), LEAST)
        last = self.separations[-1]
        self.assertEqual((last.state, last.speed_scale), (Separation.STOP, 0.0), "the scene has ended")

    def test_the_filtered_image_is_the_same_but_for_the_robot(self):
        self.assertGreater(len(self.world), LEAST)
        for at, world in self.world.items():
            image = self.left[at]
            self.assertEqual((world.encoding, world.header.frame_id), (image.encoding, image.header.frame_id))
            before, after = memoryview(image.data).cast("H"), memoryview(world.data).cast("H")
            kept = sum(1 for a in after if a)
            self.assertTrue(0 < kept < len(after))
            self.assertTrue(all(a in (0, b) for a, b in zip(after, before, strict=True)))


def keep(images, message, most):
    """The newest ones, by their stamps."""
    images[stamp(message)] = message
    if len(images) > most:
        del images[min(images)]


def stamp(message):
    return stamp_of(message.header.stamp)


def stamp_of(time_message):
    return time_message.sec * 10**9 + time_message.nanosec
