"""A robot of two boxes before one camera, whose life a test steers tick by tick on /clock."""
import threading
import time
import unittest

import launch_testing.actions
import numpy as np
import rclpy
from berth_msgs.msg import LinkDistances, Separation
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from launch import LaunchDescription
from launch_ros.actions import Node
from rcl_interfaces.msg import Log
from rcl_interfaces.srv import SetParameters
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState
from std_msgs.msg import Float64, String
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL = 64, 48, 60.0
BOX = '<visual><origin xyz="0 0 {z}"/><geometry><box size="0.2 0.2 0.2"/></geometry></visual>'
URDF = f"""<robot name="two_boxes">
  <link name="base">{BOX.format(z=0)}</link>
  <link name="arm">{BOX.format(z=0)}</link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0.3 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>"""
# Its arm is a box of 0.1 m that slides along y.
SLIDING = (URDF.replace('type="revolute"', 'type="prismatic"').replace('xyz="0 0 1"', 'xyz="0 1 0"').replace('"-3" upper="3"', '"-0.4" upper="0.4"')
           .replace("0.2 0.2 0.2", "0.1 0.1 0.1"))
AT_POST_M = -0.2
FRAME = "front_optical_frame"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def launched_node(**parameters):
    """distance_node alone, with the camera and the clock of this robot."""
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 50.0, **parameters}]),
        launch_testing.actions.ReadyToTest(),
    ])


def depth_m(camera_x=0.0, obstacle=False):
    """The two boxes, 1 m before the camera, a wall behind them, and a post of 4 cm beside the arm, at x = 0.6 m."""
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    x, y = (u - 31.5) / FOCAL * 0.9 + camera_x, (v - 23.5) / FOCAL * 0.9
    on_box = (abs(y) < 0.1) & ((abs(x) < 0.1) | (abs(x - 0.3) < 0.1))
    image = np.where(on_box, 0.9, 1.5)
    if obstacle:
        image[(abs(x - 0.6) < 0.02) & (abs(y) < 0.2)] = 0.9
    return image.astype("float32")


def sliding_depth_m(arm_y=0.0):
    """Of SLIDING: the arm before the camera, the base at its side, a post at y = -0.2 m, and a wall behind them."""
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    x, y = (u - 31.5) / FOCAL * 0.95 + 0.3, (v - 23.5) / FOCAL * 0.95
    on_base, on_arm = (abs(y) < 0.05) & (abs(x) < 0.05), (abs(y - arm_y) < 0.05) & (abs(x - 0.3) < 0.05)
    image = np.where(on_base | on_arm, 0.95, 1.5)
    image[(abs(y - AT_POST_M) < 0.03) & (abs(x - 0.3) < 0.1)] = 0.95
    return image.astype("float32")


def transform(parent, child, x=0.0, z=0.0, stamp=None):
    made = TransformStamped()
    made.header.frame_id, made.child_frame_id = parent, child
    made.transform.translation.x, made.transform.translation.z = float(x), float(z)
    made.transform.rotation.w = 1.0
    if stamp is not None:
        made.header.stamp = stamp
    return made


def spin_beside(*nodes, executor=None):
    """Spins the nodes in a thread of its own, which is returned, until rclpy is shut down."""
    executor = executor or SingleThreadedExecutor()
    for node in nodes:
        executor.add_node(node)

    def spin():
        try:
            executor.spin()
        except ExternalShutdownException:
            pass
    thread = threading.Thread(target=spin, daemon=True)
    thread.start()
    return thread


class LivingRobot(unittest.TestCase):
    """Tests in the order of their names, on one node."""

    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.node = node = rclpy.create_node("living_robot")
        cls.clock = node.create_publisher(Clock, "/clock", 10)
        cls.description = node.create_publisher(String, "robot_description", LATCHED)
        cls.joints = node.create_publisher(JointState, "joint_states", 10)
        cls.images = node.create_publisher(Image, "front/depth_image", qos_profile_sensor_data)
        cls.infos = node.create_publisher(CameraInfo, "front/camera_info", qos_profile_sensor_data)
        cls.tf = node.create_publisher(TFMessage, "/tf", 100)
        cls.tf_static = node.create_publisher(TFMessage, "/tf_static", LATCHED)
        cls.newest, cls.separation, cls.scale, cls.diagnostics, cls.log = None, None, None, {}, []
        cls.answers_so_far, cls.lock = [], threading.Lock()
        node.create_subscription(LinkDistances, "distances", cls.on_distances, 10)
        node.create_subscription(Separation, "separation", cls.on_separation, 10)
        node.create_subscription(Float64, "speed_scale", cls.on_scale, 10)
        node.create_subscription(DiagnosticArray, "/diagnostics", cls.on_diagnostics, 10)
        node.create_subscription(Log, "/rosout", lambda m: cls.log.append((m.level, m.msg)), 100)
        spin_beside(node)
        cls.now_s = 100.0
        cls.focal, cls.distortion = FOCAL, []
        cls.depth = depth_m()

    @classmethod
    def tearDownClass(cls):
        rclpy.try_shutdown()

    @classmethod
    def on_distances(cls, message):
        cls.newest = message
        cls.answers_so_far.append(message)

    @classmethod
    def on_separation(cls, message):
        cls.separation = message

    @classmethod
    def on_scale(cls, message):
        cls.scale = message.data

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
        image.header.frame_id = FRAME
        image.header.stamp = self.time_of(self.now_s)
        for key, value in changes.items():
            setattr(image, key, value)
        return image

    def advance(self):
        type(self).now_s += 0.01

    def tick(self):
        """Called each 10 ms of the robot's life, after its clock went on."""

    def step(self, image="good", joints=True, joints_every=1, names=("turn",), position=0.1, frame_id=FRAME):
        """A 20th of a second of the robot's life, with joint states in each tick, or in every Nth."""
        for tick in range(5):
            self.advance()
            self.clock.publish(Clock(clock=self.time_of(self.now_s)))
            self.tick()
            if joints and tick % joints_every == 0:
                state = JointState(name=list(names), position=[position] * len(names))
                state.header.stamp = self.time_of(self.now_s)
                self.joints.publish(state)
            time.sleep(0.01)
        info = CameraInfo(width=WIDTH, height=HEIGHT, k=[self.focal, 0.0, 31.5, 0.0, self.focal, 23.5, 0.0, 0.0, 1.0],
                          d=self.distortion)
        info.header.frame_id = FRAME
        self.infos.publish(info)
        if isinstance(image, str):
            image = self.image()
            image.header.frame_id = frame_id
        if image is not None:
            self.images.publish(image)

    def until(self, what, seconds=20.0, **step):
        """Lives on until it is so, for these seconds of the robot's life at most: a computer that stands still has not lived."""
        for _ in range(round(seconds / 0.05)):
            self.step(**step)
            if what():
                return True
        return False

    def live_for(self, seconds, **step):
        for _ in range(round(seconds / 0.05)):
            self.step(**step)

    def time_status_is(self, status):
        return lambda: self.newest is not None and self.newest.time_status == status

    def answers(self):
        return (self.newest is not None and self.newest.status == LinkDistances.OK
                and any(np.isfinite(x.distance_m) for x in self.newest.links))

    def expect_said(self, name, *parts, **step):
        said = self.until(lambda: all(part in self.message(name) for part in parts), **step)
        self.assertTrue(said, f"{name}: {self.message(name)!r}; expected {parts}")

    def call(self, kind, name, request, **step):
        client = self.node.create_client(kind, name)
        self.assertTrue(client.wait_for_service(10))
        future = client.call_async(request)
        self.assertTrue(self.until(future.done, **step))
        return future.result()

    def set_parameter(self, node, name, value):
        parameter = Parameter(name, value=value).to_parameter_msg()
        return self.call(SetParameters, f"{node}/set_parameters", SetParameters.Request(parameters=[parameter])).results[0]

    def logged(self, *parts):
        return [text for _, text in self.log if all(part in text for part in parts)]


class TwoCameras(LivingRobot):
    """The same with a second camera, `side`, that sees the same."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.side_images = cls.node.create_publisher(Image, "side/depth_image", qos_profile_sensor_data)
        cls.side_infos = cls.node.create_publisher(CameraInfo, "side/camera_info", qos_profile_sensor_data)
        cls.side_image = cls.image  # what it gives; None: nothing

    def step(self, **changes):
        super().step(**changes)
        info = CameraInfo(width=WIDTH, height=HEIGHT, k=[FOCAL, 0.0, 31.5, 0.0, FOCAL, 23.5, 0.0, 0.0, 1.0])
        info.header.frame_id = FRAME
        self.side_infos.publish(info)
        if self.side_image is not None:
            self.side_images.publish(self.side_image())

    def is_state(self, *states):
        return lambda: self.separation is not None and self.separation.state in states
