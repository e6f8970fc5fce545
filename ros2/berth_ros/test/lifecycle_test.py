"""A node is taken down and set up again while all that it hears goes on: no callback may use what is no more."""
import os
import sys
import threading
import time
import unittest

import launch_testing.actions
import launch_testing.asserts
import pytest
from berth_msgs.msg import LinkDistances
from berth_msgs.srv import Attach, Detach
from launch import LaunchDescription
from launch_ros.actions import Node
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState, PointCloud2
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, HEIGHT, URDF, WIDTH, LivingRobot, transform  # noqa: E402

CYCLES = 10
BURSTS = 20
TICK_S = 0.002


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 500.0, "marker_rate_hz": 100.0,
            "occupied_points_rate_hz": 30.0, "planner.edge_m": 0.1, "diagnostic_updater.period": 0.02,
            "separation.monitor": True, "separation.human_speed_m_s": 0.1, "separation.intrusion_m": 0.0}]),
        Node(package="berth_ros", executable="self_filter_node", output="screen", parameters=[{
            "use_sim_time": True, "diagnostic_updater.period": 0.02}],
            remappings=[("depth_image", "front/depth_image"), ("camera_info", "front/camera_info")]),
        launch_testing.actions.ReadyToTest(),
    ])


class Lifecycle(LivingRobot):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.node.create_subscription(LinkDistances, "distances_at_exposure", lambda _: None, 10)
        cls.node.create_subscription(MarkerArray, "markers", lambda _: None, 10)
        cls.node.create_subscription(PointCloud2, "occupied_points", lambda _: None, 10)
        cls.filtered = set()
        for topic in ("world_depth", "robot_mask", "robot_depth"):
            cls.node.create_subscription(Image, topic, lambda _, topic=topic: cls.filtered.add(topic), qos_profile_sensor_data)
        cls.is_over = threading.Event()
        cls.description.publish(String(data=URDF))
        cls.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        cls.life = None

    @classmethod
    def tearDownClass(cls):
        cls.is_over.set()
        cls.life.join()
        super().tearDownClass()

    def setUp(self):
        if self.life is None:
            type(self).life = threading.Thread(target=self.live, daemon=True)
            self.life.start()

    def live(self):
        """By the wall's clock: 500 ticks, 200 joint states, 50 images and as many transforms a second."""
        begin, ticks = time.monotonic(), 0
        while not self.is_over.is_set():
            ticks += 1
            type(self).now_s += TICK_S
            self.clock.publish(Clock(clock=self.time_of(self.now_s)))
            if ticks * 2 // 5 != (ticks - 1) * 2 // 5:
                state = JointState(name=["turn"], position=[0.1])
                state.header.stamp = self.time_of(self.now_s)
                self.joints.publish(state)
            if ticks % 10 == 0:
                info = CameraInfo(width=WIDTH, height=HEIGHT, k=[60.0, 0.0, 31.5, 0.0, 60.0, 23.5, 0.0, 0.0, 1.0])
                info.header.frame_id = FRAME
                self.infos.publish(info)
                self.images.publish(self.image())
                self.tf.publish(TFMessage(transforms=[transform("base", "elsewhere", stamp=self.time_of(self.now_s))]))
            time.sleep(max(0.0, begin + ticks * TICK_S - time.monotonic()))

    def wait_until(self, what, seconds=20.0):
        end = time.monotonic() + seconds
        while not what() and time.monotonic() < end:
            time.sleep(0.002)
        return what()

    def filters(self):
        return len(self.filtered) == 3

    def cycle(self, node, forget, lives):
        """Down and up again, each time it has to live as before."""
        client = self.node.create_client(ChangeState, node + "/change_state")
        self.assertTrue(client.wait_for_service(10))
        self.assertTrue(self.wait_until(lives))
        for cycle in range(CYCLES):
            for transition in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_CLEANUP,
                               Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE):
                request = ChangeState.Request()
                request.transition.id = transition
                future = client.call_async(request)
                self.assertTrue(self.wait_until(future.done), f"cycle {cycle}: no answer to transition {transition}")
                self.assertTrue(future.result().success)
            forget()
            self.assertTrue(self.wait_until(lives), f"cycle {cycle}: it does not live again")
            print(f"{node}, cycle {cycle}: it lives again")

    def test_distance_node_stops_and_starts_while_all_goes_on(self):
        def forget():
            type(self).newest = None
        self.cycle("distance_node", forget, self.answers)

    def test_self_filter_node_stops_and_starts_while_all_goes_on(self):
        self.cycle("self_filter_node", self.filtered.clear, self.filters)

    def test_settings_robot_and_parts_change_while_all_goes_on(self):
        """In the end all use the robot that was made last."""
        settings = self.node.create_client(SetParameters, "distance_node/set_parameters")
        self.assertTrue(settings.wait_for_service(10))
        attach = self.node.create_client(Attach, "distance_node/attach")
        detach = self.node.create_client(Detach, "distance_node/detach")
        part = Attach.Request(name="part", link="arm", is_link=True, shape=SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.05]))
        part.pose.orientation.w = 1.0
        for k in range(BURSTS):
            range_m = 0.5 + 0.01 * k
            parameters = [Parameter("evaluation.range_m", value=range_m).to_parameter_msg()]
            self.description.publish(String(data=URDF.replace("two_boxes", f"robot_{k}")))
            attached = attach.call_async(part)
            self.assertTrue(self.wait_until(attached.done))
            self.description.publish(String(data=URDF))
            # Services are served in any order.
            futures = [settings.call_async(SetParameters.Request(parameters=parameters)), detach.call_async(Detach.Request(name="part"))]
            self.assertTrue(self.wait_until(lambda futures=futures: all(future.done() for future in futures)))
            type(self).newest = None
            self.assertTrue(self.wait_until(lambda range_m=range_m: self.answers() and abs(self.newest.range_m - range_m) < 1e-6
                                            and len(self.newest.links) == 2), f"burst {k}: {self.newest}")


@launch_testing.post_shutdown_test()
class Ended(unittest.TestCase):
    def test_it_ends_as_asked(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)
