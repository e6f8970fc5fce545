"""Exact distances between a robot and what depth cameras see::

    robot = berth.Robot(berth.load_robot("arm.urdf"))
    view = berth.MountedCamera(robot, camera, "base_link", X_PC)
    frame = berth.Observer(view).observe(depth, joints)
    print(berth.Query(robot).ask(frame).distance_m)

Metres, radians, seconds. A name carries its unit (`depth_m`) and its frame (`p_C`: a point in frame
C; `X_BC`: the pose of C in B). Frames: B the robot's root link, P the link that a camera is fixed
to, C the camera's optical frame (z forward, x right, y down).
"""

from berth import _berth
from berth._berth import *  # noqa: F403
from berth._berth import __version__ as __version__


def _frame_png(self: _berth.Frame) -> bytes:
    from berth import plot

    return plot.png(plot.frame(self))


def _result_png(self: _berth.Result) -> bytes:
    from berth import plot

    return plot.png(plot.links(self))


# Notebooks show frames and results as pictures.
_berth.Frame._repr_png_ = _frame_png  # type: ignore[assignment]
_berth.Result._repr_png_ = _result_png  # type: ignore[assignment]
