"""Rows and the filter: shapes, what is missing, and that the filter holds what it says."""
import numpy as np
import pytest

import berth
from conftest import SOURCE


@pytest.fixture
def asked(one_camera):
    """A result about the first image, and the joints that it is about."""
    step = next(iter(one_camera))
    frame = berth.Observer(one_camera.views[0]).observe(step.depth_m, step.joints, stamp_s=0.0)
    return one_camera.robot, berth.Query(one_camera.robot).ask(frame, step.joints), step.joints


def test_rows_are_links_by_joints(asked):
    robot, result, _ = asked
    rows = berth.DistanceRows(robot)
    rows.update(result)
    for kind, distance_m in ((berth.RowKind.nearest, result.distance_m), (berth.RowKind.occupied, result.occupied_distance_m),
                             (berth.RowKind.known, result.known_distance_m)):
        gradient = rows.gradient(kind)
        assert gradient.shape == (len(result.link_names), len(robot.model.joint_names))
        assert (np.isnan(gradient).any(axis=1) == np.isnan(distance_m)).all()
        assert rows.reach_m(kind).shape == gradient.shape
        length = np.linalg.norm(rows.normal(kind), axis=1)
        assert np.allclose(length[~np.isnan(distance_m)], 1) and np.isnan(length[np.isnan(distance_m)]).all()
        # No joint changes a distance by more than it moves the links.
        assert (np.nan_to_num(np.abs(gradient)) <= rows.reach_m(kind) + 1e-6).all()
    assert (rows.reach_m(berth.RowKind.nearest)[-1] > 0).all()


def test_the_filter_keeps_what_its_rows_ask(asked):
    robot, result, position = asked
    settings = berth.VelocityFilterSettings(least_distance_m=0.02, latency_s=0.0, period_s=0.004, stop_unseen=False)
    wanted = np.array([1.0, -1, 1, -1, 1, -1, 1])
    out = berth.VelocityFilter(robot, settings).update(result, position, np.zeros(7), wanted)
    assert out.status == berth.FilterStatus.ok and 0 <= out.scale <= 1
    rows = berth.DistanceRows(robot)
    rows.update(result)
    moved = np.array(result.link_is_moved)
    for kind, bound_m in ((berth.RowKind.nearest, result.lower_bound_m), (berth.RowKind.known, result.known_lower_bound_m)):
        falls = -(rows.gradient(kind) @ out.velocity)[moved]
        assert (np.nan_to_num(falls) <= 2 * np.maximum(0, bound_m[moved] - 0.02) + 1e-6).all()
    assert all(name in result.link_names and isinstance(kind, berth.RowKind) for name, kind in out.held_by)


def test_each_candidate_has_a_row_and_weights_count(one_camera):
    step = next(iter(one_camera))
    robot = berth.Robot(one_camera.robot.model, berth.EvaluationSettings(candidates=3))
    seen = one_camera.views[0]
    view = berth.MountedCamera(robot, seen.camera, seen.parent_link, seen.X_PC)
    result = berth.Query(robot).ask(berth.Observer(view).observe(step.depth_m, step.joints, stamp_s=0.0), step.joints)
    rows = berth.DistanceRows(robot)
    rows.update(result)
    assert any(link.candidates for link in result)
    for i, link in enumerate(result):
        for k in (1, 2):
            has_row = not np.isnan(rows.gradient(berth.RowKind.nearest, k)[i]).any()
            assert has_row == (len(link.candidates) >= k)
            assert not has_row or link.candidates[k - 1].distance_m >= link.distance_m - 0.002
    with pytest.raises(IndexError, match="candidate: 3; expected 0 to 2 for nearest"):
        rows.gradient(berth.RowKind.nearest, 3)
    out = berth.VelocityFilter(robot).update(result, step.joints, np.zeros(7), np.zeros(7), weight=np.zeros(7))
    assert out.status == berth.FilterStatus.bad_joints


def test_another_robot_is_beside_the_first(one_camera):
    arm = SOURCE / "data/bundled/arm"
    away = np.eye(4)
    away[0, 3] = 3
    other = berth.OtherRobot(arm / "arm.urdf", prefix="second_", parent="table", X_PR=away, package_paths={"berth_arm": arm})
    model = berth.load_robot(arm / "arm.urdf", {"berth_arm": arm}, environment_links=["table"], others=[other])
    assert len(model.joint_names) == 14 and "second_arm_link_7" in model.link_names
    assert np.allclose(model.link_poses(np.zeros(14))["second_table"][:3, 3], [3, 0, 0])
    with pytest.raises(ValueError, match="nobody"):
        berth.load_robot(arm / "arm.urdf", {"berth_arm": arm},
                         others=[berth.OtherRobot(arm / "arm.urdf", prefix="b_", parent="nobody", X_PR=np.eye(4), package_paths={"berth_arm": arm})])


def test_what_is_missing_stops_it(asked):
    robot, result, position = asked
    out = berth.VelocityFilter(robot).update(result, position, np.zeros(7), [np.nan] * 7)
    assert out.status == berth.FilterStatus.bad_joints and (out.velocity == 0).all()
    unseen = [link.link for link in result.links if link.is_moved and link.status.name in ("not_seen", "not_observed")]
    out = berth.VelocityFilter(robot).update(result, position, np.zeros(7), np.zeros(7))
    assert (out.status == berth.FilterStatus.unseen) == bool(unseen)
    if unseen:
        assert [name for name, _ in out.held_by] == unseen


def test_settings_are_checked():
    with pytest.raises(ValueError, match="velocity_filter.period_s: 0; expected a finite number above 0"):
        berth.VelocityFilterSettings(period_s=0)
