"""What is misspelt or missing ends a node, or a launch, with a message that names it."""
import os
import subprocess

import pytest
from ament_index_python.packages import get_package_prefix

PROGRAMS = os.path.join(get_package_prefix("berth_ros"), "lib", "berth_ros")


def run(node, *arguments):
    program = os.path.join(PROGRAMS, node)
    try:
        done = subprocess.run([program, "--ros-args", *arguments], capture_output=True, text=True, timeout=4)
    except subprocess.TimeoutExpired as running:
        return 0, (running.stderr or b"").decode()
    return done.returncode, done.stderr


@pytest.mark.parametrize("node, given, nearest", [
    ("distance_node", "self_filter.tolerence_m:=0.1", "self_filter.tolerance_m"),
    ("distance_node", "camera.self_filter.paddin_m:=0.1", "camera.self_filter.padding_m"),
    ("distance_node", "separation.monitr:=true", "separation.monitor"),
    ("distance_node", "question_rate:=50.0", "question_rate_hz"),
    ("distance_node", "camras:=[front]", "cameras"),
    ("self_filter_node", "self_filter.tolerence_m:=0.1", "self_filter.tolerance_m"),
    ("self_filter_node", "geometri:=visual", "geometry"),
])
def test_a_parameter_that_nobody_has_is_refused_with_the_nearest(node, given, nearest):
    code, said = run(node, "-p", given)
    assert code == 1, said
    assert given.split(":=")[0] + ": there is no such parameter; the nearest is " + nearest in said, said


def test_a_file_for_both_nodes_is_taken_by_both(tmp_path):
    file = tmp_path / "both.yaml"
    file.write_text("/**:\n  ros__parameters:\n    cameras: [front]\n    question_rate_hz: 50.0\n    planner.edge_m: 0.05\n"
                    "    front.max_wait_s: 0.2\n    front.self_filter.padding_m: 0.03\n    separation.monitor: false\n    max_wait_s: 0.2\n"
                    "    self_filter.padding_m: 0.02\n    front.reliability: reliable\n    record.seconds: 10.0\n")
    for node in ("distance_node", "self_filter_node"):
        code, said = run(node, "--params-file", str(file))
        assert code == 0, said


@pytest.mark.parametrize("given, said_parts", [
    ("camera.reliability:=best", ["reliability", "best", "expected best_effort or reliable"]),
    ("camera.camera_poses:=nowhere", ["camera_poses", "nowhere", "auto, tf, scene"]),
    ("scene:=nowhere.yaml", ["nowhere.yaml"]),
    ("urdf_path:=nowhere.urdf", ["nowhere.urdf"]),
    ("srdf_path:=nowhere.srdf", ["nowhere.srdf"]),
    ("record.file:=/nowhere/a.mcap", ["record.file", "/nowhere/a.mcap", "/nowhere is not"]),
    ("planner.edge_m:=0.001", ["planner.edge_m", "0.001", "expected at least 0.005"]),
    ("planner.box_min_m:=[0.0, 0.0]", ["planner.box_min_m", "2 numbers; expected 3"]),
    ("planner.box_min_m:=[2.0, 0.0, 0.0]", ["planner.box_min_m", "the box of the voxels is empty"]),
    ("planner.occupancy_heights_m:=[1.0, 0.5]", ["planner.occupancy_heights_m", "the lower one before"]),
])
def test_a_bad_value_is_refused_by_name(given, said_parts):
    code, said = run("distance_node", "-p", given)
    assert code == 1, said
    assert all(part in said for part in said_parts), said


FILTERED = ["-p", "filter.command_topic:=commands"]


def test_a_filter_has_parameters_of_its_own():
    assert run("distance_node", *FILTERED, "-p", "filter.max_acceleration:=2.0", "-p", "filter.joints:=[turn]")[0] == 0
    for given, said_parts in (("filter.least_distance_m:=-0.1", ["filter.least_distance_m", "-0.1"]),
                              ("filter.period_s:=0.005", ["filter.period_s: 0.005", "expected at least", "0.01", "question_rate_hz"]),
                              ("filter.perod_s:=0.1", ["filter.perod_s: there is no such parameter; the nearest is filter.period_s"])):
        code, said = run("distance_node", *FILTERED, "-p", given)
        assert code == 1 and all(part in said for part in said_parts), said
    code, said = run("distance_node", "-p", "filter.least_distance_m:=0.1")
    assert code == 1 and "filter.least_distance_m: there is no such parameter" in said, said


def test_missing_files_end_the_node_and_the_launch(tmp_path):
    missing = str(tmp_path / "missing.yaml")
    assert run("distance_node", "--params-file", missing)[0] != 0
    done = subprocess.run(["ros2", "launch", "berth_ros", "distance.launch.py", "parameters:=" + missing],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode != 0
    assert missing in done.stdout + done.stderr


def test_a_camera_that_nobody_watches_is_said():
    assert "nobody watches whether it is moved" in run("distance_node", "-p", "watch.max_displacement_m:=0.0")[1]
    assert "nobody watches" not in run("distance_node")[1]
