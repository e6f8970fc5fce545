"""Rows and the filter: shapes, what is missing, and that the filter holds what it says."""
import numpy as np
import pytest

import berth


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
