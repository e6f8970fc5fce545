"""The example's one rule: what is not known stops the robot."""
import importlib.machinery
import importlib.util
import math
import pathlib

import pytest
from berth_msgs.msg import Separation

FILE = pathlib.Path(__file__).parent.parent / "examples" / "scale_speed"
LOADER = importlib.machinery.SourceFileLoader("scale_speed", str(FILE))
scale_speed = importlib.util.module_from_spec(importlib.util.spec_from_loader("scale_speed", LOADER))
LOADER.exec_module(scale_speed)


@pytest.mark.parametrize("distance_m, scale", [(0.0, 0.0), (0.2, 0.0), (0.4, 0.5), (0.6, 1.0), (5.0, 1.0)])
def test_the_scale_grows_with_the_distance(distance_m, scale):
    assert scale_speed.scale_of(Separation(state=Separation.UNMONITORED, has_distance=True, distance_m=distance_m), 0.2, 0.6) == pytest.approx(scale)


@pytest.mark.parametrize("separation", [
    Separation(state=Separation.UNMONITORED, has_distance=False, distance_m=1.0),
    Separation(state=Separation.UNMONITORED, has_distance=True, distance_m=float("nan")),
    Separation(state=Separation.STOP, has_distance=True, distance_m=5.0),
])
def test_what_is_not_known_stops_the_robot(separation):
    assert scale_speed.scale_of(separation, 0.2, 0.6) == 0.0


def test_it_brakes_and_gains_speed_as_fast_as_the_robot_can_and_no_faster():
    ramp = scale_speed.Ramp(deceleration_m_s2=2.0, acceleration_m_s2=1.0)
    assert ramp.step(1.0, 0.5, 0.01) == pytest.approx(0.02)
    for _ in range(60):
        ramp.step(1.0, 0.5, 0.01)
    assert ramp.scale == 1.0
    assert ramp.step(0.0, 0.5, 0.01) == pytest.approx(0.96)
    assert ramp.step(0.95, 0.5, 0.01) == pytest.approx(0.95)
    assert ramp.step(0.0, 0.5, 10.0) == pytest.approx(0.87), "a node that was late is no reason to brake harder"
    assert ramp.step(0.0, 0.5, 0.0) == pytest.approx(0.87)
    assert ramp.step(0.0, 0.0, 0.01) == 0.0, "a robot that stands has nothing to brake"


def test_by_default_it_falls_at_once():
    ramp = scale_speed.Ramp(deceleration_m_s2=math.inf, acceleration_m_s2=1.0)
    assert ramp.step(1.0, 0.5, 0.01) == pytest.approx(0.02)
    assert ramp.step(0.0, 0.5, 0.01) == 0.0


def test_it_is_an_example_and_short():
    assert len(FILE.read_text().splitlines()) < 120
