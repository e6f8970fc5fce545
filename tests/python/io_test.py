"""Scene folders, bags without their packages, plots, and a calibration."""
import itertools
import json
import os
import subprocess
import sys

import numpy as np
import pytest
import yaml

import berth
import berth.io
from conftest import BOXES, SOURCE, thinned

URDF = SOURCE / "data/bundled/arm/arm.urdf"


def record_of(scene, steps, stamps_s=(0.0, 0.1)):
    view = scene.views[0]
    return berth.io.CameraRecord("front", view.camera, view.parent_link, view.X_PC, [s.depth_m for s in steps], stamps_s)


def test_a_scene_that_was_written_gives_the_same_results(tmp_path, one_camera):
    steps = list(itertools.islice(one_camera, 2))
    names = one_camera.robot.model.joint_names
    joints = {name: [s.joints[i] for s in steps] for i, name in enumerate(names)}
    file = berth.io.write_scene(str(tmp_path / "scene"), str(URDF), [record_of(one_camera, steps)], [0.0, 0.1], joints,
                                environment_links=["table"], package_paths={"berth_arm": str(SOURCE / "data/bundled/arm")})
    for was, now in zip(steps, berth.open_scene(file)):
        np.testing.assert_allclose(now.depth_m, was.depth_m, atol=1e-6)
        np.testing.assert_allclose(now.frame.X_BC, was.frame.X_BC, atol=1e-9)
        np.testing.assert_allclose(now.result.distance_m, was.result.distance_m, atol=2e-3)
    with pytest.raises(ValueError, match="is there already"):
        berth.io.write_scene(str(tmp_path / "scene"), str(URDF), [], [0.0], {})


def test_images_without_stamps_leave_nothing_behind(tmp_path, one_camera, step):
    with pytest.raises(ValueError, match="camera front: 2 stamps; expected one for each of 1 images"):
        berth.io.write_scene(str(tmp_path / "scene"), str(URDF), [record_of(one_camera, [step])], [0.0], {"a": [0.0]})
    assert list(tmp_path.iterdir()) == []


def test_depth_images_on_disk(tmp_path, one_camera, step):
    file, camera = str(tmp_path / "d.png"), one_camera.views[0].camera
    berth.io.write_depth(file, step.depth_m)
    np.testing.assert_allclose(berth.io.read_depth(file, camera), step.depth_m, atol=1e-6)
    numbers = np.rint(np.nan_to_num(step.depth_m) * 1000).astype(np.uint16)
    berth.io.write_depth(file, numbers, depth_scale=0.002)
    np.testing.assert_allclose(np.nan_to_num(berth.io.read_depth(file, camera, depth_scale=0.002)), numbers * 0.002, rtol=1e-6)


@pytest.mark.parametrize("bag, package", [("bag", "rosbags"), ("bag.mcap", "mcap")])
def test_a_package_that_is_missing_is_named(tmp_path, monkeypatch, bag, package):
    for name in ("rosbags", "rosbags.highlevel", "mcap", "mcap.reader"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=package):
        berth.io.import_bag(str(tmp_path / bag), str(tmp_path / "out"))


def test_a_calibration_data_finds_the_pose_and_writes_the_scene(tmp_path):
    off = thinned(tmp_path, "one_camera.yaml", "off.yaml", 6)
    scene = yaml.safe_load(off.read_text())
    true_xyz = np.array(scene["cameras"][0]["pose"]["xyz"])
    scene["cameras"][0]["pose"]["xyz"] = (true_xyz + [0.02, -0.01, 0.01]).tolist()
    off.write_text(yaml.safe_dump(scene))
    found = berth.calibrate(off)
    result = found.cameras[0]
    assert result.refused == "" and result.moved_m > 0.01 and result.after_m[1] < result.before_m[1]
    np.testing.assert_allclose(result.X_PC[:3, 3], true_xyz, atol=0.006)
    found.write(tmp_path / "new.yaml")
    np.testing.assert_allclose(berth.open_scene(tmp_path / "new.yaml").views[0].X_PC, result.X_PC, atol=1e-8)
    assert json.loads(found.to_json())["schema"] == "berth/calibration/1" and "camera" in found.table()
    with pytest.raises(ValueError, match="never overwritten"):
        found.write(off)


def test_pictures(one_camera, step):
    plot = pytest.importorskip("berth.plot")
    pytest.importorskip("matplotlib")
    results = [s.result for s in itertools.islice(one_camera, 5)]
    axes = plot.distances(results)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == results[0].link_names[1:]
    np.testing.assert_allclose(axes.lines[0].get_ydata(), [a.distance_m[1] for a in results])
    drawn = plot.frame(step.frame, step.result, one_camera.views[0].camera)
    assert drawn.lines and drawn.images[0].get_array().shape == (480, 640, 3)
    for picture in (step.frame._repr_png_(), step.result._repr_png_(), plot.png(axes)):
        assert picture.startswith(b"\x89PNG") and len(picture) > 5000
    with pytest.raises(ValueError, match="results: none"):
        plot.distances([])


def test_the_program_tells_its_version():
    run = subprocess.run([sys.executable, "-m", "berth", "--version"], check=True, capture_output=True, text=True)
    assert run.stdout == f"berth {berth.__version__}\n"
    assert subprocess.run([sys.executable, "-m", "berth", "--wrong"], capture_output=True).returncode == 2


@pytest.mark.parametrize("example, scene, more, said", [
    ("one_frame", "boxes.urdf", [], "arm ok "),
    ("avoid", "scene.yaml", [], "own QP"),
    ("mppi", "scene.yaml", [], "0.0"),
    ("look_ahead", "scene.yaml", [], "first at pose"),
    ("calibrate", "one_camera.yaml", ["new.yaml"], "least distance"),
])
def test_the_examples_run(tmp_path, example, scene, more, said):
    if scene.endswith(".yaml"):
        thinned(tmp_path, scene, scene, 6)
    (tmp_path / "boxes.urdf").write_text(BOXES)
    run = subprocess.run([sys.executable, SOURCE / f"examples/python/{example}.py", scene, *more],
                         capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert said in run.stdout


def test_python_is_stopped_by_ctrl_c(tmp_path):
    """While C++ reads images."""
    code = ("import berth, signal, sys\n"
            "signal.signal(signal.SIGALRM, signal.default_int_handler)\nsignal.setitimer(signal.ITIMER_REAL, 0.05)\n"
            f"\nwhile True: berth.open_scene({str(SOURCE / 'data/bundled/scene.yaml')!r})")
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60,
                         env={**os.environ, "PYTHONPATH": os.environ.get("PYTHONPATH", "")})
    assert "KeyboardInterrupt" in run.stderr
