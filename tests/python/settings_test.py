"""Settings and poses: each from the one list, wrong ones by name."""
import copy
import re

import numpy as np
import pytest

import berth
from conftest import SOURCE

GROUPS = {
    "self_filter": berth.SelfFilterSettings, "sensor": berth.SensorSettings, "space": berth.SpaceSettings,
    "watch": berth.WatchSettings, "evaluation": berth.EvaluationSettings, "time": berth.TimeSettings,
    "separation": berth.SeparationSettings,
}


@pytest.mark.parametrize("group", GROUPS)
def test_all_settings_of_the_scene_file_are_here(group):
    text = (SOURCE / "docs/scene.md").read_text()
    tables = {name: set(re.findall(r"^\| `(\w+)` \| [^|]* \| [^|]* \| [a-z0-9]", part, re.M))
              for name, part in re.findall(r"^#+ .*?`?(self_filter|sensor|space|watch|evaluation|time|separation)`?\n(.*?)(?=^#|\Z)", text, re.M | re.S)}
    settings = GROUPS[group]().as_dict()
    assert tables, "docs/scene.md has tables of settings"
    if group in tables and tables[group]:
        assert tables[group] - {"link_padding_m", "stopping"} <= set(settings)
    for name, value in settings.items():
        prop = getattr(GROUPS[group], name)
        assert len(prop.__doc__) > 10, name
        assert getattr(GROUPS[group](**{name: value}), name) == value


def test_they_can_be_given_set_and_shown():
    settings = berth.SelfFilterSettings(tolerance_m=0.03, tolerance_per_m2=0.02)
    settings.padding_m = 0.01
    assert (settings.tolerance_m, settings.tolerance_per_m2, settings.padding_m) == (0.03, 0.02, 0.01)
    assert "tolerance_m=0.03" in repr(settings)
    assert berth.SpaceSettings(no_reading="free").no_reading == "free"
    assert berth.EvaluationSettings(deadline_us=None).deadline_us is None


@pytest.mark.parametrize("given, error, said", [
    (dict(tolerance_m=-1), ValueError, "self_filter.tolerance_m: -1; expected a finite number of at least 0"),
    (dict(tolerance_m=np.nan), ValueError, "self_filter.tolerance_m: nan"),
    (dict(tolerance_m="wide"), TypeError, "self_filter.tolerance_m: 'wide'; expected float"),
    (dict(padding_m=None), TypeError, "self_filter.padding_m: None; expected float"),
    (dict(toleranc_m=1), TypeError, '"toleranc_m" is no setting; expected one of tolerance_m, '),
])
def test_wrong_ones_are_named(given, error, said):
    with pytest.raises(error, match=re.escape(said)):
        berth.SelfFilterSettings(**given)


def test_a_whole_number_is_asked_for():
    with pytest.raises(TypeError, match=re.escape("sensor.speckle_px: 1.5; expected int")):
        berth.SensorSettings(speckle_px=1.5)


@pytest.mark.parametrize("group", GROUPS)
def test_copies_have_their_own_values(group):
    settings = GROUPS[group]()
    for other in (copy.copy(settings), copy.deepcopy({"of": settings})["of"]):
        assert other is not settings and other.as_dict() == settings.as_dict()
    original = berth.SelfFilterSettings()
    copied = copy.deepcopy(original)
    copied.padding_m = 0.07
    assert original.padding_m == berth.SelfFilterSettings().padding_m


def test_a_wrong_value_changes_nothing():
    settings = berth.SelfFilterSettings()
    with pytest.raises(ValueError):
        settings.tolerance_m = -1
    assert settings.tolerance_m == berth.SelfFilterSettings().tolerance_m


def test_a_wrong_name_is_named():
    with pytest.raises(ValueError, match='space.no_reading: "fast"; expected one of '):
        berth.SpaceSettings(no_reading="fast")


@pytest.mark.parametrize("pose, said", [
    (np.eye(3), "X_PC: no matrix of 4 x 4 numbers"), (2 * np.eye(4), "X_PC: the last row"),
    (np.diag([2.0, 2, 2, 1]), "X_PC"), (np.diag([1.0, 1, -1, 1]), "X_PC"), (np.full((4, 4), np.nan), "X_PC"), ("pose", "X_PC"),
])
def test_what_is_no_pose_is_named(one_camera, pose, said):
    with pytest.raises(ValueError, match=said):
        berth.MountedCamera(one_camera.robot, one_camera.views[0].camera, "table", pose)


def test_a_link_that_there_is_not_is_named(one_camera):
    with pytest.raises(ValueError, match="desk"):
        berth.MountedCamera(one_camera.robot, one_camera.views[0].camera, "desk", np.eye(4))


def test_files_that_are_missing_or_bad_are_named(tmp_path):
    for read in (berth.load_robot, berth.open_scene, berth.read_camera_info, berth.calibrate):
        with pytest.raises(FileNotFoundError, match="nowhere"):
            read(tmp_path / "nowhere")
    bad = tmp_path / "bad.yaml"
    bad.write_text("robot: 5\n")
    with pytest.raises(ValueError, match="bad.yaml:1"):
        berth.open_scene(bad)
    with pytest.raises(ValueError, match='geometry: "meshes"; expected one of visual, collision'):
        berth.load_robot(bad, geometry="meshes")


def test_a_view_is_what_it_was_made_of(one_camera):
    view = one_camera.views[0]
    again = berth.MountedCamera(one_camera.robot, view.camera, view.parent_link, view.X_PC, self_filter=view.self_filter, name="again")
    np.testing.assert_array_equal(again.X_PC, view.X_PC)
    assert again.name == "again" and again.self_filter.as_dict() == view.self_filter.as_dict()
