"""Occupied, free and hidden space on the topics that planners read."""
import os
import sys

import launch_testing.actions
import numpy as np
import pytest
from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_msgs.msg import PlanningScene
from nav_msgs.msg import OccupancyGrid
from octomap_msgs.msg import Octomap
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FRAME, URDF, LivingRobot, depth_m, transform  # noqa: E402

EDGE_M = 0.05
TOPICS = {"occupied_points": PointCloud2, "unknown_points": PointCloud2, "occupancy": OccupancyGrid,
          "octomap": Octomap, "planning_scene": PlanningScene}


@pytest.mark.launch_test
def generate_test_description():
    rates = {f"{name}_rate_hz": 10.0 for name in TOPICS}
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front"], "question_rate_hz": 50.0, "planner.edge_m": EDGE_M,
            "planner.box_min_m": [-0.5, -0.5, -1.0], "planner.box_max_m": [1.0, 0.5, 0.8],
            # What so coarse a camera tells by default is wider than the post.
            "space.detection_capability_m": 0.04,
            "planner.occupancy_heights_m": [-0.2, 0.0], **rates}]),
        launch_testing.actions.ReadyToTest(),
    ])


def points_of(cloud):
    assert [field.name for field in cloud.fields] == ["x", "y", "z"]
    return np.frombuffer(bytes(cloud.data), np.float32).reshape(-1, cloud.point_step // 4)[:, :3]


def leaves_of(octomap):
    """Centres of the occupied and of the free leaves, cut to the least edge, of a binary octree."""
    assert octomap.binary and octomap.id == "OcTree"
    data = np.array(octomap.data, np.int8).tobytes()
    place = [0]
    leaves = {True: [], False: []}

    def leaf(corner, size, is_occupied):
        count = round(size / octomap.resolution)
        grid = np.mgrid[0:count, 0:count, 0:count].reshape(3, -1).T
        leaves[is_occupied].append(corner + (grid + 0.5) * octomap.resolution)

    def node(corner, size):
        bits = int.from_bytes(data[place[0]:place[0] + 2], "little")
        place[0] += 2
        inner = []
        for child in range(8):
            kind = bits >> 2 * child & 3
            at = corner + size / 2 * np.array([child & 1, child >> 1 & 1, child >> 2 & 1])
            if kind == 3:
                inner.append(at)
            elif kind:
                leaf(at, size / 2, kind == 2)
        for at in inner:
            node(at, size / 2)

    size = octomap.resolution * 2**16
    node(np.full(3, -size / 2), size)
    assert place[0] == len(data)
    return tuple(np.concatenate(leaves[is_occupied]) if leaves[is_occupied] else np.empty((0, 3))
                 for is_occupied in (True, False))


def keys(points):
    return {tuple(key) for key in np.floor(np.asarray(points, float) / EDGE_M).astype(int)}


def in_post(points):
    """Those of the post, at x = 0.6 m, 0.1 m before the root's plane."""
    return points[(abs(points[:, 0] - 0.6) < 0.08) & (abs(points[:, 2] + 0.1) < 0.08)]


class Planners(LivingRobot):
    def step(self, **changes):
        super().step(**{"position": 0.0, **changes})

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.told = {}
        for name, kind in TOPICS.items():
            cls.node.create_subscription(kind, name, lambda message, name=name: cls.told.update({name: message}), 1)

    def has_post(self, wanted):
        def has():
            cloud = self.told.get("occupied_points")
            return cloud is not None and (len(in_post(points_of(cloud))) > 0) == wanted
        return has

    def stamps_agree(self):
        if set(self.told) != set(TOPICS):
            return False
        return len({(m.header.stamp.sec, m.header.stamp.nanosec) for name, m in self.told.items()
                    if name != "planning_scene"}) == 1

    def test_01_the_post_and_the_wall_are_occupied_and_the_robot_is_not(self):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, x=0.3, z=-1)]))
        type(self).depth = depth_m(camera_x=0.3, obstacle=True)
        self.assertTrue(self.until(self.has_post(True)))
        cloud = self.told["occupied_points"]
        self.assertEqual(cloud.header.frame_id, "base")
        points = points_of(cloud)
        self.assertGreater(len(points[abs(points[:, 2] - 0.5) < 0.05]), 100, "the wall 1.5 m before the camera")
        at_robot = points[(abs(points[:, 1]) < 0.09) & (abs(points[:, 2]) < 0.09) & (points[:, 0] < 0.38)]
        self.assertEqual(len(at_robot), 0, at_robot)

    def test_02_what_the_post_hides_is_unknown(self):
        self.assertTrue(self.until(lambda: "unknown_points" in self.told))
        unknown = points_of(self.told["unknown_points"])
        behind = unknown[(abs(unknown[:, 0] - 0.64) < 0.06) & (abs(unknown[:, 1]) < 0.1) & (unknown[:, 2] > 0.1)
                         & (unknown[:, 2] < 0.4)]
        self.assertGreater(len(behind), 5)
        before = unknown[(unknown[:, 2] < -0.2)]
        self.assertEqual(len(before), 0, before)

    def test_03_all_topics_tell_the_same(self):
        self.assertTrue(self.until(self.stamps_agree))
        occupied, free = leaves_of(self.told["octomap"])
        self.assertAlmostEqual(self.told["octomap"].resolution, EDGE_M)
        self.assertEqual(keys(occupied), keys(points_of(self.told["occupied_points"])))
        self.assertGreater(len(free), 1000)
        self.assertFalse(keys(free) & keys(occupied))
        grid = self.told["occupancy"]
        cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)
        row = int((0.02 - grid.info.origin.position.y) / EDGE_M)
        at = [int((x - grid.info.origin.position.x) / EDGE_M) for x in (0.605, -0.45)]
        self.assertEqual(cells[row, at[0]], 100)
        self.assertIn(0, cells)
        self.assertIn(-1, cells)
        scene = self.told["planning_scene"]
        self.assertTrue(scene.is_diff and scene.robot_state.is_diff)
        self.assertEqual(scene.world.octomap.octomap.resolution, EDGE_M)
        self.assertEqual(scene.world.octomap.header.frame_id, "base")
        self.assertGreater(len(scene.world.octomap.octomap.data), 100)

    def test_04_what_became_free_is_cleared(self):
        type(self).depth = depth_m(camera_x=0.3)
        begin = self.now_s
        self.assertTrue(self.until(self.has_post(False)))
        print(f"the post is no longer in occupied_points {self.now_s - begin:.2f} s after it went")
        self.assertLess(self.now_s - begin, 1.0)
        leaves = lambda: leaves_of(self.told["planning_scene"].world.octomap.octomap)
        self.assertTrue(self.until(lambda: len(in_post(leaves()[0])) == 0, seconds=1.0))
        self.assertGreater(len(in_post(leaves()[1])), 0)

    def test_05_without_a_camera_nothing_is_told(self):
        type(self).depth = depth_m(camera_x=0.3, obstacle=True)
        self.assertTrue(self.until(self.has_post(True)))
        self.live_for(0.5, image=None)
        self.told.clear()
        self.live_for(1.5, image=None)
        self.assertEqual(self.told, {})
        self.assertTrue(self.until(lambda: self.logged("topics for planners", "camera front is too_old"), image=None))
        self.assertTrue(self.until(self.has_post(True)))
