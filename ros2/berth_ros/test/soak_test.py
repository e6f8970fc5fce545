"""1000 questions a second and a fault every two seconds: no distance under a status that is not OK, none that is old, no leak.

`launch_test soak_test.py seconds:=600` goes on for longer.
"""
import itertools
import os
import sys
import time
import unittest

import launch_testing.actions
import launch_testing.asserts
import numpy as np
import pytest
from berth_msgs.msg import LinkDistances
from berth_msgs.srv import Attach, Detach
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch_ros.actions import Node
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import String
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, transform  # noqa: E402
from named_nodes import MAY_GO, NamedNodes, remaps  # noqa: E402

NAME = "soaked"
FAULT_EVERY_S = 2.0
LOOKED_AT_S = 0.3  # before and after each
OLDEST_S = {"image": 0.15, "joints": 0.02}  # the node's limits
AHEAD_S = 0.04


@pytest.mark.launch_test
def generate_test_description():
    node = Node(package="berth_ros", executable="distance_node", name=NAME, output="screen", remappings=remaps(NAME),
                additional_env={"MALLOC_ARENA_MAX": "1"},  # what threads leave unused in arenas of their own is no leak
                parameters=[{**MAY_GO, "question_rate_hz": 1000.0, "use_sim_time": True}])
    seconds = DeclareLaunchArgument("seconds", default_value="60")
    return LaunchDescription([seconds, node, launch_testing.actions.ReadyToTest()]), {"process": node}


def ns(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


class Soak(NamedNodes):
    names = (NAME,)
    back_s = 0.0

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.odd_joints = cls.node.create_publisher(JointState, "joint_states", qos_profile_sensor_data)
        cls.description.publish(String(data=URDF))
        cls.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))

    def advance(self):
        type(self).now_s = time.time() - self.back_s

    def change_state(self, transition):
        request = ChangeState.Request()
        request.transition.id = transition
        self.call(ChangeState, f"{NAME}/change_state", request)

    def set_back(self, by_s):
        type(self).back_s += by_s

    def stand(self):
        publish, self.clock.publish = self.clock.publish, lambda _: None
        self.live_for(0.4, joints=False, image=None)
        self.clock.publish = publish

    def describe(self, text):
        self.description.publish(String(data=text))
        self.live_for(0.3)

    def attach(self):
        part = Attach.Request(name="part", link="arm", is_link=True, shape=SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.05]))
        part.pose.orientation.w = 1.0
        self.call(Attach, f"{NAME}/attach", part)
        self.live_for(0.3)
        self.call(Detach, f"{NAME}/detach", Detach.Request(name="part"))

    def tell_odd(self):
        state = JointState(name=["turn"], position=[float("nan")])
        state.header.stamp.sec = -5
        self.odd_joints.publish(state)
        self.images.publish(self.image(width=3))

    def enable(self, is_on):
        self.call(SetBool, f"{NAME}/set_enabled", SetBool.Request(data=is_on))

    def faults(self):
        yield "joint states stop", lambda: self.live_for(0.3, joints=False)
        yield "images stop", lambda: self.live_for(0.4, image=None)
        yield "no robot", lambda: (self.describe("this is no robot"), self.describe(URDF))
        yield "another robot", lambda: (self.describe(URDF.replace("two_boxes", "twins")), self.describe(URDF))
        yield "disabled", lambda: (self.enable(False), self.live_for(0.2), self.enable(True))
        yield "attached", self.attach
        yield "a setting", lambda: self.set_parameter(NAME, "evaluation.range_m", float(self.random.uniform(0.8, 1)))
        yield "the clock back", lambda: self.set_back(float(self.random.choice([0.05, 0.8, 5.0])))
        yield "the clock stands", self.stand
        yield "odd messages", self.tell_odd
        yield "down and up", lambda: [self.change_state(t) for t in (
            Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_CLEANUP, Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE)]

    def expect_sound(self, message):
        known = [link.link for link in message.links if np.isfinite(link.distance_m) or np.isfinite(link.occupied.distance_m)]
        if message.status != LinkDistances.OK:
            self.assertEqual(known, [], message)
            return
        for what, stamp in (("image", message.header.stamp), ("joints", message.joints_stamp)):
            age_s = (ns(message.question_stamp) - ns(stamp)) * 1e-9
            self.assertTrue(-AHEAD_S <= age_s <= OLDEST_S[what] + 1e-6, f"{what} of {age_s} s under OK")

    def test_faults_one_after_another(self, process, test_args):
        heard, begin_s, due_s, rss_kb = self.heard[NAME], time.monotonic(), 0.0, []
        type(self).random, seconds, answers, ok = np.random.default_rng(1), float(test_args.get("seconds", 60)), 0, 0
        for what, make in itertools.cycle(list(self.faults())):
            self.assertTrue(self.until(heard.goes), f"before {what}: {heard}")
            self.live_for(max(LOOKED_AT_S, due_s - time.monotonic()))
            due_s = time.monotonic() + FAULT_EVERY_S
            make()
            self.live_for(LOOKED_AT_S)
            said, heard.answers = heard.answers, []
            for _, message in said:
                self.expect_sound(message)
            self.assertTrue(all(0 <= scale <= 1 for _, scale in heard.scales), what)
            del heard.scales[:]
            answers, ok = answers + len(said), ok + sum(m.status == LinkDistances.OK for _, m in said)
            with open(f"/proc/{process.process_details['pid']}/status") as status:
                rss_kb.append(int(next(line for line in status if line.startswith("VmRSS")).split()[1]))
            if time.monotonic() > begin_s + seconds:
                break
        third = len(rss_kb) // 3
        before_kb, after_kb = np.median(rss_kb[third:2 * third + 1]), np.median(rss_kb[2 * third:])
        print(f"{len(rss_kb)} faults in {time.monotonic() - begin_s:.0f} s, {answers} answers heard, {ok} OK, "
              f"memory {rss_kb[0] / 1024:.1f}, {before_kb / 1024:.1f}, {after_kb / 1024:.1f} MB (first, second third, last third)")
        self.assertLess(after_kb, 1.05 * before_kb + 1024)


@launch_testing.post_shutdown_test()
class Ended(unittest.TestCase):
    def test_it_ends_as_asked(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)
