"""Each fault is said, crashes nothing, and is over once it is mended."""
import array
import math
import threading
import time
import unittest

import launch_testing.actions
import pytest
import rclpy
from berth_msgs.msg import LinkDistances
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from launch import LaunchDescription
from launch_ros.actions import Node
from rcl_interfaces.srv import SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL = 64, 48, 60.0
BOX = '<visual><origin xyz="0 0 {z}"/><geometry><box size="0.2 0.2 0.2"/></geometry></visual>'
URDF = f"""<robot name="two_boxes">
  <link name="base">{BOX.format(z=0)}</link>
  <link name="arm">{BOX.format(z=0)}</link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0.3 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 50.0, "max_joint_hold_s": 0.0,
            "front.max_wait_s": 0.05}]),
        launch_testing.actions.ReadyToTest(),
    ])


def depth_m():
    """The two boxes, 1 m before the camera, and a wall behind them."""
    image = []
    for v in range(HEIGHT):
        for u in range(WIDTH):
            x, y = (u - 31.5) / FOCAL * 0.9, (v - 23.5) / FOCAL * 0.9
            on_box = abs(y) < 0.1 and (abs(x) < 0.1 or abs(x - 0.3) < 0.1)
            image.append(0.9 if on_box else 1.5)
    return image


class Faults(unittest.TestCase):
    """One node through one fault after another: the names' order is that of the tests."""

    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = node = rclpy.create_node("faulty_robot")
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        cls.clock = node.create_publisher(Clock, "/clock", 10)
        cls.description = node.create_publisher(String, "robot_description", latched)
        cls.joints = node.create_publisher(JointState, "joint_states", 10)
        cls.images = node.create_publisher(Image, "front/depth_image", qos_profile_sensor_data)
        cls.infos = node.create_publisher(CameraInfo, "front/camera_info", qos_profile_sensor_data)
        cls.tf = node.create_publisher(TFMessage, "/tf_static", latched)
        cls.client = node.create_client(SetParameters, "distance_node/set_parameters")
        cls.newest, cls.diagnostics, cls.lock = None, {}, threading.Lock()
        node.create_subscription(LinkDistances, "distances", cls.on_distances, 10)
        node.create_subscription(DiagnosticArray, "/diagnostics", cls.on_diagnostics, 10)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        threading.Thread(target=executor.spin, daemon=True).start()
        cls.now_s = 100.0
        cls.depth = array.array("f", depth_m())

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    @classmethod
    def on_distances(cls, message):
        cls.newest = message

    @classmethod
    def on_diagnostics(cls, message):
        with cls.lock:
            for status in message.status:
                cls.diagnostics[status.name.split(": ")[-1]] = status

    def message(self, name):
        with self.lock:
            return self.diagnostics[name].message if name in self.diagnostics else ""

    def time_of(self, seconds):
        return rclpy.time.Time(nanoseconds=round(seconds * 1e9)).to_msg()

    def image(self, **changes):
        image = Image(width=WIDTH, height=HEIGHT, encoding="32FC1", step=4 * WIDTH, data=self.depth.tobytes())
        image.header.frame_id = "front_optical_frame"
        image.header.stamp = self.time_of(self.now_s)
        for key, value in changes.items():
            setattr(image, key, value)
        return image

    def step(self, image="good", joints=True, names=("turn",)):
        """A 20th of a second of the robot's life."""
        for _ in range(5):
            type(self).now_s += 0.01
            self.clock.publish(Clock(clock=self.time_of(self.now_s)))
            if joints:
                state = JointState(name=list(names), position=[0.1] * len(names))
                state.header.stamp = self.time_of(self.now_s)
                self.joints.publish(state)
            time.sleep(0.01)
        info = CameraInfo(width=WIDTH, height=HEIGHT, k=[FOCAL, 0.0, 31.5, 0.0, FOCAL, 23.5, 0.0, 0.0, 1.0])
        self.infos.publish(info)
        if image == "good":
            self.images.publish(self.image())
        elif image is not None:
            self.images.publish(image)

    def until(self, what, seconds=20.0, **step):
        """Lives on until it is so."""
        end = time.time() + seconds
        while time.time() < end:
            self.step(**step)
            if what():
                return True
        return False

    def time_status_is(self, status):
        return lambda: self.newest is not None and self.newest.time_status == status

    def answers(self):
        return self.newest.status == LinkDistances.OK and any(math.isfinite(x.distance_m) for x in self.newest.links)

    def expect_said(self, name, *parts, **step):
        said = self.until(lambda: all(part in self.message(name) for part in parts), **step)
        self.assertTrue(said, f"{name}: {self.message(name)!r}; expected {parts}")

    def test_01_no_robot_is_a_status(self):
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_ROBOT)))
        self.expect_said("robot", "no robot_description")

    def test_02_a_description_that_is_no_urdf_is_said(self):
        self.description.publish(String(data="this is no robot"))
        self.expect_said("robot", "robot_description")
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_ROBOT)))

    def test_03_then_a_good_one_and_no_transform(self):
        self.description.publish(String(data=URDF))
        self.expect_said("camera front", "no transform", "front_optical_frame")
        self.assertTrue(self.until(self.time_status_is(LinkDistances.TIME_NO_FRAME)))

    def test_04_with_the_transform_there_are_distances(self):
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "base", "front_optical_frame"
        transform.transform.translation.z = -1.0
        transform.transform.rotation.w = 1.0
        self.tf.publish(TFMessage(transforms=[transform]))
        self.assertTrue(self.until(self.answers))
        self.expect_said("camera front", "ok")

    def test_05_wrong_images_are_named(self):
        wrong = [
            ({"encoding": "rgb8"}, "rgb8"),
            ({"is_bigendian": 1}, "big-endian"),
            ({"width": WIDTH - 1}, "camera_info"),
            ({"step": 4 * WIDTH - 4}, "rows of"),
            ({"data": self.depth.tobytes()[:-4]}, "bytes"),
        ]
        for change, said in wrong:
            end = time.time() + 20
            while said not in self.message("camera front") and time.time() < end:
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

    def test_10_a_clock_that_is_set_back_is_a_new_beginning(self):
        type(self).now_s = 20.0
        type(self).newest = None
        self.assertTrue(self.until(lambda: self.newest is not None and self.answers()))
        self.assertLess(self.newest.header.stamp.sec, 50)

    def test_11_settings_change_while_it_runs(self):
        def set_parameter(name, value):
            parameter = Parameter(name, value=value).to_parameter_msg()
            future = self.client.call_async(SetParameters.Request(parameters=[parameter]))
            self.until(future.done)
            return future.result().results[0]
        self.assertTrue(set_parameter("evaluation.range_m", 0.25).successful)
        self.assertTrue(self.until(lambda: abs(self.newest.range_m - 0.25) < 1e-6 and self.newest.status == LinkDistances.OK))
        refused = set_parameter("evaluation.range_m", -1.0)
        self.assertFalse(refused.successful)
        self.assertIn("range_m", refused.reason)
        self.assertFalse(set_parameter("evaluation.method", "exact").successful, "no parameter of the node")
        self.assertFalse(set_parameter("sensor.holes", "fast").successful)
        self.assertFalse(set_parameter("cameras", ["left"]).successful)
        self.assertTrue(set_parameter("evaluation.range_m", 1.0).successful)
        self.assertTrue(self.until(self.answers))

    def test_12_another_robot_takes_its_place(self):
        self.description.publish(String(data=URDF.replace("two_boxes", "three").replace(
            "</robot>", '<link name="hand">' + BOX.format(z=0.3) + '</link><joint name="to_hand" type="fixed">'
            '<parent link="arm"/><child link="hand"/></joint></robot>')))
        self.assertTrue(self.until(lambda: len(self.newest.links) == 3 and self.answers()))
        self.description.publish(String(data=URDF))
        self.assertTrue(self.until(lambda: len(self.newest.links) == 2 and self.answers()))
