"""The monitor: what it says in a scene, as the command says it, and alone."""
import json
import os
import subprocess

import numpy as np
import pytest

import berth
from conftest import thinned


# So that the robot stops for what it would run into, and for nothing else.
BOLD = {"not_seen": "ignore", "no_reading": "ignore", "unknown": "ignore", "human_speed_m_s": 0.0, "intrusion_m": 0.0, "camera_uncertainty_m": 0.0,
        "robot_uncertainty_m": 0.0}


@pytest.fixture(scope="module")
def monitored(tmp_path_factory):
    """The bundled scene with a monitor, some images of its first camera."""
    return thinned(tmp_path_factory.mktemp("monitored"), "one_camera.yaml", "scene.yaml", 3,
                   separation={"not_seen": "ignore", "no_reading": "ignore"})


@pytest.fixture
def asked(one_camera):
    """How a request about the first image is asked."""
    scene = one_camera
    step = next(iter(scene))
    frame = berth.Observer(scene.views[0]).observe(step.depth_m, step.joints, stamp_s=0.0)
    query = berth.Query(scene.robot)

    def ask(**more):
        monitor = berth.SeparationMonitor(scene.robot, berth.SeparationSettings(**BOLD))
        return query.ask(frame, step.joints, **{"now_s": 0.0, "monitor": monitor, **more})

    ask.joints = np.array(step.joints)
    return ask


def test_a_scene_says_what_the_command_says(monitored):
    run = subprocess.run([os.environ["BERTH"], "run", monitored, "--format", "json"], check=True, capture_output=True, text=True)
    results = [step.result for step in berth.open_scene(monitored)]
    told = [json.loads(line) for line in run.stdout.splitlines()]
    assert len(results) == len(told) == 12
    for result, line in zip(results, told):
        said = result.separation
        for key in ("state", "basis", "reason"):
            assert getattr(said, key).name == line["separation"][key]
        assert said.speed_scale == pytest.approx(line["separation"]["speed_scale"], abs=1e-6)
        assert (said.link, said.camera, said.text) == tuple(line["separation"][key] for key in ("link", "camera", "text"))
        for link, of_line in zip(result.links, line["links"]):
            assert (link.separation is None) == ("separation" not in of_line)


def test_a_robot_that_stands_may_go_and_a_faster_one_may_less(asked):
    said = [asked(velocity=np.full(7, speed)).separation for speed in (0.0, 0.7, 2.0)]
    assert said[0].speed_scale == 1 and said[0].state == berth.SeparationState.clear
    assert 1 > said[1].speed_scale > said[2].speed_scale > 0
    assert said[2].state == berth.SeparationState.reduced and said[2].link is not None and "it needs" in said[2].text


def test_without_a_velocity_the_robot_stops(asked):
    said = asked().separation
    assert said.speed_scale == 0 and said.state == berth.SeparationState.stop and said.reason == berth.SeparationReason.velocity


def test_a_path_is_taken(asked):
    velocity = np.full(7, 0.7)
    straight_on = asked.joints + np.outer([0, 1], velocity)
    said = asked(velocity=velocity, path=straight_on, path_s=[0.0, 1.0]).separation
    assert said.basis == berth.SeparationBasis.path
    assert said.speed_scale > asked(velocity=velocity).separation.speed_scale
    with pytest.raises(ValueError, match="path_s: 1 times; expected one for each of 2 rows of path"):
        asked(velocity=velocity, path=straight_on, path_s=[0.0])


def test_it_wants_a_time_and_results_without_it_have_none(asked):
    with pytest.raises(ValueError, match="monitor: expected now_s with it"):
        asked(now_s=None)
    result = asked(monitor=None)
    assert result.separation is None and all(link.separation is None for link in result.links)


def test_settings_are_checked_and_have_a_table_of_stops(one_camera):
    settings = berth.SeparationSettings(detection_m=0.03)
    settings.stopping = [[0.25, 0.1, 0.01], [1.0, 0.3, 0.15]]
    assert berth.SeparationMonitor(one_camera.robot, settings).settings.stopping == settings.stopping
    settings.stopping = [[1.0, 0.3, 0.15], [0.25, 0.1, 0.01]]
    with pytest.raises(ValueError, match="stopping"):
        berth.SeparationMonitor(one_camera.robot, settings)


def test_two_cameras_of_one_name_are_refused(one_camera):
    scene = one_camera
    step = next(iter(scene))
    view = scene.views[0]
    frames = [berth.Observer(berth.MountedCamera(scene.robot, view.camera, view.parent_link, view.X_PC, name=name)).observe(
        step.depth_m, step.joints) for name in ("camera", "camera", "other")]
    with pytest.raises(ValueError, match='frames: two of a camera named "camera"'):
        berth.Query(scene.robot).ask(frames[:2])
    assert len(berth.Query(scene.robot).ask(frames[1:]).cameras) == 2
