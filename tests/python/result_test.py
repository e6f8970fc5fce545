"""Requests: the same results as the command, arrays that look into them, joints in all forms."""
import copy
import gc
import itertools
import json
import os
import pickle
import re
import shutil
import subprocess

import numpy as np
import pytest

import berth
from conftest import BOXES, SOURCE, thinned


@pytest.mark.parametrize("scene", ["one_camera", "scene"])
def test_a_scene_gives_the_lines_of_berth_run(tmp_path, scene):
    file = thinned(tmp_path, f"{scene}.yaml", "scene.yaml", 3)
    run = subprocess.run([os.environ["BERTH"], "run", file, "--format", "json"], check=True, capture_output=True, text=True)
    lines = [step.result.to_json() for step in berth.open_scene(file)]
    assert lines == run.stdout.splitlines()


def test_arrays_have_a_row_for_each_link(step):
    result = step.result
    count = len(result)
    assert result.link_names == [link.link for link in result.links] and count == 8
    for name in ("distance_m", "lower_bound_m", "occupied_distance_m", "occupied_lower_bound_m", "known_distance_m",
                 "known_lower_bound_m"):
        assert getattr(result, name).shape == (count,) and getattr(result, name).dtype == np.float32
    for name in ("robot_point_base_m", "obstacle_point_base_m", "mean_direction_base", "occupied_obstacle_point_base_m"):
        assert getattr(result, name).shape == (count, 3) and not getattr(result, name).flags.owndata
    told = json.loads(result.to_json())["links"]
    for i, (link, line) in enumerate(zip(result.links, told)):
        assert line["link"] == link.link and line["status"] == link.status.name
        assert line["distance_m"] is None or result.distance_m[i] == pytest.approx(line["distance_m"], rel=1e-6)
        assert link.distance_m == pytest.approx(result.distance_m[i], nan_ok=True)
        np.testing.assert_array_equal(link.robot_point_base_m, result.robot_point_base_m[i])
        np.testing.assert_array_equal(link.occupied.obstacle_point_base_m, result.occupied_obstacle_point_base_m[i])
    ok = np.isfinite(result.distance_m)
    lengths = np.linalg.norm(result.obstacle_point_base_m - result.robot_point_base_m, axis=1)
    np.testing.assert_allclose(lengths[ok], result.distance_m[ok], atol=1e-5)


def test_what_is_known_needs_no_camera(step, one_camera):
    result = step.result
    for i, link in enumerate(result.links):
        assert link.known.link == (None if np.isnan(result.known_distance_m[i]) else link.known.link)
        assert link.is_moved or np.isnan(result.known_lower_bound_m[i])
    assert result["arm_link_1"].known.link == "table"
    assert result["arm_link_1"].known.distance_m == pytest.approx(0.11, abs=1e-3)
    nearest = result.nearest_to_all
    assert min(nearest.distance_m, nearest.known.distance_m) == np.nanmin([result.distance_m[1:], result.known_distance_m[1:]])
    assert ("arm_link_5", "arm_link_7", "always_touch") in one_camera.robot.left_out


def test_contacts_may_be_allowed(tmp_path):
    text = BOXES.replace("</robot>", "") + """<link name="hand"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
        <joint name="h" type="revolute"><parent link="arm"/><child link="hand"/><origin xyz="0 0.3 0"/>
        <limit lower="-3" upper="3"/></joint></robot>"""
    left_out = lambda **more: berth.Robot(berth.load_robot("boxes.urdf", urdf_text=text, **more)).left_out
    assert ("hand", "base_link") not in [pair[:2] for pair in left_out()]
    assert ("hand", "base_link", "allowed") in left_out(allowed_contacts=[("base_link", "hand")])
    srdf = tmp_path / "boxes.srdf"
    srdf.write_text('<robot name="boxes"><disable_collisions link1="base_link" link2="hand"/></robot>')
    assert ("hand", "base_link", "srdf") in left_out(srdf=srdf)


def is_told(value, line):
    """Whether Python has what the line of JSON has."""
    if isinstance(value, dict):
        return value == line if line else not any(value.values())
    if isinstance(line, dict):
        return all(is_told(getattr(value, key), line[key]) for key in line)
    if isinstance(line, list):
        return len(value) == len(line) and all(map(is_told, value, line))
    if line is None:
        return value is None or np.isnan(getattr(value, "seen", value)).all() or np.equal(value, -1).all()
    return value == pytest.approx(line, rel=1e-6) if isinstance(line, float) else getattr(value, "name", value) == line


@pytest.mark.parametrize("scene", ["one_camera", "scene"])
def test_every_field_of_the_json_is_here(scene):
    """By the same name. One list makes both."""
    result = next(iter(berth.open_scene(SOURCE / f"data/bundled/{scene}.yaml"))).result
    told = json.loads(result.to_json())
    assert told.pop("schema") == "berth/result/3"
    assert told.pop("nearest") == (result.nearest and result.nearest.link)
    for key, line in told.items():
        assert is_told(getattr(result, key), line), key


def test_links_by_name_and_number(step):
    result = step.result
    assert result["arm_link_3"].link == result[3].link == result[-5].link == "arm_link_3"
    with pytest.raises(KeyError, match="arm_link_9.*expected one of arm_link_0"):
        result["arm_link_9"]
    with pytest.raises(IndexError):
        result[8]
    moved = np.array(result.link_is_moved)
    assert result.nearest.distance_m == np.nanmin(result.distance_m[moved])


def test_arrays_outlive_their_result(query, step):
    distance_m = query.ask(step.frame).distance_m
    expected = distance_m.copy()
    assert not distance_m.flags.writeable
    gc.collect()
    for _ in range(5):
        query.ask(step.frame, np.zeros(7))
    np.testing.assert_array_equal(distance_m, expected)


def test_a_result_stays_as_it_is(query, step):
    first = query.ask(step.frame)
    before = first.to_json()
    query.ask(step.frame, np.zeros(7))
    assert first.to_json() == before


def test_joints_in_all_forms(one_camera, query, step):
    names = one_camera.robot.model.joint_names
    expected = query.ask(step.frame, step.joints).distance_m
    for joints in (list(step.joints), dict(zip(names, step.joints)), {**dict(zip(names, step.joints)), "other": 1.0}):
        np.testing.assert_allclose(query.ask(step.frame, joints).distance_m, expected, atol=2e-3)


@pytest.mark.parametrize("joints, said", [
    ([0.0] * 6, "7"), ([0.0] * 6 + [np.nan], "nan|finite"), ({"arm_joint_1": 0.0}, "arm_joint_2 is missing"),
    (np.zeros((2, 7)), "a row of numbers"), ("joints", "a row of numbers"),
])
def test_wrong_joints_are_named(query, observer, step, joints, said):
    with pytest.raises(ValueError, match=said):
        query.ask(step.frame, joints)
    with pytest.raises(ValueError, match=said):
        observer.observe(step.depth_m, joints)


def test_several_cameras_are_asked_together(bundled):
    steps = list(itertools.islice(bundled, 9))
    newest = {step.frame.camera: step.frame for step in steps}
    query = berth.Query(bundled.robot, camera_names=[*newest, "late"])
    together = query.ask(list(newest.values()), steps[-1].joints)
    assert [camera.camera for camera in together.cameras] == list(newest)
    assert {camera.status for camera in together.cameras} == {berth.CameraStatus.ok}
    np.testing.assert_allclose(together.distance_m, steps[-1].result.distance_m, atol=2e-3)
    missing = query.ask([*newest.values(), None], steps[-1].joints)
    assert missing.cameras[-1].status == berth.CameraStatus.no_frame and missing.status == berth.ResultStatus.degraded
    assert missing.cameras[-1].camera == "late"
    with pytest.raises(ValueError, match="frames: 0 cameras; expected 1 to 8"):
        query.ask([])


def test_what_is_old_has_no_distance(query, step):
    late = query.ask(step.frame, now_s=step.frame.stamp_s + 1)
    assert late.time.status == berth.TimeStatus.stale_frame and late.status == berth.ResultStatus.stale
    assert np.isnan(late.distance_m).all() and late.nearest is None
    assert late.time.frame_age_s == pytest.approx(1)


def test_a_joint_buffer_finds_the_joints(one_camera, observer, query, step):
    joints = berth.JointBuffer(one_camera.robot.model)
    names = one_camera.robot.model.joint_names
    frame = observer.observe(step.depth_m, joints, stamp_s=5.0)
    assert frame.time_status == berth.TimeStatus.no_joints
    assert joints.push(4.995, dict(zip(names, step.joints))) == berth.TimeStatus.ok
    assert joints.push(5.005, step.joints) == berth.TimeStatus.ok
    assert joints.push(5.0, step.joints) == berth.TimeStatus.stamp_went_back
    frame = observer.observe(step.depth_m, joints, stamp_s=5.0 + 1e-3)
    assert frame.time_status == berth.TimeStatus.ok
    result = query.ask(frame, joints, now_s=5.01)
    np.testing.assert_allclose(result.distance_m, query.ask(step.frame).distance_m, atol=2e-3)
    with pytest.raises(ValueError, match="now_s: none"):
        query.ask(frame, joints)


def test_looking_ahead_is_asking_each_pose(query, step):
    way = np.linspace(step.joints, step.joints + 0.3, 7)
    ahead = query.ask(step.frame, ahead=way, nearer_than_m=0.1).ahead
    assert ahead.distance_m.shape == ahead.lower_bound_m.shape == (7, 8)
    for i, joints in enumerate(way):
        np.testing.assert_allclose(ahead.distance_m[i], query.ask(step.frame, joints).distance_m, atol=2e-3)
    near = (ahead.lower_bound_m < 0.1).any(axis=1)
    assert ahead.first_nearer == (int(np.argmax(near)) if near.any() else None)
    assert query.ask(step.frame, ahead=way, now_s=step.frame.stamp_s + 1).ahead.distance_m.shape == (0, 8)


def test_results_and_frames_are_not_pickled(step):
    for thing in (step.result, step.frame):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(thing)
        with pytest.raises(TypeError):
            copy.deepcopy(thing)


def test_everything_says_what_it_is(one_camera, step):
    assert repr(step.result).startswith("Result(8 links, ok, nearest arm_link_")
    assert repr(step.result[2]).startswith("LinkResult(arm_link_2, ok")
    assert "640" in repr(one_camera.views[0].camera)


def test_images_of_one_stamp_have_one_result(tmp_path):
    shutil.copytree(SOURCE / "data/bundled", tmp_path / "scene")
    text = (SOURCE / "data/bundled/scene.yaml").read_text()
    text = re.sub(r"    stamps: .*\n", "", text)
    text = re.sub(r"(depth\w*)/\*\.png", r"[\1/000000.png, \1/000001.png]", text)
    rows = (SOURCE / "data/bundled/joints.csv").read_text().splitlines()[:3]
    (tmp_path / "scene/joints.csv").write_text("\n".join(rows))
    (tmp_path / "scene/scene.yaml").write_text(text + "watch: {min_at_robot: 0}\n")
    steps = list(berth.open_scene(tmp_path / "scene/scene.yaml"))
    assert [step.begins_result for step in steps] == [True, False, False] * 2
    assert [step.number for step in steps] == [0, 0, 0, 1, 1, 1]
