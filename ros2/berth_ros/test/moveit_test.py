"""What MoveIt has attached to the robot is the robot's, as its planning scene tells it."""
import os
import sys

import pytest
from berth_msgs.msg import LinkDistances
from geometry_msgs.msg import Pose
from moveit_msgs.msg import AttachedCollisionObject, PlanningScene
from shape_msgs.msg import Plane, SolidPrimitive
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, LivingRobot, depth_m, launched_node, transform  # noqa: E402


@pytest.mark.launch_test
def generate_test_description():
    return launched_node(follow_moveit=True)


def at(x=0.0):
    pose = Pose()
    pose.position.x = x
    return pose


def attached(name="part", link="arm", shapes=1, frame=None, operation=b"\x00"):
    """The post of 4 cm, 0.3 m beside the arm's frame: 0.1 m of it in the object's pose, 0.2 m in the shape's."""
    made = AttachedCollisionObject(link_name=link)
    made.object.id, made.object.operation = name, operation
    made.object.header.frame_id = link if frame is None else frame
    made.object.pose = at(0.1)
    for _ in range(shapes):
        made.object.primitives.append(SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[0.04, 0.4, 0.2]))
        made.object.primitive_poses.append(at(0.2))
    return made


REMOVE = b"\x01"


class FollowsMoveIt(LivingRobot):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scenes = cls.node.create_publisher(PlanningScene, "monitored_planning_scene", 10)

    def step(self, **changes):
        super().step(**{"position": 0.0, **changes})

    def tell(self, *objects, is_diff=True, has_state=False):
        scene = PlanningScene(is_diff=is_diff)
        scene.robot_state.is_diff = is_diff
        scene.robot_state.attached_collision_objects = list(objects)
        if has_state:
            scene.robot_state.joint_state.name, scene.robot_state.joint_state.position = ["turn"], [0.0]
        self.scenes.publish(scene)

    def links(self):
        return [link.link for link in self.newest.links]

    def is_with(self, *parts):
        return self.until(lambda: self.links() == ["base", "arm", *parts] and self.answers(), seconds=5.0)

    def to_occupied_m(self, name):
        return {link.link: link.occupied.distance_m for link in self.newest.links}[name]

    def test_01_an_attached_object_is_the_robots(self):
        type(self).depth = depth_m(camera_x=0.3, obstacle=True)
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, x=0.3, z=-1)]))
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(lambda: abs(self.to_occupied_m("arm") - 0.18) < 0.02), self.to_occupied_m("arm"))
        self.tell(attached())
        self.assertTrue(self.is_with("part"), self.links())
        self.assertGreater(self.to_occupied_m("arm"), 0.28)

    def test_02_a_change_of_something_else_leaves_it(self):
        del self.answers_so_far[:]
        self.tell()
        self.tell(attached())
        self.live_for(0.5)
        self.assertEqual(self.links(), ["base", "arm", "part"])
        # A robot that was made anew has no images at first.
        self.assertTrue(self.answers_so_far)
        self.assertFalse([m for m in self.answers_so_far if m.time_status == LinkDistances.TIME_NO_FRAME], "the robot was made anew")
        self.assertTrue(self.until(self.answers))

    def test_03_what_was_removed_is_an_obstacle(self):
        self.tell(attached(operation=REMOVE))
        self.assertTrue(self.is_with(), self.links())
        self.assertTrue(self.until(lambda: abs(self.to_occupied_m("arm") - 0.18) < 0.02), self.to_occupied_m("arm"))

    def test_04_a_whole_state_without_it_removes_it(self):
        self.tell(attached(shapes=2), attached("label"), has_state=True)
        self.assertTrue(self.is_with("part/0", "part/1", "label"), self.links())
        self.tell(attached("label"), has_state=True)
        self.assertTrue(self.is_with("label"), self.links())
        self.tell(is_diff=False)
        self.assertTrue(self.is_with(), self.links())

    def test_05_what_it_may_touch_is_left_out(self):
        """touch_links may name what is no link of this robot."""
        def to_known(names):
            part = attached()
            part.touch_links = names
            self.tell(part, has_state=True)
            self.live_for(0.5)
            self.assertTrue(self.is_with("part"), self.links())
            return {link.link: link.known.link for link in self.newest.links}["part"]
        self.assertEqual(to_known([]), "base")
        self.assertEqual(to_known(["arm", "no link", "base"]), "")

    def test_06_what_cannot_be_is_said_and_the_rest_is_taken(self):
        flat = attached("flat")
        flat.object.planes = [Plane()]
        self.tell(attached("far", frame="world"), flat, attached("good"), attached("none", shapes=0), attached("lost", link="leg"),
                  has_state=True)
        for parts in [("far", "its pose is in world; expected its link arm"), ("flat", "a plane"), ("none", "no shape")]:
            self.assertTrue(self.until(lambda parts=parts: self.logged("not attached, as MoveIt did", *parts)), parts)
        self.assertTrue(self.until(lambda: self.logged("not attached what MoveIt did", "leg")))
        self.tell(attached("good"), has_state=True)
        self.assertTrue(self.is_with("good"), self.links())
