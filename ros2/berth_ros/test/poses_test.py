"""A camera that moves is where TF had it at the exposure; where nobody knows that, its images are not used."""
import os
import sys

import launch_testing.actions
import numpy as np
import pytest
from berth_msgs.msg import CameraState, LinkDistances
from launch import LaunchDescription
from launch_ros.actions import Node
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, LivingRobot, depth_m, transform  # noqa: E402

SPEED_M_S = 0.2
FROM_X_M = 0.25  # from where on it sees the post
POST_X_M = 0.58  # its side to the arm


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 50.0, "front.max_wait_s": 0.1,
            "world_frame": "map", "evaluation.visibility": False}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Poses(LivingRobot):
    """The camera swings before the robot, and TF tells it at 50 Hz."""

    tf_comes, base_comes, ticks, base_speed_m_s = True, True, 0, 0.0

    def camera_x(self, after_s=0.0):
        phase = (self.now_s + after_s) % 2
        return FROM_X_M + SPEED_M_S * (phase if phase < 1 else 2 - phase)

    def base_x(self):
        return self.base_speed_m_s * self.now_s

    def tick(self):
        type(self).ticks += 1
        if self.ticks % 2 > 0:
            return
        stamp = self.time_of(self.now_s)
        told = []
        if self.tf_comes:
            # The camera stands on a frame of its own, not on the robot.
            told.append(transform("map", FRAME, x=self.camera_x() + self.base_x(), z=-1, stamp=stamp))
        if self.base_comes:
            told.append(transform("map", "base", x=self.base_x(), stamp=stamp))
        self.tf.publish(TFMessage(transforms=told))

    def step(self, **changes):
        type(self).depth = depth_m(self.camera_x(after_s=0.05), obstacle=True)  # it is taken at the end of the step
        super().step(**changes)

    def answers_within(self, seconds):
        del self.answers_so_far[:]
        self.live_for(seconds)
        return list(self.answers_so_far)

    def many_answers(self):
        """This number that are ok, however long a busy computer takes for them, and those between them."""
        del self.answers_so_far[:]
        self.assertTrue(self.until(lambda: len(self.ok(list(self.answers_so_far))) >= 150, seconds=60))
        answers = list(self.answers_so_far)
        print(f"{len(answers)} answers, {100 * len(self.ok(answers)) / len(answers):.1f} % ok")
        return answers

    @staticmethod
    def ok(answers):
        return [message for message in answers if message.status == LinkDistances.OK]

    def post_x(self, answers):
        return np.array([link.occupied.obstacle_point_base_m.x for x in self.ok(answers)
                         for link in x.links if link.link == "arm" and np.isfinite(link.occupied.distance_m)])

    def test_01_the_post_stands_still_while_the_camera_moves(self):
        self.description.publish(String(data=URDF))
        self.assertTrue(self.until(self.answers))
        answers = self.many_answers()
        x_m = self.post_x(answers)
        print(f"the post's side from {x_m.min():.4f} to {x_m.max():.4f} m")
        self.assertGreater(len(self.ok(answers)), 0.5 * len(answers))
        # A pixel is 15 mm wide there, and a camera that is late by one image is off by 10 mm more.
        self.assertLess(abs(x_m - POST_X_M).max(), 0.016)
        self.assertTrue(any(c.status == CameraState.OK for c in self.newest.cameras))

    def test_02_transforms_that_stop_are_stale_at_once(self):
        type(self).tf_comes = False
        begin = self.now_s
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_STALE_POSE)))
        print(f"stale_pose {self.now_s - begin:.2f} s after the last transform")
        self.assertLess(self.now_s - begin, 1.0)
        self.assertEqual(self.newest.cameras[0].status, CameraState.STALE_POSE)
        self.assertTrue(all(np.isnan(link.distance_m) for link in self.newest.links))
        self.assertFalse(self.ok(self.answers_within(1)))
        self.assertFalse(self.separation.has_distance)
        self.assertIn("stale", self.separation.text)
        self.expect_said("camera front", "stale_pose", FRAME)
        self.assertTrue(self.logged("camera front", "stale_pose"), self.log)
        type(self).tf_comes = True
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(lambda: self.logged("camera front", "back after")))

    def test_03_an_image_of_another_frame_is_refused_by_name(self):
        for frame_id in ("nonsense", ""):
            self.expect_said("camera front", f'"{frame_id}"', FRAME, frame_id=frame_id)
            self.assertTrue(self.until(lambda: self.newest.status == LinkDistances.STALE, frame_id=frame_id))
            self.assertTrue(self.until(self.answers))

    def test_04_a_base_that_moves_sees_the_post_where_it_is(self):
        # Base and camera move together, and so the post moves with them: as seen from the base all is as before.
        type(self).base_speed_m_s = 0.3
        self.live_for(0.5)
        self.assertTrue(self.until(self.answers))
        answers = self.many_answers()
        x_m = self.post_x(answers)
        # The newest joints are up to one image later than the image.
        print(f"the post's side from {x_m.min():.4f} to {x_m.max():.4f} m from the base")
        self.assertGreater(len(self.ok(answers)), 0.5 * len(answers))
        self.assertLess(x_m.max(), POST_X_M + 0.016)
        self.assertGreater(x_m.min(), POST_X_M - 0.016 - 0.3 * 0.15)
        self.assertLess(x_m.min(), POST_X_M - 0.008, "between two images the base comes nearer to what was seen")

    def test_05_a_base_that_nobody_tells_is_stale(self):
        type(self).base_comes = False
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_STALE_POSE)))
        type(self).base_comes = True
        self.assertTrue(self.until(self.answers))
