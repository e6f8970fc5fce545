"""Verdicts on many configurations: shapes, the exact search's word, what is refused."""
import numpy as np
import pytest

import berth

FREE, NEAR, UNDECIDED = (int(v) for v in (berth.Verdict.free, berth.Verdict.near, berth.Verdict.undecided))


@pytest.fixture(scope="module")
def prepared(bundled):
    newest = {step.frame.camera: step.frame for step in bundled}
    check = berth.ConfigurationCheck(bundled.robot)
    assert check.prepare(list(newest.values())) == berth.ResultStatus.ok
    return bundled.robot, check, list(newest.values())


def test_verdicts_are_those_of_the_exact_search(prepared):
    robot, check, frames = prepared
    rows = np.random.default_rng(1).uniform(-2, 2, (300, 7))
    verdicts = check.ask(rows, margin_m=0.02)
    assert verdicts.shape == (300,) and verdicts.dtype == np.uint8
    ahead = berth.Query(robot).ask(frames, ahead=rows[:40]).ahead
    moved = np.array(robot.model.link_is_moved)
    least_m = np.nanmin(np.where(np.isnan(ahead.distance_m), np.inf, ahead.distance_m)[:, moved], axis=1)
    bound_m = np.nanmin(ahead.lower_bound_m[:, moved], axis=1)
    assert (least_m[verdicts[:40] == FREE] > 0.02).all() and (bound_m[verdicts[:40] == NEAR] <= 0.02).all()
    decided = check.ask(rows[:40], margin_m=0.02, resolve=True)
    assert (np.abs(least_m[decided == UNDECIDED] - 0.02) < 2e-3).all()
    # All of the robot's own body counts only where it is asked about.
    assert (check.ask(rows, known_margin_m=0.0) == FREE).sum() <= (check.ask(rows) == FREE).sum()
    assert (check.ask(rows, without=[n for n in robot.model.link_names if n.startswith("arm")]) == FREE).all()
    near_links = check.ask(rows, margin_m=0, link_margins_m={"arm_link_7": 0.1})
    assert (near_links == FREE).sum() < (check.ask(rows, margin_m=0) == FREE).sum()


def test_a_motion_that_is_free_has_free_configurations(prepared):
    _, check, _ = prepared
    ends = np.random.default_rng(2).uniform(-2, 2, (2, 50, 7))
    for start, end, verdict in zip(*ends, check.ask_motions(*ends)):
        if verdict == FREE:
            assert (check.ask(np.linspace(start, end, 20), margin_m=0.029) != NEAR).all()


@pytest.mark.parametrize("arguments, message", [
    ((np.zeros(7),), "configurations: 1 dimensions; expected an array of N x 7 joints"),
    ((np.zeros((2, 6)),), "expected an array of N x 7 joints"),
    ((np.full((1, 7), np.nan),), "of configuration 0 is nan; expected a finite number"),
    ((np.zeros((1, 7)), -1), "a margin is -1 m; expected a finite number of at least 0"),
])
def test_what_is_wrong_is_refused(prepared, arguments, message):
    with pytest.raises(ValueError, match=message):
        prepared[1].ask(*arguments)


def test_without_frames_nothing_is_decided(prepared):
    robot, _, frames = prepared
    check = berth.ConfigurationCheck(robot)
    assert (check.ask(np.zeros((3, 7))) == UNDECIDED).all()
    assert check.prepare(frames, now_s=1e6) == berth.ResultStatus.stale
    assert (check.ask(np.zeros((3, 7))) == UNDECIDED).all()
