"""A clock that is set back, by whatever time, and one that stands: no answer by what came before, no silence, and on it goes."""
import os
import struct
import sys
import tempfile
import time

import launch_testing.actions
import pytest
from berth_msgs.msg import LinkDistances
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, transform  # noqa: E402
from named_nodes import MAY_GO, NamedNodes, remaps  # noqa: E402

BACK_NS = tempfile.NamedTemporaryFile("r+b", buffering=0)
BACK_NS.write(struct.pack("q", 0))
SIM, SYSTEM = "by_sim_time", "by_system_clock"
FRESH_S = (-0.04, 0.1)  # the clock of a simulation ticks each 10 ms here, and may come late
GOES_ON_S = 3.0


@pytest.mark.launch_test
def generate_test_description():
    def node(name, **options):
        return Node(package="berth_ros", executable="distance_node", name=name, output="screen", remappings=remaps(name), parameters=[
            {**MAY_GO, "question_rate_hz": 100.0, "front.max_wait_s": 0.05, "use_sim_time": name == SIM}], **options)
    return LaunchDescription([
        DeclareLaunchArgument("set_back_clock", description="the library that sets a program's system clock back"),
        node(SIM),
        node(SYSTEM, additional_env={"LD_PRELOAD": LaunchConfiguration("set_back_clock"), "SET_BACK_CLOCK": BACK_NS.name}),
        launch_testing.actions.ReadyToTest(),
    ])


class Clocks(NamedNodes):
    names = (SIM, SYSTEM)
    back_s, tf_comes, stands = 0.0, True, False

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.description.publish(String(data=URDF))

    def advance(self):
        type(self).now_s = time.time() - self.back_s

    def tick(self):
        if self.tf_comes:
            self.tell_camera(self.now_s)

    def tell_camera(self, *stamps_s):
        self.tf.publish(TFMessage(transforms=[transform("base", FRAME, z=-1, stamp=self.time_of(s)) for s in stamps_s]))

    def set_back(self, by_s):
        type(self).back_s += by_s
        BACK_NS.seek(0)
        BACK_NS.write(struct.pack("q", round(self.back_s * 1e9)))
        self.advance()
        self.clock.publish(Clock(clock=self.time_of(self.now_s)))
        for heard in self.heard.values():
            heard.forget()

    def joints_ages_s(self, heard):
        """Of all answers that are OK."""
        def ns(stamp):
            return stamp.sec * 10**9 + stamp.nanosec
        return [(ns(m.question_stamp) - ns(m.joints_stamp)) * 1e-9 for _, m in heard.answers if m.status == LinkDistances.OK]

    def longest_silence_s(self, heard, begin_s):
        times = [begin_s] + [at_s for at_s, _ in heard.answers] + [time.monotonic()]
        return max(after - before for before, after in zip(times, times[1:]))

    def expect_new_beginning(self, by_s):
        begin_s = time.monotonic()
        self.live_for(0.3)
        is_back = self.until(lambda: all(self.heard[name].distances.status == LinkDistances.OK for name in self.names), seconds=by_s + 5)
        took_s = time.monotonic() - begin_s
        for name in self.names:
            heard = self.heard[name]
            silence_s, ages_s = self.longest_silence_s(heard, begin_s), self.joints_ages_s(heard)
            with self.subTest(f"{name}, {by_s} s"):
                print(f"{name}, {by_s} s back: longest silence {silence_s:.3f} s, goes on after {took_s:.2f} s, "
                      f"joints {min(ages_s, default=0):.3f} to {max(ages_s, default=0):.3f} s old where OK")
                self.assertTrue(is_back)
                self.assertLess(silence_s, 0.2)
                self.assertIn(0.0, [scale for _, scale in heard.scales], "nobody said a stop")
                self.assertTrue(all(FRESH_S[0] < age_s < FRESH_S[1] for age_s in ages_s))
                self.assertLess(took_s, GOES_ON_S)

    def test_1_a_clock_that_is_set_back_is_a_new_beginning(self):
        for by_s in (0.05, 0.8, 5.0):
            self.expect_goes(*self.names)
            self.set_back(by_s)
            self.expect_new_beginning(by_s)

    def test_2_so_it_is_after_as_many_transforms_as_are_kept(self):
        self.expect_goes(*self.names)
        for k in range(0, 2100, 100):
            self.tell_camera(*(self.now_s - 2.1 + 0.001 * (k + i) for i in range(100)))
        self.live_for(0.5)
        self.expect_goes(*self.names)
        self.set_back(5.0)
        self.expect_new_beginning(5.0)

    def test_3_transforms_from_before_place_no_camera(self):
        self.expect_goes(*self.names)
        self.set_back(0.8)
        type(self).tf_comes = False
        self.live_for(0.3)
        for heard in self.heard.values():
            heard.forget()
        self.live_for(0.4)
        said = self.say(*self.names)
        print(f"without transforms: {said}")
        self.assertFalse([n for n in self.names if self.joints_ages_s(self.heard[n])], f"OK without a transform: {said}")
        type(self).tf_comes = True
        self.expect_goes(*self.names)

    def test_4_a_clock_that_stands_is_a_stop(self):
        """The simulation ends, or only its clock does."""
        for joints, image in ((False, None), (True, "good")):
            self.expect_goes(SIM)
            publish, self.clock.publish = self.clock.publish, lambda _: None
            self.expect_stands("the clock stands", SIM, joints=joints, image=image)
            self.clock.publish = publish
        self.expect_goes(SIM)
