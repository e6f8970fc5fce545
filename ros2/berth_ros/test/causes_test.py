"""Each cause has words of its own, in separation.text, and one line in the log when it begins and one when it is over."""
import os
import sys

import launch_testing.actions
import numpy as np
import pytest
from berth_msgs.msg import LinkDistances, Separation
from launch import LaunchDescription
from launch_ros.actions import Node
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, HEIGHT, URDF, WIDTH, TwoCameras, transform  # noqa: E402

QUIET_S = 10  # the log has at most one line of a cause in this time


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front", "side"], "question_rate_hz": 100.0, "separation.monitor": True, "separation.no_reading": "ignore",
            "separation.not_seen": "ignore", "separation.unknown": "ignore",
            "separation.human_speed_m_s": 0.1, "separation.intrusion_m": 0.0, "evaluation.min_seen_share": 0.0}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Causes(TwoCameras):
    def covered(self):
        """No pixel has a reading."""
        return self.image(data=np.zeros(HEIGHT * WIDTH, "float32").tobytes())

    def skewed(self, by_s):
        image = self.image()
        image.header.stamp = self.time_of(self.now_s + by_s)
        return image

    def answers_for(self, seconds, **step):
        del self.answers_so_far[:]
        self.live_for(seconds, **step)
        return list(self.answers_so_far)

    def lines(self):
        return [line for line in self.logged("camera side: ") if line.startswith("camera side")]

    def lost_and_back(self, side_image, *said):
        """The side camera gives other images for a while."""
        before = len(self.lines())
        type(self).side_image = side_image
        self.assertTrue(self.until(lambda: self.separation.status == LinkDistances.DEGRADED
                                   and all(part in self.separation.text for part in said)), self.separation.text)
        self.assertEqual((self.separation.state, self.separation.has_distance), (Separation.STOP, False))
        print(self.separation.text)
        self.assertTrue(self.until(lambda: len(self.lines()) > before, seconds=QUIET_S + 10))
        type(self).side_image = type(self).image
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(lambda: len(self.lines()) > before + 1, seconds=QUIET_S + 10))
        self.live_for(1)
        lines = self.lines()[before:]
        print("\n".join(lines))
        self.assertEqual(len(lines), 2, lines)
        self.assertTrue(all(part in lines[0] for part in said), lines)
        self.assertIn("back after", lines[1])

    def test_01_at_first_all_is_well(self):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        self.assertTrue(self.until(self.answers))
        self.live_for(2)  # what is missing at first is not told
        self.assertTrue(self.until(self.is_state(Separation.CLEAR, Separation.REDUCED)), self.separation)

    def test_02_a_covered_camera(self):
        self.lost_and_back(type(self).covered, "side", "is blind")

    def test_03_stamps_of_another_clock(self):
        self.lost_and_back(lambda self: self.skewed(-0.4), "side", "is too_old (0.4")
        self.lost_and_back(lambda self: self.skewed(0.4), "side", "is stale (extrapolated_too_far)")
        # A stamp that jumps is no image that got lost.
        self.assertEqual(self.logged("images a second arrive"), [])

    def test_04_joints_that_are_no_numbers(self):
        for position in (float("nan"), float("inf")):
            self.expect_said("joint states", "joint turn", str(position), position=position)
            self.assertTrue(self.until(self.is_state(Separation.STOP), position=position))
            self.assertTrue(np.isnan(self.separation.distance_m))
            self.assertTrue(self.until(self.answers))

    def test_05_seldom_joint_states_are_stale_and_stay_so(self):
        self.live_for(QUIET_S + 1)  # until the log has said all about the test before
        del self.log[:]
        self.live_for(0.5, joints_every=5)
        seldom = self.answers_for(4, joints_every=5)
        share_ok = sum(message.status == LinkDistances.OK for message in seldom) / len(seldom)
        print(f"{len(seldom)} answers, {100 * share_ok:.1f} % ok; {self.separation.text}; {self.message('joint states')}")
        self.assertEqual(share_ok, 0)
        self.assertRegex(self.separation.text, r"stop: .*the joint states are 0\.05\d s old|stale")
        self.expect_said("joint states", "the newest are up to", "old; time.max_joints_age_s allows 20 ms", joints_every=5)
        # A busy computer may have had a line of its own before, and then the next one has to wait.
        line = "joint states: the newest are up to"
        self.assertTrue(self.until(lambda: self.logged(line), seconds=QUIET_S + 10, joints_every=5))
        lines = self.logged(line)
        print("\n".join(lines))
        self.assertEqual(len(lines), 1, lines)
        self.assertTrue(self.until(self.answers))
