"""Between a program's velocity and its controller: what is far lets it through, what is near shortens it, what is lost stops it."""
import os
import sys

import numpy as np
import pytest
from berth_msgs.msg import DistanceRows, LinkDistances
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from std_msgs.msg import Float64MultiArray, String
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, SLIDING, LivingRobot, launched_node, sliding_depth_m, transform  # noqa: E402

COMMANDS = "velocity_controller/commands"
FAR_M, NEAR_M = 0.2, 0.0  # of the joint: 0.32 and 0.12 m before the post
TO_POST_M = 0.12


@pytest.mark.launch_test
def generate_test_description():
    return launched_node(**{"filter.command_topic": COMMANDS, "filter.period_s": 0.02, "evaluation.min_seen_share": 0.0})


class Filter(LivingRobot):
    at_m, wants = FAR_M, None

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.wanted = cls.node.create_publisher(Float64MultiArray, "wanted_velocity", 10)
        cls.commands = []
        cls.node.create_subscription(Float64MultiArray, COMMANDS, lambda m: cls.commands.append(list(m.data)), 10)

    def tick(self):
        if self.wants is not None:
            self.wanted.publish(Float64MultiArray(data=self.wants))

    def step(self, **changes):
        super().step(**{"position": self.at_m, **changes})

    def stand_at(self, at_m):
        type(self).at_m, type(self).depth = at_m, sliding_depth_m(at_m)

    def want(self, *velocity):
        type(self).wants = list(velocity) or None

    def expect(self, *command, **step):
        del self.commands[:]
        self.assertTrue(self.until(lambda: list(command) in self.commands[-1:], **step), f"{self.commands[-3:]}; expected {command}")

    def expect_stands(self, **step):
        """And goes on standing."""
        self.expect(0.0, **step)
        self.live_for(0.3, **step)
        del self.commands[:]
        self.live_for(0.5, **step)
        self.assertTrue(self.commands and all(command == [0.0] for command in self.commands), self.commands)

    def test_1_what_is_wanted_goes_through_where_all_is_far(self):
        self.stand_at(FAR_M)
        self.want(-0.1)
        self.description.publish(String(data=SLIDING))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, x=0.3, z=-1)]))
        self.expect(-0.1)
        self.want(0.25)
        self.expect(0.25)

    def test_2_towards_what_is_near_it_is_shortened(self):
        self.stand_at(NEAR_M)
        self.want(-0.9)
        allowed = -2 * (TO_POST_M - 0.05)
        self.live_for(0.5)
        self.assertTrue(self.until(lambda: 1.1 * allowed < self.commands[-1][0] < 0.1 * allowed), self.commands[-3:])
        del self.commands[:]
        self.live_for(1)
        print(f"-0.9 m/s are wanted, {sorted({round(command[0], 4) for command in self.commands})} allowed")
        self.assertTrue(all(1.1 * allowed < command[0] <= 0 for command in self.commands), self.commands)
        self.want(0.3)
        self.expect(0.3)

    def test_3_rows_say_the_same(self):
        rows = []
        subscription = self.node.create_subscription(DistanceRows, "distance_rows", rows.append, 10)
        self.assertTrue(self.until(lambda: rows and rows[-1].status == LinkDistances.OK and self.answers()))
        self.live_for(0.3)
        self.node.destroy_subscription(subscription)
        stamps = [message.question_stamp for message in self.answers_so_far]
        last = next(message for message in reversed(rows) if message.question_stamp in stamps)
        answer = self.answers_so_far[stamps.index(last.question_stamp)]
        self.assertEqual((list(last.joints), list(last.links)), (["turn"], ["base", "arm"]))
        for kind, bounds in ((last.nearest, [link.lower_bound_m for link in answer.links]),
                             (last.occupied, [link.occupied.lower_bound_m for link in answer.links]),
                             (last.known, [link.known.lower_bound_m for link in answer.links])):
            np.testing.assert_array_equal(kind.lower_bound_m, bounds)
        self.assertAlmostEqual(last.occupied.gradient[1], 1, delta=0.1)  # away from the post with +y
        self.assertAlmostEqual(last.occupied.normal_base[4], 1, delta=0.1)
        self.assertEqual(last.nearest.reach_m[1], 1)

    def test_4_a_setting_changes_while_it_runs(self):
        self.want(-0.3)
        self.assertTrue(self.set_parameter("distance_node", "filter.least_distance_m", 0.1).successful)
        self.live_for(0.5)
        self.assertTrue(self.until(lambda: -0.1 < self.commands[-1][0] < 0), self.commands[-3:])
        refused = self.set_parameter("distance_node", "filter.period_s", 0.01)
        self.assertFalse(refused.successful)
        self.assertIn("filter.period_s: 0.01", refused.reason)
        self.assertTrue(self.set_parameter("distance_node", "filter.least_distance_m", 0.05).successful)

    def test_5_it_stands_when_images_stop(self):
        self.want(0.3)
        self.expect(0.3)
        self.live_for(2)
        self.expect_stands(image=None)
        self.assertTrue(self.until(lambda: self.logged("velocity filter: stale"), image=None))
        self.expect_said("velocity filter", "stale", image=None)
        self.expect(0.3)
        self.assertTrue(self.until(lambda: self.logged("velocity filter", "back after")))

    def test_6_it_stands_when_commands_stop(self):
        self.want()
        self.expect_stands()
        self.expect_said("velocity filter", "nothing is wanted")
        self.want(0.3)
        self.expect(0.3)

    def test_7_it_stands_when_commands_are_of_other_joints(self):
        self.want(0.3, 0.3)
        self.expect_stands()
        self.expect_said("velocity filter", "wanted_velocity: 2 numbers; expected 1 finite ones, of turn")
        self.want(0.3)
        self.expect(0.3)

    def change_state(self, transition):
        request = ChangeState.Request(transition=Transition(id=transition))
        self.assertTrue(self.call(ChangeState, "distance_node/change_state", request).success)

    def test_8_its_last_word_is_zero(self):
        def enable(is_on):
            self.assertTrue(self.call(SetBool, "distance_node/set_enabled", SetBool.Request(data=is_on)).success)
        enable(False)
        self.expect_stands()
        enable(True)
        self.expect(0.3)
        self.expect_stands(joints=False)
        self.expect(0.3)
        self.change_state(Transition.TRANSITION_DEACTIVATE)
        self.live_for(0.3)
        self.assertEqual(self.commands[-1], [0.0])
        self.change_state(Transition.TRANSITION_ACTIVATE)
        self.expect(0.3)
