"""Each fault is said, crashes nothing, and is over once it is fixed."""
import math
import os
import sys
import tempfile

import launch_testing.actions
import pytest
from berth_msgs.msg import LinkDistances
from launch import LaunchDescription
from launch_ros.actions import Node
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import BOX, FOCAL, FRAME, URDF, WIDTH, LivingRobot, transform  # noqa: E402


# The cable is in the URDF, and takes part in no collision.
CABLED = URDF.replace("</robot>", f'<link name="cable">{BOX.format(z=0.4)}</link><joint name="to_cable" type="fixed">'
                      '<parent link="arm"/><child link="cable"/></joint></robot>')
SRDF = tempfile.NamedTemporaryFile("w", suffix=".srdf")
SRDF.write('<robot name="two_boxes"><disable_default_collisions link="cable"/></robot>')
SRDF.flush()


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 50.0, "max_joint_hold_s": 0.0,
            "front.max_wait_s": 0.05, "srdf_path": SRDF.name}]),
        launch_testing.actions.ReadyToTest(),
    ])


class Faults(LivingRobot):
    def test_01_no_robot_is_a_status(self):
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_ROBOT)))
        self.expect_said("robot", "no robot_description")

    def test_02_a_description_that_is_no_urdf_is_said(self):
        self.description.publish(String(data="this is no robot"))
        self.expect_said("robot", "robot_description")
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_ROBOT)))

    def test_03_then_a_good_one_and_no_transform(self):
        self.description.publish(String(data=CABLED))
        self.expect_said("camera front", "no transform", "front_optical_frame")
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_FRAME)))

    def test_04_with_the_transform_there_are_distances(self):
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        self.assertTrue(self.until(self.answers))
        self.expect_said("camera front", "ok")
        self.assertEqual([link.link for link in self.newest.links], ["base", "arm"], "the cable is ignored")

    def test_05_wrong_images_are_named(self):
        wrong = [
            ({"encoding": "rgb8"}, "rgb8"),
            ({"is_bigendian": 1}, "big-endian"),
            ({"width": WIDTH - 1}, "camera_info"),
            ({"step": 4 * WIDTH - 4}, "rows of"),
            ({"data": self.depth.tobytes()[:-4]}, "bytes"),
        ]
        for change, said in wrong:
            for _ in range(400):
                if said in self.message("camera front"):
                    break
                self.step(image=self.image(**change))
            self.assertIn(said, self.message("camera front"))
            self.assertTrue(self.until(self.answers), "it goes on")

    def test_06_joint_states_that_stop_are_stale(self):
        stopped = (LinkDistances.TIME_STALE_JOINTS, LinkDistances.TIME_EXTRAPOLATED_TOO_FAR)
        self.assertTrue(self.until(lambda: self.newest.time_status in stopped, joints=False))
        self.assertTrue(all(math.isnan(link.distance_m) for link in self.newest.links))
        self.expect_said("joint states", "no new joint states", joints=False)
        self.assertTrue(self.until(self.answers))

    def test_07_a_joint_that_is_missing_is_named(self):
        self.expect_said("joint states", "missing_joint", names=("gripper",))
        self.assertTrue(self.until(self.answers, names=("gripper", "turn")))

    def test_08_an_image_that_comes_twice_is_no_new_one(self):
        twice = self.image()
        self.images.publish(twice)
        seen = self.until(lambda: any(c.time_status == LinkDistances.TIME_STAMP_WENT_BACK for c in self.newest.cameras),
                          image=twice)
        self.assertTrue(seen)
        self.assertTrue(self.until(self.answers))

    def test_09_images_that_stop_are_stale(self):
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_STALE_FRAME), image=None))
        self.assertTrue(self.until(self.answers))

    def test_10_settings_change_while_it_runs(self):
        def set_parameter(name, value):
            return self.set_parameter("distance_node", name, value)
        self.assertTrue(set_parameter("evaluation.range_m", 0.25).successful)
        self.assertTrue(self.until(lambda: abs(self.newest.range_m - 0.25) < 1e-6 and self.newest.status == LinkDistances.OK))
        refused = set_parameter("evaluation.range_m", -1.0)
        self.assertFalse(refused.successful)
        self.assertIn("range_m", refused.reason)
        self.assertFalse(set_parameter("evaluation.method", "exact").successful, "no parameter of the node")
        self.assertFalse(set_parameter("space.no_reading", "fast").successful)
        self.assertFalse(set_parameter("cameras", ["left"]).successful)
        self.assertTrue(set_parameter("front.self_filter.padding_m", 0.03).successful, "a camera's own, not given at the start")
        self.assertIn("padding_m", set_parameter("front.self_filter.padding_m", -1.0).reason)
        self.assertFalse(set_parameter("front.self_filter.padding_m", "wide").successful, "no number")
        self.assertTrue(set_parameter("evaluation.range_m", 1.0).successful)
        self.assertTrue(self.until(self.answers))

    def test_11_another_robot_takes_its_place(self):
        self.description.publish(String(data=CABLED.replace("two_boxes", "three").replace(
            "</robot>", '<link name="hand">' + BOX.format(z=0.3) + '</link><joint name="to_hand" type="fixed">'
            '<parent link="arm"/><child link="hand"/></joint></robot>')))
        self.assertTrue(self.until(lambda: len(self.newest.links) == 3 and self.answers()))
        self.description.publish(String(data=CABLED))
        self.assertTrue(self.until(lambda: len(self.newest.links) == 2 and self.answers()))

    def test_12_an_image_of_another_camera_info_is_not_used(self):
        self.assertTrue(self.until(self.answers))
        type(self).focal = 70.0
        self.step(image=None)
        del self.answers_so_far[:]
        self.live_for(0.05, image=None)
        # The image is too old for an answer only 0.15 s after it came.
        self.assertTrue(self.answers_so_far)
        self.assertEqual(self.answers_so_far[-1].time_status, LinkDistances.TIME_NO_FRAME)
        type(self).focal = FOCAL
        self.assertTrue(self.until(self.answers), "it goes on with the images of the one before")

    def test_13_distortion_is_said_once_and_not_for_each_image(self):
        type(self).distortion = [0.1, 0.0, 0.0, 0.0, 0.0]
        self.expect_said("camera front", "camera_info", "d[0]", "rectified")
        del self.log[:]
        self.live_for(5)
        lines = self.logged("camera front")
        print("\n".join(lines))
        self.assertLessEqual(len(lines), 1, lines)
        self.assertEqual(self.newest.status, LinkDistances.STALE)
        type(self).distortion = []
        self.assertTrue(self.until(self.answers))

    def test_14_spaces_are_made_ready_beside_the_questions(self):
        def count():
            with self.lock:
                status = self.diagnostics.get("questions")
            values = {pair.key: pair.value for pair in status.values} if status else {}
            return int(values.get("spaces made ready", -1))
        self.assertTrue(self.until(lambda: count() > 0))
        before = count()
        self.assertTrue(self.until(lambda: count() > before + 10))
