"""Whatever ends, changes or fails, the last that a controller hears is a stop: 0.2 s later at most."""
import os
import signal
import subprocess
import sys
import time

import launch_testing.actions
import pytest
from ament_index_python.packages import get_package_prefix
from berth_msgs.msg import Separation
from composition_interfaces.srv import LoadNode, UnloadNode
from launch import LaunchDescription
from launch_ros.actions import Node
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, transform  # noqa: E402
from named_nodes import MAY_GO, NamedNodes, remaps  # noqa: E402

# What asks with each joint state, and what asks by a timer: each goes by the same robot.
RATES_HZ = {"each_joint_state": 0.0, "by_timer": 50.0}
WITHIN_S = 0.2


def settings(name):
    return {**MAY_GO, "question_rate_hz": RATES_HZ[name]}


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", name=name, output="screen", parameters=[settings(name)],
             remappings=remaps(name)) for name in RATES_HZ
    ] + [
        Node(package="rclcpp_components", executable="component_container_mt", name="container", output="screen"),
        launch_testing.actions.ReadyToTest(),
    ])


class LastWord(NamedNodes):
    names = (*RATES_HZ, "unloaded", "signalled")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.plans = cls.node.create_publisher(JointState, "planned_joint_states", qos_profile_sensor_data)
        cls.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))

    def setUp(self):
        self.description.publish(String(data=URDF))

    def test_1_joint_states_stop(self):
        self.expect_goes(*RATES_HZ)
        self.expect_stands("joint states stop", *RATES_HZ, cause="joint", joints=False)

    def test_2_all_stops(self):
        self.expect_goes(*RATES_HZ)
        self.expect_stands("all stops", *RATES_HZ, joints=False, image=None)

    def test_3_the_description_is_no_robot(self):
        self.expect_goes(*RATES_HZ)
        self.description.publish(String(data="this is no robot"))
        self.expect_stands("no robot", *RATES_HZ, cause="no robot model")

    def enable(self, is_on, **step):
        for name in RATES_HZ:
            self.assertTrue(self.call(SetBool, f"{name}/set_enabled", SetBool.Request(data=is_on), **step).success)

    def set_all(self, parameter, value):
        for name in RATES_HZ:
            self.assertTrue(self.set_parameter(name, parameter, value).successful)

    def test_4_disabled_while_no_joint_states_come(self):
        self.expect_goes(*RATES_HZ)
        self.addCleanup(self.enable, True)
        self.enable(False, joints=False)
        self.expect_stands("disabled", *RATES_HZ, cause="disabled", joints=False)

    def test_5_the_monitor_is_turned_off(self):
        self.expect_goes(*RATES_HZ)
        self.addCleanup(self.set_all, "separation.monitor", True)
        self.set_all("separation.monitor", False)
        self.live_for(WITHIN_S)
        for name in RATES_HZ:
            print(f"monitor off: {self.heard[name]}")
        self.assertEqual([self.heard[name].scale for name in RATES_HZ], [0, 0])
        self.assertEqual([self.heard[name].separation.state for name in RATES_HZ], [Separation.UNMONITORED] * 2)

    def test_6_a_plan_goes_on_whatever_is_made_anew(self):
        """Once plans came, what the joints do allows nothing: neither after a change of settings nor beside an old plan."""
        plan = JointState(name=["turn"], velocity=[0.0])

        def tell_plan(age_s=0.0):
            plan.header.stamp = self.time_of(time.time() - age_s)
            self.plans.publish(plan)
        self.expect_goes(*RATES_HZ)
        for _ in range(10):
            tell_plan()
            self.step()
        self.assertTrue(all(self.heard[name].separation.is_planned for name in RATES_HZ))
        self.live_for(0.4)
        self.assertEqual([self.heard[name].scale for name in RATES_HZ], [0, 0], "without a plan")
        self.set_all("evaluation.range_m", 0.9)
        self.live_for(1)
        for name in RATES_HZ:
            print(f"planned, then rebuilt: {self.heard[name]}")
        self.assertEqual([self.heard[name].scale for name in RATES_HZ], [0, 0], "made anew without a plan")
        for _ in range(20):
            tell_plan(age_s=1.0)
            self.step()
        for name in RATES_HZ:
            print(f"plans of a second ago: {self.heard[name]}")
        self.assertEqual([self.heard[name].scale for name in RATES_HZ], [0, 0], "the plan is old")

    def test_7_unloaded(self):
        request = LoadNode.Request(package_name="berth_ros", plugin_name="berth_ros::DistanceNode", node_name="unloaded",
                                   remap_rules=[":=".join(remap) for remap in remaps("unloaded")],
                                   parameters=[Parameter(k, value=v).to_parameter_msg() for k, v in settings("by_timer").items()])
        loaded = self.call(LoadNode, "container/_container/load_node", request)
        self.assertTrue(loaded.success, loaded.error_message)
        self.expect_goes("unloaded")
        client = self.node.create_client(UnloadNode, "container/_container/unload_node")
        self.assertTrue(client.wait_for_service(10))
        client.call_async(UnloadNode.Request(unique_id=loaded.unique_id))
        self.expect_stands("unloaded", "unloaded", cause="not active")

    def start(self):
        parameters = [f"{key}:={value}" for key, value in settings("by_timer").items()]
        topics = [":=".join(remap) for remap in remaps("signalled")]
        options = [word for option, values in (("-p", parameters), ("-r", topics)) for value in values for word in (option, value)]
        node = os.path.join(get_package_prefix("berth_ros"), "lib", "berth_ros", "distance_node")
        return subprocess.Popen([node, "--ros-args", "-r", "__node:=signalled", *options])

    def test_8_a_signal_ends_it(self):
        for which in (signal.SIGINT, signal.SIGTERM):
            process = self.start()
            self.expect_goes("signalled")
            process.send_signal(which)
            self.expect_stands(which.name, "signalled", cause="not active")
            self.assertEqual(process.wait(10), 0)

    def test_9_a_killed_one_misses_the_deadline(self):
        missed = []
        self.node.create_subscription(
            Float64, "signalled/speed_scale", lambda _: None, QoSProfile(depth=1, deadline=Duration(seconds=0.1)),
            event_callbacks=SubscriptionEventCallbacks(deadline=lambda _: missed.append(time.monotonic())))
        process = self.start()
        self.heard["signalled"].scale = None
        self.expect_goes("signalled")
        self.live_for(0.5)
        del missed[:]
        process.kill()
        self.live_for(WITHIN_S)
        process.wait(10)
        self.assertTrue(missed, "nobody hears that it is gone")
