"""The black box: a stop is recorded, so is what somebody asks for, and each recording replays to the last bit."""
import json
import os
import subprocess
import sys
import tempfile

import launch_testing.actions
import pytest
from berth_msgs.msg import Separation
from launch import LaunchDescription
from launch_ros.actions import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from living_robot import FOCAL, FRAME, URDF, TwoCameras, transform  # noqa: E402

FOLDER = tempfile.TemporaryDirectory()
FILE = os.path.join(FOLDER.name, "seen.mcap")


@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription([
        Node(package="berth_ros", executable="distance_node", output="screen", parameters=[{
            "use_sim_time": True, "cameras": ["front", "side"], "question_rate_hz": 50.0, "separation.monitor": True, "separation.no_reading": "ignore",
            "separation.not_seen": "ignore", "separation.unknown": "ignore", "separation.human_speed_m_s": 0.1,
            "separation.intrusion_m": 0.0, "evaluation.min_seen_share": 0.0, "record.file": FILE, "record.seconds": 5.0}]),
        launch_testing.actions.ReadyToTest(),
    ])


def numbered(k):
    return FILE if k == 1 else FILE.replace(".mcap", f"_{k}.mcap")


class Record(TwoCameras):
    def write(self):
        return self.call(Trigger, "distance_node/record", Trigger.Request())

    def replayed(self, k):
        """Each line that the replay of the k-th recording gives; it has to be told in the log before."""
        self.assertTrue(self.until(lambda: self.logged(numbered(k), "written")), self.log[-5:])
        run = subprocess.run(["berth", "replay", numbered(k), "--format", "json"], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.stdout[-500:])
        lines = [json.loads(line) for line in run.stdout.splitlines()]
        print(f"{os.path.basename(numbered(k))}: {os.path.getsize(numbered(k))} bytes, {len(lines)} requests")
        self.assertGreater(len(lines), 10)
        self.assertFalse(any(line["difference"] for line in lines))
        return lines

    def go_on(self):
        self.assertTrue(self.until(self.answers))
        self.assertTrue(self.until(self.is_state(Separation.CLEAR, Separation.REDUCED)), self.separation)

    def test_01_before_any_image_there_is_nothing_to_write(self):
        response = self.write()
        self.assertFalse(response.success)
        self.assertIn("no image", response.message)

    def test_02_a_stop_is_recorded(self):
        self.description.publish(String(data=URDF))
        self.tf_static.publish(TFMessage(transforms=[transform("base", FRAME, z=-1)]))
        self.go_on()
        self.live_for(1)
        type(self).side_image = None
        self.assertTrue(self.until(self.is_state(Separation.STOP)))
        self.live_for(2)
        type(self).side_image = type(self).image
        states = [line["result"]["separation"]["state"] for line in self.replayed(1)]
        self.assertIn("stop", states)
        self.assertTrue({"clear", "reduced"} & set(states))

    def test_03_so_is_what_somebody_asks_for(self):
        self.go_on()
        self.assertTrue(self.write().success)
        self.replayed(2)

    def test_04_another_camera_is_another_recorder(self):
        type(self).focal = FOCAL * 1.01
        self.live_for(1)
        self.go_on()
        self.live_for(1)
        self.assertTrue(self.write().success)
        cameras = {line["result"]["cameras"][0]["status"] for line in self.replayed(3)}
        self.assertIn("ok", cameras)

    def test_05_so_is_another_robot(self):
        self.description.publish(String(data=URDF.replace("two_boxes", "two_others")))
        self.live_for(1)
        self.go_on()
        self.live_for(1)
        self.assertTrue(self.write().success)
        self.replayed(4)
        self.assertFalse(self.logged("left it"), "each ring is gone before the next one begins")
