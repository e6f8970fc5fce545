"""No message ends a node: stamps, sizes, encodings, numbers and names as they should not be. Then it goes on."""
import os
import sys
import unittest

import launch_testing.actions
import launch_testing.asserts
import numpy as np
import pytest
from berth_msgs.msg import LinkDistances
from berth_msgs.srv import CheckConfigurations
from geometry_msgs.msg import TransformStamped
from launch import LaunchDescription
from launch_ros.actions import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image, JointState
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout, String
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, HEIGHT, URDF, WIDTH, LivingRobot, transform  # noqa: E402
from named_nodes import MAY_GO  # noqa: E402

MESSAGES = 100_000  # of each topic
QUESTIONS = 1000  # of the service
# The robot is not where odd joint states say: that is another test.
UNWATCHED = {"watch.min_at_robot": 0.0, "watch.max_displacement_m": 0.0}
NODES = {"distance_node": {**MAY_GO, **UNWATCHED, "world_frame": "map", "filter.command_topic": "commands"}, "self_filter_node": UNWATCHED}
SECONDS = (0, 1, -1, 99, 100, 101, 200, 2**31 - 1, -2**31)
NANOSECONDS = (0, 1, 999_999_999, 10**9, 2**32 - 1)
NUMBERS = (0.0, -0.0, 0.1, 1.0, -1.0, 60.0, 1e9, -1e300, 5e-324, float("nan"), float("inf"), float("-inf"))
NAMES = ("turn", "base", "arm", "map", FRAME, "", "/", "/base", "//", "no such name", "ü\n%s", "x" * 5000)
SIZES = (0, 1, WIDTH - 1, WIDTH, HEIGHT, 2**16, 2**31, 2**32 - 1)
ENCODINGS = ("32FC1", "16UC1", "rgb8", "", "32FC1; jpeg compressed", "%s%n")


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable=name, output="screen", parameters=[{**parameters, "use_sim_time": True}],
             remappings=[("depth_image", "front/depth_image"), ("camera_info", "front/camera_info")])
        for name, parameters in NODES.items()
    ] + [launch_testing.actions.ReadyToTest()])


class Fuzz(LivingRobot):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.random = np.random.default_rng(1)
        cls.wanted = cls.node.create_publisher(Float64MultiArray, "wanted_velocity", qos_profile_sensor_data)
        cls.plans = cls.node.create_publisher(JointState, "planned_joint_states", qos_profile_sensor_data)

    def one_of(self, values):
        return values[self.random.integers(len(values))]

    def some_of(self, values, most=4):
        return [self.one_of(values) for _ in range(self.random.integers(most))]

    def stamp(self, header):
        """Half of them are as they should be."""
        if self.random.random() < 0.5:
            type(self).now_s += 1e-5
            header.stamp = self.time_of(self.now_s)
        else:
            header.stamp.sec, header.stamp.nanosec = self.one_of(SECONDS), self.one_of(NANOSECONDS)

    def joint_state(self):
        state = JointState(name=self.some_of(NAMES), position=self.some_of(NUMBERS), velocity=self.some_of(NUMBERS))
        self.stamp(state.header)
        return state

    def odd_velocity(self):
        dimensions = [MultiArrayDimension(label=name, size=self.one_of(SIZES)) for name in self.some_of(NAMES)]
        return Float64MultiArray(layout=MultiArrayLayout(dim=dimensions, data_offset=self.one_of(SIZES)), data=self.some_of(NUMBERS, most=3))

    def odd_question(self):
        is_odd = self.random.random(5) < 0.3
        points = [JointTrajectoryPoint(positions=self.some_of(NUMBERS, most=3) if is_odd[4] else [self.one_of(NUMBERS[:-3])])
                  for _ in range(self.random.integers(5))]
        return CheckConfigurations.Request(
            trajectory=JointTrajectory(joint_names=self.some_of(NAMES) if is_odd[0] else ["turn"], points=points),
            margin_m=self.one_of(NUMBERS) if is_odd[1] else 0.03, known_margin_m=self.one_of(NUMBERS) if is_odd[2] else 0.0,
            without=self.some_of(NAMES) if is_odd[3] else [], check_motions=bool(self.random.integers(2)), resolve=bool(self.random.integers(2)))

    def odd_info(self):
        info = CameraInfo(width=self.one_of(SIZES), height=self.one_of(SIZES), k=[self.one_of(NUMBERS) for _ in range(9)],
                          p=[self.one_of(NUMBERS) for _ in range(12)], d=self.some_of(NUMBERS), binning_x=self.one_of((0, 1, 2)))
        info.header.frame_id = self.one_of((FRAME, FRAME, self.one_of(NAMES)))
        self.stamp(info.header)
        return info

    def odd_image(self):
        image = self.image()
        self.stamp(image.header)
        image.header.frame_id = self.one_of((FRAME, FRAME, FRAME, self.one_of(NAMES)))
        key = self.one_of(("width", "height", "step", "encoding", "data", "is_bigendian", None, None))
        if key == "data":
            odd = np.resize(np.array(NUMBERS, "float32"), WIDTH * HEIGHT)
            image.data = self.one_of((b"", b"\0" * 7, odd.tobytes(), image.data))
        elif key is not None:
            setattr(image, key, self.one_of({"encoding": ENCODINGS, "is_bigendian": (0, 1)}.get(key, SIZES)))
        return image

    def odd_transform(self):
        made = TransformStamped(child_frame_id=self.one_of(NAMES))
        made.header.frame_id = self.one_of(NAMES)
        self.stamp(made.header)
        t, q = made.transform.translation, made.transform.rotation
        t.x, t.y, t.z = (self.one_of(NUMBERS) for _ in range(3))
        q.x, q.y, q.z, q.w = self.one_of(((0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 0.0), tuple(self.one_of(NUMBERS) for _ in range(4))))
        return TFMessage(transforms=[made])

    def odd_description(self):
        """A word of the robot's description is another one."""
        words = URDF.split('"')
        words[self.random.integers(len(words))] = self.one_of((*NAMES, "1e999", "nan", "revolute", "continuous", "fixed", "-1 -1 -1"))
        return String(data='"'.join(words).replace("\0", ""))

    def hail(self, publisher, make, count):
        for k in range(count):
            publisher.publish(make())
            if k % 100 == 0:
                self.step(joints=k % 200 == 0)

    def ask(self, count):
        """Each is answered: where it is refused, with a message."""
        client = self.node.create_client(CheckConfigurations, "distance_node/check_configurations")
        self.assertTrue(client.wait_for_service(10))
        answers = []
        for k in range(count):
            future = client.call_async(self.odd_question())
            self.assertTrue(self.until(future.done), k)
            answers.append(future.result())
        self.assertTrue(all(answer.success or answer.message for answer in answers))
        print(f"{sum(answer.success for answer in answers)} of {count} odd questions have verdicts")

    def goes_on(self, what, statuses=(LinkDistances.OK,)):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1), transform("map", "base")]))
        type(self).newest = None
        self.assertTrue(self.until(lambda: self.newest is not None and self.newest.status in statuses), f"after {what}: {self.newest}")
        print(f"after {what}: it goes on")

    def test_1_it_lives(self):
        self.goes_on("nothing")

    def test_2_no_message_ends_it(self):
        for what, publisher, make, count in (
                ("joint states", self.joints, self.joint_state, MESSAGES), ("plans", self.plans, self.joint_state, MESSAGES),
                ("wanted velocities", self.wanted, self.odd_velocity, MESSAGES),
                ("camera infos", self.infos, self.odd_info, MESSAGES), ("images", self.images, self.odd_image, MESSAGES),
                ("descriptions", self.description, self.odd_description, 1000)):
            with self.subTest(what):
                self.hail(publisher, make, count)
                self.goes_on(what)
        self.ask(QUESTIONS)
        self.goes_on("questions")
        self.hail(self.tf, self.odd_transform, MESSAGES)
        # TF's tree is what they made it.
        self.goes_on("transforms", statuses=(LinkDistances.OK, LinkDistances.STALE))


@launch_testing.post_shutdown_test()
class Ended(unittest.TestCase):
    def test_both_end_as_asked(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)
