"""Pictures of frames, results and calibrations; needs matplotlib (pip install berth[plot])."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

import berth

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = npt.NDArray[Any]

__all__ = ["distances", "frame", "links", "png", "residuals"]

# What became of a pixel, in the colours of `berth run --picture`; readings that were kept are grey by
# their depth.
FATE_COLORS = {
    "no_reading": "#121316",
    "robot": "#3E6FB0",
    "environment": "#8A6A3C",
    "padding": "#8E5FB8",
    "flying_patch": "#6CA83C",
    "outside_region": "#B8A43A",
    "soft": "#D87A4A",
    "speckle": "#E0B020",
    "background": "#20B870",
    "hole": "#E060C0",
}
# Okabe and Ito (2008), for links.
LINK_COLORS = ["#E69F00", "#0072B2", "#F0E442", "#D55E00", "#56B4E9", "#CC79A7", "#009E73", "#AA3377"]


def _axes(ax: Optional[Axes], size: Tuple[float, float]) -> Any:
    if ax is not None:
        return ax
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("berth.plot needs the package matplotlib: pip install berth[plot]") from error
    return Figure(figsize=size, layout="constrained").add_subplot()


def _fate_image(shown: berth.Frame) -> Tuple[Array, List[str]]:
    """Red, green and blue of each pixel, and the names of the fates that occur besides obstacle."""
    fate = shown.fate
    depth_m = shown.obstacle_depth_m
    seen = depth_m[np.isfinite(depth_m)]
    near, far = (np.percentile(seen, [1, 99]) if seen.size else (0.0, 1.0))
    grey = 0.9 - 0.6 * np.clip((depth_m - near) / max(far - near, 1e-6), 0, 1)
    image = np.repeat(np.nan_to_num(grey)[:, :, np.newaxis], 3, axis=2)
    names = []
    for name, color in FATE_COLORS.items():
        mask = fate == int(getattr(berth.PixelFate, name))
        if mask.any():
            names.append(name)
            image[mask] = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return image, names


def frame(shown: berth.Frame, result: Optional[berth.Result] = None, camera: Optional[berth.Camera] = None,
          ax: Optional[Axes] = None) -> Any:
    """What became of each pixel of a frame. With a result and the camera, the links' least distances too.

    Returns the axes.
    """
    image, names = _fate_image(shown)
    axes = _axes(ax, (10.5, 8 * image.shape[0] / image.shape[1] + 0.4))
    from matplotlib.patches import Patch

    axes.imshow(image, interpolation="nearest")
    axes.set(title=f"{shown.camera}, {shown.stamp_s:.3f} s", xticks=[], yticks=[])
    handles: List[Any] = [Patch(color="#A8A8A8", label="obstacle")]
    handles += [Patch(color=FATE_COLORS[name], label=name.replace("_", " ")) for name in names]
    if result is not None and camera is not None:
        handles += _draw_pairs(axes, shown, result, camera)
    axes.legend(handles=handles, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    return axes


def _draw_pairs(axes: Any, shown: berth.Frame, result: berth.Result, camera: berth.Camera) -> List[Any]:
    """A line from each link to what is nearest; returns their entries of the legend."""
    from matplotlib.lines import Line2D

    entries = []
    to_camera = np.linalg.inv(shown.X_BC)
    for i, link in enumerate(result.links):
        points = np.stack([link.robot_point_base_m, link.obstacle_point_base_m]) @ to_camera[:3, :3].T + to_camera[:3, 3]
        if not (points[:, 2] > 0).all():
            continue
        u = camera.fx_px * points[:, 0] / points[:, 2] + camera.cx_px
        v = camera.fy_px * points[:, 1] / points[:, 2] + camera.cy_px
        color = LINK_COLORS[i % len(LINK_COLORS)]
        axes.plot(u, v, "o-", color=color, markersize=3, linewidth=1.5, scalex=False, scaley=False)
        entries.append(Line2D([], [], color=color, marker="o", markersize=3, label=f"{link.link}: {link.distance_m:.3f} m"))
    return entries


def distances(results: Sequence[berth.Result], moving_only: bool = True, ax: Optional[Axes] = None) -> Any:
    """The least distance of each link over the time of the exposures. Returns the axes."""
    if not results:
        raise ValueError("results: none; expected one at least")
    axes = _axes(ax, (9, 4.5))
    times_s = [result.stamp_s for result in results]
    all_m = np.stack([result.distance_m for result in results])
    moved = results[0].link_is_moved
    for i, name in enumerate(results[0].link_names):
        if moved[i] or not moving_only:
            style = "-" if i < len(LINK_COLORS) else "--"
            axes.plot(times_s, all_m[:, i], style, color=LINK_COLORS[i % len(LINK_COLORS)], label=name)
    axes.set(xlabel="time, s", ylabel="least distance, m", ylim=(0, None))
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    axes.grid(alpha=0.3)
    return axes


def links(result: berth.Result, ax: Optional[Axes] = None) -> Any:
    """The least distance of each link as a bar, and its lower bound as a mark. Returns the axes."""
    names = result.link_names
    axes = _axes(ax, (6, 0.6 + 0.3 * len(names)))
    axes.barh(names, np.nan_to_num(result.distance_m), color="#0072B2")
    axes.plot(result.lower_bound_m, names, "|", color="black", markersize=10)
    for i, link in enumerate(result.links):
        text = f" {link.distance_m:.3f} m" if np.isfinite(link.distance_m) else f" {link.status.name.replace('_', ' ')}"
        axes.text(np.nan_to_num(link.distance_m), i, text, va="center", fontsize=8)
    axes.margins(x=0.15)
    axes.invert_yaxis()
    axes.set(xlabel="least distance, m", title=f"exposure at {result.stamp_s:.3f} s, {result.time.status.name.replace('_', ' ')}")
    return axes


def residuals(calibration: berth.Calibration, ax: Optional[Axes] = None) -> Any:
    """How far readings lie from the model's surface before and after a calibration. Returns the axes."""
    cameras = calibration.cameras
    axes = _axes(ax, (7, 1.4 + 0.8 * len(cameras)))
    for i, camera in enumerate(cameras):
        for offset, values, color in ((0.18, camera.before_m, "#D55E00"), (-0.18, camera.after_m, "#0072B2")):
            label = {0.18: "before", -0.18: "after"}[offset] if i == 0 else None
            axes.plot([0, values[1] * 1000], [i + offset] * 2, color=color, linewidth=6, label=label)
            axes.plot([values[0] * 1000], [i + offset], "|", color="black", markersize=12)
    axes.set(yticks=range(len(cameras)), yticklabels=[camera.camera for camera in cameras],
             xlabel="residual, mm: bar to 90 %, mark at the median", xlim=(0, None), ylim=(-0.7, len(cameras) - 0.3))
    axes.legend(frameon=False)
    return axes


def png(axes: Any) -> bytes:
    """The figure of these axes as a PNG."""
    out = io.BytesIO()
    axes.figure.savefig(out, format="png")
    return out.getvalue()
