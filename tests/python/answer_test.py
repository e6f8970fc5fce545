"""Questions: the same answers as the command, arrays that look into them, joints in all forms."""
import copy
import gc
import json
import os
import pickle
import subprocess

import numpy as np
import pytest

import berth
from conftest import SOURCE


@pytest.mark.parametrize("scene", ["one_camera", "scene"])
def test_a_scene_gives_the_lines_of_berth_run(scene):
    file = SOURCE / f"data/bundled/{scene}.yaml"
    run = subprocess.run([os.environ["BERTH"], "run", file, "--format", "json"], check=True, capture_output=True, text=True)
    lines = [step.answer.to_json() for step in berth.open_scene(file)]
    assert lines == run.stdout.splitlines()


def test_arrays_have_a_row_for_each_link(step):
    answer = step.answer
    count = len(answer)
    assert answer.link_names == [link.name for link in answer.links] and count == 8
    for name in ("distance_m", "lower_bound_m", "reading_distance_m"):
        assert getattr(answer, name).shape == (count,) and getattr(answer, name).dtype == np.float32
    for name in ("robot_point_B_m", "obstacle_point_B_m", "mean_direction_B"):
        assert getattr(answer, name).shape == (count, 3)
    told = json.loads(answer.to_json())["links"]
    for i, (link, line) in enumerate(zip(answer.links, told)):
        assert line["link"] == link.name and line["status"] == link.status.name == answer.status[i].name
        assert line["distance_m"] is None or answer.distance_m[i] == pytest.approx(line["distance_m"], rel=1e-6)
        assert link.distance_m == pytest.approx(answer.distance_m[i], nan_ok=True)
        np.testing.assert_array_equal(link.robot_point_B_m, answer.robot_point_B_m[i])
    ok = np.isfinite(answer.distance_m)
    lengths = np.linalg.norm(answer.obstacle_point_B_m - answer.robot_point_B_m, axis=1)
    np.testing.assert_allclose(lengths[ok], answer.distance_m[ok], atol=1e-5)


def test_links_by_name_and_number(step):
    answer = step.answer
    assert answer["arm_link_3"].name == answer[3].name == answer[-5].name == "arm_link_3"
    with pytest.raises(KeyError, match="arm_link_9.*expected one of arm_link_0"):
        answer["arm_link_9"]
    with pytest.raises(IndexError):
        answer[8]
    moved = np.array(answer.link_is_moved)
    assert answer.nearest.distance_m == np.nanmin(answer.distance_m[moved])


def test_arrays_outlive_their_answer(asker, step):
    distance_m = asker.ask(step.frame).distance_m
    expected = distance_m.copy()
    assert not distance_m.flags.writeable
    gc.collect()
    for _ in range(5):
        asker.ask(step.frame, np.zeros(7))
    np.testing.assert_array_equal(distance_m, expected)


def test_an_answer_stays_as_it_is(asker, step):
    first = asker.ask(step.frame)
    before = first.to_json()
    asker.ask(step.frame, np.zeros(7))
    assert first.to_json() == before


def test_joints_in_all_forms(one_camera, asker, step):
    names = one_camera.robot.model.joint_names
    expected = asker.ask(step.frame, step.joints).distance_m
    for joints in (list(step.joints), dict(zip(names, step.joints)), {**dict(zip(names, step.joints)), "other": 1.0}):
        np.testing.assert_allclose(asker.ask(step.frame, joints).distance_m, expected, atol=2e-3)


@pytest.mark.parametrize("joints, said", [
    ([0.0] * 6, "7"), ([0.0] * 6 + [np.nan], "nan|finite"), ({"arm_joint_1": 0.0}, "arm_joint_2 is missing"),
    (np.zeros((2, 7)), "a row of numbers"), ("joints", "a row of numbers"),
])
def test_wrong_joints_are_named(asker, observer, step, joints, said):
    with pytest.raises(ValueError, match=said):
        asker.ask(step.frame, joints)
    with pytest.raises(ValueError, match=said):
        observer.observe(step.depth_m, joints)


def test_several_cameras_answer_together(bundled):
    steps = list(bundled)[:9]
    newest = {step.frame.camera: step.frame for step in steps}
    asker = berth.Asker(bundled.robot)
    together = asker.ask(list(newest.values()), steps[-1].joints)
    assert [camera.name for camera in together.cameras] == list(newest)
    assert {camera.status for camera in together.cameras} == {berth.CameraStatus.ok}
    np.testing.assert_allclose(together.distance_m, steps[-1].answer.distance_m, atol=2e-3)
    missing = asker.ask([*newest.values(), None], steps[-1].joints)
    assert missing.cameras[-1].status == berth.CameraStatus.no_frame
    with pytest.raises(ValueError, match="frames: none"):
        asker.ask([])


def test_what_is_old_has_no_distance(asker, step):
    late = asker.ask(step.frame, now_s=step.frame.stamp_s + 1)
    assert late.time_status == berth.TimeStatus.stale_frame
    assert np.isnan(late.distance_m).all() and late.nearest is None
    assert late.frame_age_s == pytest.approx(1)


def test_a_joint_buffer_finds_the_joints(one_camera, observer, asker, step):
    joints = berth.JointBuffer(one_camera.robot.model)
    names = one_camera.robot.model.joint_names
    frame = observer.observe(step.depth_m, joints, stamp_s=5.0)
    assert frame.time_status == berth.TimeStatus.no_joints
    assert joints.push(4.995, dict(zip(names, step.joints))) == berth.TimeStatus.ok
    assert joints.push(5.005, step.joints) == berth.TimeStatus.ok
    assert joints.push(5.0, step.joints) == berth.TimeStatus.stamp_went_back
    frame = observer.observe(step.depth_m, joints, stamp_s=5.0 + 1e-3)
    assert frame.time_status == berth.TimeStatus.ok
    answer = asker.ask(frame, joints, now_s=5.01)
    np.testing.assert_allclose(answer.distance_m, step.answer.distance_m, atol=2e-3)
    with pytest.raises(ValueError, match="now_s: none"):
        asker.ask(frame, joints)


def test_looking_ahead_is_asking_each_pose(one_camera, one_mesh_camera):
    step, asker = next(iter(one_mesh_camera)), berth.Asker(one_mesh_camera.robot)
    way = np.linspace(step.joints, step.joints + 0.3, 7)
    ahead = berth.TrajectoryAsker(one_mesh_camera.robot).ask(step.frame, way, nearer_than_m=0.1)
    assert ahead["distance_m"].shape == ahead["lower_bound_m"].shape == (7, 8)
    for i, joints in enumerate(way):
        np.testing.assert_allclose(ahead["distance_m"][i], asker.ask(step.frame, joints).distance_m, atol=2e-3)
    near = (ahead["lower_bound_m"] < 0.1).any(axis=1)
    with pytest.raises(ValueError, match="expected mesh"):
        berth.TrajectoryAsker(one_camera.robot)
    assert ahead["first_nearer"] == (int(np.argmax(near)) if near.any() else None)


def test_answers_and_frames_are_not_pickled(step):
    for thing in (step.answer, step.frame):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(thing)
        with pytest.raises(TypeError):
            copy.deepcopy(thing)


def test_everything_says_what_it_is(one_camera, step):
    assert repr(step.answer).startswith("Answer(8 links, ok, nearest arm_link_")
    assert repr(step.answer[2]).startswith("LinkDistance(arm_link_2, ok")
    assert "640" in repr(one_camera.views[0].camera)
