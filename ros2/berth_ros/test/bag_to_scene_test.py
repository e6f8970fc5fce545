"""A bag of a camera, two joint publishers and TF becomes a scene that berth runs."""
import json
import pathlib
import subprocess

import numpy as np
import pytest
import rosbag2_py
import yaml
from geometry_msgs.msg import TransformStamped
from rclpy.serialization import serialize_message
from sensor_msgs.msg import CameraInfo, Image, JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

TOOL = pathlib.Path(__file__).parent.parent / "scripts" / "berth_bag_to_scene"
BOX = '<visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual>'
URDF = f"""<robot name="boxes"><link name="base">{BOX}</link><link name="arm">{BOX}</link><link name="tip">{BOX}</link>
<joint name="a" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0.3 0 0"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="b" type="prismatic"><parent link="arm"/><child link="tip"/><origin xyz="0.3 0 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
START_S = 1000
STORAGES = sorted({"mcap", "sqlite3"} & rosbag2_py.get_registered_writers())


def stamped(message, seconds, frame=""):
    ns = round((START_S + seconds) * 1e9)
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(ns, 10**9)
    message.header.frame_id = frame
    return message


def depth_image(seconds, encoding):
    depth_m = np.full((48, 64), 1.5, np.float32)
    depth_m[10:30, 20:40] = 0.9
    depth_m[0, 0] = np.nan
    if encoding == "16UC1":
        pixels = np.nan_to_num(depth_m * 1000).round().astype("<u2")
    else:
        pixels = depth_m
    # Rows that are longer than their pixels.
    rows = np.pad(np.ascontiguousarray(pixels).view(np.uint8).reshape(48, -1), ((0, 0), (0, 8)))
    image = Image(width=64, height=48, encoding=encoding, step=rows.shape[1], data=rows.tobytes())
    return stamped(image, seconds, "front_optical_frame")


def transform():
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = "base", "front_mount"
    message.transform.translation.z = -1.0
    message.transform.rotation.w = 1.0
    optical = TransformStamped()
    optical.header.frame_id, optical.child_frame_id = "front_mount", "front_optical_frame"
    optical.transform.rotation.z = optical.transform.rotation.w = 0.5 ** 0.5
    return TFMessage(transforms=[message, optical])


def messages(encoding):
    yield "/robot_description", String(data=URDF)
    yield "/tf_static", transform()
    for k in range(3):
        yield "/joint_states", stamped(JointState(name=["a"], position=[0.1 * k]), 0.1 * k - 0.01)
        yield "/joint_states", stamped(JointState(name=["b"], position=[-0.1 * k]), 0.1 * k)
        info = CameraInfo(width=64, height=48, k=[60.0, 0.0, 31.5, 0.0, 60.0, 23.5, 0.0, 0.0, 1.0])
        yield "/front/camera_info", stamped(info, 0.1 * k)
        yield "/front/depth_image", depth_image(0.1 * k, encoding)
    yield "/joint_states", stamped(JointState(name=["a"], position=[0.3]), 0.3)


def write_bag(folder, encoding="32FC1", without=(), storage=STORAGES[0]):
    writer = rosbag2_py.SequentialWriter()
    writer.open(rosbag2_py.StorageOptions(uri=str(folder), storage_id=storage), rosbag2_py.ConverterOptions("cdr", "cdr"))
    known = set()
    for i, (topic, message) in enumerate(messages(encoding)):
        if topic in without:
            continue
        if topic not in known:
            kind = f"{type(message).__module__.split('.')[0]}/msg/{type(message).__name__}"
            writer.create_topic(rosbag2_py.TopicMetadata(len(known), topic, kind, "cdr"))
            known.add(topic)
        writer.write(topic, serialize_message(message), i)
    writer.close()
    return folder


def run_tool(*arguments):
    return subprocess.run(["/usr/bin/env", "python3", TOOL, *map(str, arguments)], capture_output=True, text=True)


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("encoding", ["32FC1", "16UC1"])
def test_berth_runs_the_scene(tmp_path, encoding, storage):
    out = tmp_path / "scene"
    tool = run_tool(write_bag(tmp_path / "bag", encoding, storage=storage), "--out", out, "--camera", "front")
    assert tool.returncode == 0, tool.stderr
    scene = yaml.safe_load((out / "scene.yaml").read_text())
    camera = scene["cameras"][0]
    assert camera["pose"]["parent"] == "base"
    assert camera["pose"]["xyz"] == pytest.approx([0, 0, -1])
    assert [abs(x) for x in camera["pose"]["quaternion_xyzw"]] == pytest.approx([0, 0, 0.5 ** 0.5, 0.5 ** 0.5], abs=1e-9)
    assert camera["stamps"] == pytest.approx([0, 0.1, 0.2])
    rows = np.loadtxt(out / "joints.csv", delimiter=",", skiprows=1)
    assert (out / "joints.csv").read_text().startswith("time,a,b")
    assert rows[rows[:, 0] == 0.1][0].tolist() == pytest.approx([0.1, 0.11, -0.1])
    with open(out / "scene.yaml", "a") as file:
        file.write("watch: {min_at_robot: 0}\n")  # the images are made up: they show no robot
    run = subprocess.run(["berth", "run", out / "scene.yaml", "--format", "json"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    lines = [json.loads(line) for line in run.stdout.splitlines()]
    assert [line["time"]["status"] for line in lines] == ["ok"] * 3
    assert not (tmp_path / "scene.part").exists()


@pytest.mark.parametrize("without, said", [
    ("/robot_description", "--urdf"),
    ("/front/camera_info", "no camera_info"),
    ("/front/depth_image", "/front/depth_image"),
    ("/joint_states", "/joint_states"),
    ("/tf_static", "front_optical_frame"),
])
def test_what_a_bag_lacks_is_named_and_nothing_is_written(tmp_path, without, said):
    tool = run_tool(write_bag(tmp_path / "bag", without=(without,)), "--out", tmp_path / "scene", "--camera", "front")
    assert tool.returncode == 1
    assert said in tool.stderr and "Traceback" not in tool.stderr
    assert not (tmp_path / "scene").exists()


def test_a_folder_that_is_there_is_not_written_over(tmp_path):
    tool = run_tool(write_bag(tmp_path / "bag"), "--out", tmp_path, "--camera", "front")
    assert tool.returncode == 1 and "is there already" in tool.stderr


def test_what_the_bag_does_not_say(tmp_path):
    out = tmp_path / "scene"
    tool = run_tool(write_bag(tmp_path / "bag"), "--out", out, "--camera", "front", "--rectified", "front", "--fixed-joint", "b=0.25")
    assert tool.returncode == 0, tool.stderr
    assert "left out b" in tool.stdout
    scene = yaml.safe_load((out / "scene.yaml").read_text())
    assert scene["cameras"][0]["rectified"] is True and scene["fixed_joints"] == {"b": 0.25}


def test_wrong_use_is_2(tmp_path):
    assert run_tool("bag").returncode == 2
    assert run_tool("bag", "--out", tmp_path / "x", "--fixed-joint", "b").returncode == 2
    assert run_tool("bag", "--out", tmp_path / "x", "--every", "0").returncode == 2


def test_an_unknown_environment_link_is_named(tmp_path):
    tool = run_tool(write_bag(tmp_path / "bag"), "--out", tmp_path / "scene", "--camera", "front", "--environment-link", "floor")
    assert tool.returncode == 1 and "floor" in tool.stderr and "base, arm, tip" in tool.stderr
