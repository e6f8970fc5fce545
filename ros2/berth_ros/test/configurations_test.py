"""A planner asks the node whether the robot would be free somewhere else, and is told why where nobody knows."""
import os
import sys

import pytest
from berth_msgs.srv import CheckConfigurations
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import AT_POST_M, FRAME, SLIDING, LivingRobot, launched_node, sliding_depth_m, transform  # noqa: E402

FREE_M = 0.2
Answer = CheckConfigurations.Response


@pytest.mark.launch_test
def generate_test_description():
    return launched_node()


class Configurations(LivingRobot):
    def step(self, **changes):
        super().step(**{"position": 0.0, **changes})

    def check(self, *positions_m, step=None, **changes):
        trajectory = JointTrajectory(joint_names=["turn"], points=[JointTrajectoryPoint(positions=[y]) for y in positions_m])
        request = CheckConfigurations.Request(**{"trajectory": trajectory, **changes})
        return self.call(CheckConfigurations, "distance_node/check_configurations", request, **(step or {}))

    def expect_refused(self, answer, *parts):
        self.assertFalse(answer.success)
        self.assertTrue(all(part in answer.message for part in parts), answer.message)
        self.assertEqual((len(answer.configurations), answer.first_not_free), (0, 0))

    def test_01_without_a_robot_there_is_no_verdict(self):
        self.expect_refused(self.check(FREE_M), "no robot model")

    def test_02_free_and_near_are_told(self):
        type(self).depth = sliding_depth_m()
        self.description.publish(String(data=SLIDING))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, x=0.3, z=-1)]))
        self.assertTrue(self.until(self.answers))
        answer = self.check(FREE_M, AT_POST_M)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(list(answer.configurations), [Answer.FREE, Answer.NEAR])
        self.assertEqual((answer.first_not_free, answer.first_near, len(answer.motions)), (1, 1, 0))
        self.assertLess(answer.frame_age_s, 0.15)
        answer = self.check(FREE_M, FREE_M + 0.01, AT_POST_M, check_motions=True)
        self.assertEqual(list(answer.motions), [Answer.FREE, Answer.NEAR])
        self.assertEqual(answer.first_not_free, 1)
        self.assertEqual(self.check(AT_POST_M, without=["arm"]).first_not_free, -1)
        self.expect_refused(self.check(FREE_M, margin_m=float("nan")), "a margin is nan m")

    def test_03_verdicts_agree_with_the_distances(self):
        present = JointTrajectory(points=[JointTrajectoryPoint()])  # no joint is named
        for y in (FREE_M, 0.0):
            type(self).depth = sliding_depth_m(y)
            self.live_for(0.3, position=y)
            arm = next(link for link in self.newest.links if link.link == "arm")
            print(f"at {y} m: {arm.distance_m:.3f} m")
            for margin_m in (0.0, 0.02, 0.05, 0.2):
                answer = self.check(trajectory=present, margin_m=margin_m, resolve=True, step={"position": y})
                self.assertTrue(answer.success, answer.message)
                if abs(arm.distance_m - margin_m) > 0.005:
                    expected = Answer.FREE if arm.distance_m > margin_m else Answer.NEAR
                    self.assertEqual(list(answer.configurations), [expected], f"{margin_m}: {arm.distance_m}")

    def test_04_a_lost_camera_gives_no_verdict(self):
        self.live_for(0.5, image=None)
        self.expect_refused(self.check(FREE_M, step={"image": None}), "stale", "camera front is too_old")
        self.assertTrue(self.until(self.answers))
        self.assertEqual(self.check(FREE_M).first_not_free, -1)
