"""The example multiplies what Servo reads, and says 0 where nothing is known."""
import importlib.machinery
import importlib.util
import pathlib

import pytest
import rclpy
from berth_msgs.msg import Separation
from control_msgs.msg import JointJog
from geometry_msgs.msg import TwistStamped

FILE = pathlib.Path(__file__).parent.parent / "examples" / "scale_twist"
LOADER = importlib.machinery.SourceFileLoader("scale_twist", str(FILE))
scale_twist = importlib.util.module_from_spec(importlib.util.spec_from_loader("scale_twist", LOADER))
LOADER.exec_module(scale_twist)


@pytest.fixture
def node():
    rclpy.init()
    made = scale_twist.ScaleTwist()
    yield made
    made.destroy_node()
    rclpy.shutdown()


def twist():
    made = TwistStamped()
    made.twist.linear.x, made.twist.angular.z = 0.4, -1.0
    return made


def test_a_twist_is_slowed_down_in_all_its_parts():
    slow = scale_twist.scaled(twist(), 0.25).twist
    assert (slow.linear.x, slow.linear.y, slow.angular.z) == (0.1, 0.0, -0.25)


def test_a_jog_is_slowed_down_in_velocities_and_steps():
    slow = scale_twist.scaled_jog(JointJog(joint_names=["a", "b"], velocities=[0.4, -1.0], displacements=[2.0, 0.0]), 0.25)
    assert (list(slow.velocities), list(slow.displacements), slow.joint_names) == ([0.1, -0.25], [0.5, 0.0], ["a", "b"])


def test_it_goes_by_the_newest_separation_and_not_by_an_old_one(node):
    assert node.scale() == 0.0
    node.on_separation(Separation(state=Separation.REDUCED, speed_scale=0.3))
    assert node.scale() == pytest.approx(0.3)
    node.on_separation(Separation(state=Separation.STOP, speed_scale=0.0))
    assert node.scale() == 0.0
    node.on_separation(Separation(state=Separation.REDUCED, speed_scale=0.3))
    node.heard_s -= 1
    assert node.scale() == 0.0
