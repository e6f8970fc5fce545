"""The black box: what a loop recorded is replayed to the last bit."""
import numpy as np
import pytest

import berth


@pytest.fixture
def recorded(one_camera, tmp_path):
    """A few requests with a monitor that stops at the end, since nobody tells it the velocity."""
    scene = one_camera
    settings = berth.SeparationSettings(no_reading="ignore", not_seen="ignore", camera="ignore", unknown="ignore", human_speed_m_s=0.0, intrusion_m=0.0,
                                        camera_uncertainty_m=0.0, robot_uncertainty_m=0.0, acceleration_m_s2=0.0)
    recorder = berth.Recorder(tmp_path / "stop.mcap", scene.robot, scene.views, settings, seconds=5, after_stop_s=0.0)
    observer, query = berth.Observer(scene.views[0]), berth.Query(scene.robot)
    monitor = berth.SeparationMonitor(scene.robot, settings)
    results = []
    for i, step in zip(range(4), scene):
        now_s = 0.1 * i
        frame = observer.observe(step.depth_m, step.joints, stamp_s=now_s)
        recorder.put(frame, step.depth_m)
        results.append(query.ask(frame, step.joints, now_s=now_s, joints_stamp_s=now_s, monitor=monitor, recorder=recorder,
                                 velocity=None if i == 3 else np.zeros(len(step.joints))))
    recorder.finish()
    return recorder, results, tmp_path


def test_a_stop_is_written_and_replayed(recorded):
    recorder, results, folder = recorded
    assert results[-1].separation.state.name == "stop" and results[0].separation.state.name == "clear"
    assert recorder.files == [folder / "stop.mcap"] and recorder.lost == (0, 0)
    steps = list(berth.replay(folder / "stop.mcap"))
    assert [step.number for step in steps] == [0, 1, 2, 3]
    for step, result in zip(steps, results):
        assert step.difference is None and step.text == ""
        assert step.result.to_json() == result.to_json()
    assert steps[3].time_s == pytest.approx(0.3)


def test_a_file_that_is_missing_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="none.mcap"):
        berth.replay(tmp_path / "none.mcap")


def test_a_file_that_is_cut_off_gives_what_it_has_and_then_says_so(recorded):
    _, results, folder = recorded
    (folder / "cut.mcap").write_bytes((folder / "stop.mcap").read_bytes()[:-100])
    steps = []
    with pytest.raises(ValueError, match="cut off: byte"):
        for step in berth.replay(folder / "cut.mcap"):
            steps.append(step)
    assert len(steps) == len(results) and all(step.difference is None for step in steps)


def test_frames_of_other_cameras_and_bad_settings_are_refused(one_camera, bundled, tmp_path):
    with pytest.raises(ValueError, match="seconds: 0"):
        berth.Recorder(tmp_path / "a.mcap", one_camera.robot, one_camera.views, seconds=0)
    recorder = berth.Recorder(tmp_path / "a.mcap", bundled.robot, bundled.views)
    step = next(iter(one_camera))
    with pytest.raises(ValueError, match="none of the recorder's"):
        recorder.put(step.frame, step.depth_m)
    recorder.write()
