"""A part that the robot takes up is an obstacle before, and the robot's while it is attached."""
import os
import sys

import numpy as np
import pytest
from berth_msgs.msg import LinkDistances
from berth_msgs.srv import Attach, Detach
from geometry_msgs.msg import Point
from shape_msgs.msg import Mesh, MeshTriangle, SolidPrimitive
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, LivingRobot, depth_m, launched_node, transform  # noqa: E402

POST_M = (0.04, 0.4, 0.2)
IN_ARM_M = 0.3  # from the arm's frame to the post
TO_POST_M = 0.18


@pytest.mark.launch_test
def generate_test_description():
    return launched_node()


def post(name="part", link="arm", **changes):
    request = Attach.Request(name=name, link=link, is_link=True)
    request.shape = SolidPrimitive(type=SolidPrimitive.BOX, dimensions=list(POST_M))
    request.pose.position.x, request.pose.orientation.w = IN_ARM_M, 1.0
    for key, value in changes.items():
        setattr(request, key, value)
    return request


class AttachAndDetach(LivingRobot):
    def step(self, **changes):
        super().step(**{"position": 0.0, **changes})

    def attach(self, **changes):
        return self.call(Attach, "distance_node/attach", post(**changes))

    def detach(self, name="part"):
        return self.call(Detach, "distance_node/detach", Detach.Request(name=name))

    def links(self):
        return [link.link for link in self.newest.links]

    def to_occupied_m(self, name):
        return {link.link: link.occupied.distance_m for link in self.newest.links}[name]

    def test_01_without_a_robot_nothing_is_attached(self):
        answer = self.attach()
        self.assertFalse(answer.success)
        self.assertIn("no robot model", answer.message)

    def test_02_the_part_is_an_obstacle(self):
        type(self).depth = depth_m(camera_x=0.3, obstacle=True)
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, x=0.3, z=-1)]))
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(lambda: abs(self.to_occupied_m("arm") - TO_POST_M) < 0.02), self.to_occupied_m("arm"))

    def test_03_attached_it_is_the_robots(self):
        del self.answers_so_far[:]
        begin = self.now_s
        answer = self.attach()
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(self.until(lambda: "part" in self.links() and self.answers()))
        print(f"answers with the part {self.now_s - begin:.2f} s after the request")
        self.assertGreater(self.to_occupied_m("arm"), TO_POST_M + 0.1, "the part is no obstacle any more")
        self.live_for(0.5)
        # No answer of the new robot stands on an image whose part was not taken out.
        for message in list(self.answers_so_far):
            if message.status == LinkDistances.OK and len(message.links) == 3:
                near = [link.occupied.distance_m for link in message.links if link.link != "base"]
                self.assertTrue(all(np.isnan(m) or m > 0.1 for m in near), near)

    def test_04_it_stays_while_settings_change_and_another_robot_comes(self):
        self.description.publish(String(data=URDF.replace("two_boxes", "same_boxes")))
        self.live_for(0.3)
        self.assertTrue(self.until(lambda: "part" in self.links() and self.answers()))
        self.description.publish(String(data=URDF.replace('"arm"', '"upper_arm"')))
        self.assertTrue(self.until(lambda: "upper_arm" in self.links() and self.answers()))
        self.assertNotIn("part", self.links())
        self.assertTrue(self.until(lambda: self.logged("detached part")))
        self.description.publish(String(data=URDF))
        self.assertTrue(self.until(lambda: "arm" in self.links() and self.answers()))
        self.assertTrue(self.attach().success)
        self.assertTrue(self.until(lambda: "part" in self.links() and self.answers()))

    def test_05_detached_it_is_an_obstacle_again(self):
        self.assertTrue(self.detach().success)
        self.assertTrue(self.until(lambda: "part" not in self.links() and self.answers()))
        self.assertTrue(self.until(lambda: abs(self.to_occupied_m("arm") - TO_POST_M) < 0.02), self.to_occupied_m("arm"))

    def test_06_a_mesh_and_a_part_of_the_link(self):
        x, y, z = (length / 2 for length in POST_M)
        corners = [Point(x=a * x, y=b * y, z=c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
        faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
                 (1, 5, 7), (1, 7, 3)]
        mesh = Mesh(vertices=corners, triangles=[MeshTriangle(vertex_indices=face) for face in faces])
        answer = self.attach(shape=SolidPrimitive(), mesh=mesh, is_link=False)
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(self.until(lambda: self.answers() and self.to_occupied_m("arm") > TO_POST_M + 0.1))
        self.assertEqual(self.links(), ["base", "arm"])
        self.assertTrue(self.detach().success)

    def test_07_what_it_may_touch_is_left_out(self):
        for may_touch, known in (([], "base"), (["base"], "")):
            self.assertTrue(self.attach(may_touch=may_touch).success)
            self.assertTrue(self.until(lambda: "part" in self.links() and self.answers()))
            self.assertEqual({link.link: link.known.link for link in self.newest.links}["part"], known)
            self.assertTrue(self.detach().success)
            self.assertTrue(self.until(lambda: "part" not in self.links() and self.answers()))

    def test_08_what_is_wrong_is_named(self):
        cone = SolidPrimitive(type=SolidPrimitive.CONE, dimensions=[0.1, 0.1])
        flat = SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[0.1, 0.0, 0.1])
        short = SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[0.1])
        turned = post().pose
        turned.orientation.w = 0.5
        nowhere = post().pose
        nowhere.position.x = float("nan")
        torn = Mesh(vertices=[Point()], triangles=[MeshTriangle(vertex_indices=(0, 0, 7))])
        wrong = [
            ({"link": "finger"}, ("finger", "no evaluated link", "base, arm")),
            ({"name": ""}, ("name: empty",)),
            ({"shape": cone}, ("type 4", "BOX (1), SPHERE (2) or CYLINDER (3)")),
            ({"shape": flat}, ("dimension 1 is 0", "metres above 0")),
            ({"shape": short}, ("1 dimensions",)),
            ({"shape": SolidPrimitive()}, ("one of shape, mesh and mesh_resource; 0 are given",)),
            ({"mesh_resource": "package://berth_ros/none.stl"}, ("2 are given",)),
            ({"shape": SolidPrimitive(), "mesh_resource": "package://berth_ros/none.stl"}, ("none.stl",)),
            ({"shape": SolidPrimitive(), "mesh_resource": "package://no_package/none.stl"}, ("no_package",)),
            ({"shape": SolidPrimitive(), "mesh": torn}, ("vertex 7",)),
            ({"pose": turned}, ("pose", "length is not 1")),
            ({"pose": nowhere}, ("pose", "not finite")),
            ({"name": "arm"}, ("arm", "a link has this name")),
            ({"may_touch": ["table"]}, ("may_touch", "table")),
            ({"may_touch": ["base"], "is_link": False}, ("may_touch", "link of its own")),
        ]
        for changes, parts in wrong:
            answer = self.attach(**changes)
            self.assertFalse(answer.success, changes)
            self.assertTrue(all(part in answer.message for part in parts), f"{changes}: {answer.message}")
        self.assertIn("nothing called", self.detach("none").message)
        self.assertTrue(self.until(self.answers), "it goes on")
        self.assertTrue(self.attach().success)
        self.assertIn("part", self.attach().message, "attached already")
        self.assertTrue(self.detach().success)
