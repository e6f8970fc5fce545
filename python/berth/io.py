"""Scene folders and bags: read, write, import."""

from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt
import yaml

import berth
from berth import _berth
from berth.bag_scene import BagOptions, bag_to_scene, quaternion_of

Array = npt.NDArray[Any]

__all__ = ["CameraRecord", "import_bag", "read_depth", "write_depth", "write_scene"]


def read_depth(file: str, camera: berth.Camera, depth_scale: float = 0.001) -> Array:
    """A 16-bit grayscale PNG in metres, float32; NaN where it has 0."""
    return _berth.read_depth_png(file, camera, depth_scale)


def write_depth(file: str, depth: Array, depth_scale: float = 0.001) -> None:
    """A depth image (float32 in metres, or uint16) as a 16-bit grayscale PNG in these units."""
    _berth.write_depth_png(file, depth, depth_scale)


@dataclass
class CameraRecord:
    """What one camera of a scene saw."""

    name: str
    camera: berth.Camera
    parent_link: str
    X_PC: Array
    """The pose, 4 x 4, of its optical frame in the frame of parent_link."""
    depth: Sequence[Array]
    stamps_s: Sequence[float]
    depth_scale: float = 0.001


def write_scene(folder: str, urdf: str, cameras: Sequence[CameraRecord], joint_times_s: Sequence[float],
                joints: Dict[str, Sequence[float]], environment_links: Sequence[str] = (),
                package_paths: Optional[Dict[str, str]] = None) -> str:
    """Writes a new scene folder and returns the path of its scene.yaml.

    `joints` has the positions of each joint, rad or m, at joint_times_s. The URDF stays where it is.
    Raises ValueError where sizes do not go together, and leaves nothing behind then.
    """
    if os.path.exists(folder):
        raise ValueError(f"{folder}: is there already; expected a new folder")
    rows = np.column_stack([np.asarray(joint_times_s, float), *(np.asarray(p, float) for p in joints.values())])
    for camera in cameras:
        if len(camera.depth) != len(camera.stamps_s):
            raise ValueError(f"camera {camera.name}: {len(camera.stamps_s)} stamps; "
                             f"expected one for each of {len(camera.depth)} images")
    out = pathlib.Path(str(folder) + ".part")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    try:
        entries = [_write_camera(out, camera) for camera in cameras]
        np.savetxt(out / "joints.csv", rows, delimiter=",", header="time," + ",".join(joints), comments="", fmt="%.9f")
        robot: Dict[str, Any] = {"urdf": os.path.abspath(urdf)}
        if environment_links:
            robot["environment_links"] = list(environment_links)
        if package_paths:
            robot["package_paths"] = {name: os.path.abspath(path) for name, path in package_paths.items()}
        scene = {"robot": robot, "cameras": entries, "joints": "joints.csv"}
        (out / "scene.yaml").write_text(yaml.safe_dump(scene, sort_keys=False, default_flow_style=None))
        out.rename(folder)
    finally:
        shutil.rmtree(out, ignore_errors=True)
    return os.path.join(folder, "scene.yaml")


def _write_camera(out: pathlib.Path, record: CameraRecord) -> Dict[str, Any]:
    (out / record.name).mkdir()
    for i, depth in enumerate(record.depth):
        write_depth(str(out / record.name / f"{i:06}.png"), depth, record.depth_scale)
    c = record.camera
    info = {
        "image_width": c.width_px,
        "image_height": c.height_px,
        "camera_matrix": {"rows": 3, "cols": 3, "data": [c.fx_px, 0.0, c.cx_px, 0.0, c.fy_px, c.cy_px, 0.0, 0.0, 1.0]},
        "distortion_model": "plumb_bob",
        "distortion_coefficients": {"rows": 1, "cols": 5, "data": [0.0] * 5},
    }
    (out / f"{record.name}_info.yaml").write_text(yaml.safe_dump(info, sort_keys=False))
    X = np.asarray(record.X_PC, float)
    quaternion = quaternion_of(X[:3, :3])  # type: ignore[no-untyped-call]
    return {
        "name": record.name,
        "info": f"{record.name}_info.yaml",
        "pose": {"parent": record.parent_link, "xyz": X[:3, 3].tolist(), "quaternion_xyzw": quaternion},
        "depth": f"{record.name}/*.png",
        "depth_scale": record.depth_scale,
        "stamps": [float(stamp) for stamp in record.stamps_s],
    }


def import_bag(bag: str, out: str, cameras: Sequence[str] = ("camera",), topics: Optional[Dict[str, str]] = None,
               joints: str = "/joint_states", urdf: Optional[str] = None, environment_links: Sequence[str] = (),
               every: int = 1, rectified: Sequence[str] = (), fixed_joints: Optional[Dict[str, float]] = None) -> str:
    """Writes a bag's depth images, camera_info, joint states and TF as a scene folder.

    Of each camera NAME the topics /NAME/depth_image (16UC1 or 32FC1, or a CompressedImage of them) and
    /NAME/camera_info are read; `topics` names other image topics. `rectified` are cameras whose images
    are rectified though no part of their topic's name is rect; `fixed_joints` the positions of joints
    that never move and that nobody tells. Needs the package rosbags, or mcap and mcap-ros2-support for
    an .mcap file. Returns what was written and what is strange in it. Raises ImportError that names the
    packages, ValueError or OSError that says what is missing or wrong.
    """
    if every < 1:
        raise ValueError(f"every: {every}; expected 1 or more")
    options = BagOptions(bag=bag, out=out, camera=list(cameras), topics=dict(topics or {}), joints=joints, urdf=urdf,
                         environment_link=list(environment_links), every=every, rectified=list(rectified),
                         fixed_joint=dict(fixed_joints or {}))
    types, messages = _open_mcap(bag) if str(bag).endswith(".mcap") else _open_rosbag(bag)
    return str(bag_to_scene(options, types, messages, write_depth))  # type: ignore[no-untyped-call]


_Messages = Callable[[List[str]], Iterator[Tuple[str, Any]]]


def _open_rosbag(bag: str) -> Tuple[Dict[str, str], _Messages]:
    try:
        from rosbags.highlevel import AnyReader  # type: ignore[import]
        from rosbags.typesys import Stores, get_typestore  # type: ignore[import]
    except ImportError as error:
        raise ImportError("import_bag needs the package rosbags: pip install berth[bags]") from error
    # The messages that are read are the same in all releases; bags of Humble do not bring their definitions.
    reader = AnyReader([pathlib.Path(bag)], default_typestore=get_typestore(Stores.ROS2_HUMBLE))
    reader.open()
    types = {connection.topic: connection.msgtype for connection in reader.connections}

    def messages(wanted: List[str]) -> Iterator[Tuple[str, Any]]:
        connections = [c for c in reader.connections if c.topic in wanted]
        with contextlib.closing(reader):
            for connection, _, data in reader.messages(connections=connections):
                yield connection.topic, reader.deserialize(data, connection.msgtype)

    return types, messages


def _open_mcap(bag: str) -> Tuple[Dict[str, str], _Messages]:
    try:
        from mcap.reader import make_reader  # type: ignore[import]
        from mcap_ros2.decoder import DecoderFactory  # type: ignore[import]
    except ImportError as error:
        raise ImportError("import_bag needs the packages mcap and mcap-ros2-support for an .mcap file: "
                          "pip install berth[bags]") from error
    with open(bag, "rb") as file:
        summary = make_reader(file).get_summary()
    if summary is None:
        raise ValueError(f"{bag}: has no summary; expected a complete .mcap file")
    types = {channel.topic: summary.schemas[channel.schema_id].name for channel in summary.channels.values()}

    def messages(wanted: Iterable[str]) -> Iterator[Tuple[str, Any]]:
        with open(bag, "rb") as file:
            reader = make_reader(file, decoder_factories=[DecoderFactory()])
            for _, channel, _, message in reader.iter_decoded_messages(topics=list(wanted)):
                yield channel.topic, message

    return types, messages
