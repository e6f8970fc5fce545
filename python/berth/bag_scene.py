"""Depth images, camera_info, joint states and TF of a bag, as ROS has them, become a scene folder.

Messages may come from any reader whose objects have the fields of ROS 2's messages: rclpy, rosbags,
mcap. Nothing of berth is needed, so that the ROS 2 package uses this file too.
"""
import os
import pathlib
import shutil
from dataclasses import dataclass, field
from typing import Optional

import numpy as np
import yaml

IMAGE = "sensor_msgs/msg/Image"


@dataclass
class BagOptions:
    """What to take from a bag, and where to."""

    bag: str
    out: str
    """The folder to write; must not be there yet."""
    camera: list = field(default_factory=lambda: ["camera"])
    """Names. Of each the topics /NAME/depth_image and /NAME/camera_info are read."""
    topics: dict = field(default_factory=dict)
    """Image topics by camera, where they have other names; camera_info is beside them."""
    joints: str = "/joint_states"
    urdf: Optional[str] = None
    """Without it the bag's /robot_description."""
    environment_link: list = field(default_factory=list)
    every: int = 1

    def __post_init__(self):
        self.topics = {name: self.topics.get(name, f"/{name}/depth_image") for name in self.camera}


def bag_to_scene(options, types, messages, write_png):
    """Writes the folder; returns a sentence about it.

    `types` are the types of the bag's topics, `messages` its (topic, message) in order, and
    `write_png(file, numbers)` writes an image of uint16. Raises ValueError or OSError that says what
    is missing; nothing is left behind then.
    """
    if os.path.exists(options.out):
        raise ValueError(f"{options.out}: is there already; expected a new folder")
    return write_scene(read_bag(options, types, messages), options, write_png)


class Bag:
    """What is taken from a bag."""

    def __init__(self, cameras):
        self.images = {name: [] for name in cameras}
        self.infos = {}
        self.joints = []
        self.description = None
        self.parents = {}  # child frame -> (parent frame, 4 x 4 pose of the child in it)


def read_bag(options, types, messages):
    for topic in options.topics.values():
        if types.get(topic) != IMAGE:
            images = [name for name, kind in types.items() if kind == IMAGE]
            raise ValueError(f"{options.bag}: no {IMAGE} on {topic}; images are on {', '.join(images) or 'no topic'}")
    if options.joints not in types:
        raise ValueError(f"{options.bag}: no topic {options.joints}; expected the joint states there")
    bag = Bag(options.camera)
    take = takers(bag, options)
    counts = {}
    for topic, message in messages(list(take)):
        counts[topic] = counts.get(topic, -1) + 1
        take[topic](message, counts[topic])
    return bag


def takers(bag, options):
    """What to do with each message, by topic."""
    take = {
        options.joints: lambda message, _: bag.joints.append(message),
        "/tf_static": lambda message, _: keep_transforms(bag, message),
        "/tf": lambda message, count: keep_transforms(bag, message),
        "/robot_description": lambda message, _: setattr(bag, "description", message.data),
    }
    for name, topic in options.topics.items():
        def take_image(message, count, name=name):
            if count % options.every == 0:
                bag.images[name].append(message)
        take[topic] = take_image
        take[topic.rsplit("/", 1)[0] + "/camera_info"] = lambda message, _, name=name: bag.infos.setdefault(name, message)
    return take


def keep_transforms(bag, message):
    for transform in message.transforms:
        bag.parents.setdefault(transform.child_frame_id, (transform.header.frame_id, pose_of(transform.transform)))


def pose_of(transform):
    q, t = transform.rotation, transform.translation
    x, y, z, w = np.array([q.x, q.y, q.z, q.w]) / np.linalg.norm([q.x, q.y, q.z, q.w])
    pose = np.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = [t.x, t.y, t.z]
    return pose


def mount_of(bag, name, frame, links):
    """The first link of the robot above the camera's frame, and the camera's pose in it."""
    pose, at = np.eye(4), frame
    while at in bag.parents:
        at, step = bag.parents[at]
        pose = step @ pose
        if at in links:
            return at, pose
    raise ValueError(f"camera {name}: TF leads from its frame {frame} to {at}, which is no link of the robot; "
                     f"expected a transform from a link to the camera")


def stamp_of(header, first_ns):
    return (header.stamp.sec * 10**9 + header.stamp.nanosec - first_ns) * 1e-9


def depth_of(name, image):
    """Metres per unit, and the image in these units as 16-bit numbers."""
    if image.is_bigendian:
        raise ValueError(f"camera {name}: big-endian images; expected little-endian ones")
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    if image.encoding in ("16UC1", "mono16"):
        return rows[:, :2 * image.width].copy().view("<u2")
    if image.encoding == "32FC1":
        metres = rows[:, :4 * image.width].copy().view("<f4")
        valid = np.isfinite(metres) & (metres > 0)
        return np.where(valid, np.clip(np.rint(np.where(valid, metres, 0) * 1000), 1, 65535), 0).astype("<u2")
    raise ValueError(f"camera {name}: encoding {image.encoding}; expected 16UC1 or 32FC1")


def joint_rows(bag, first_ns):
    """Whole rows: each joint interpolated between its own messages, at every message's time."""
    series = {}
    for message in bag.joints:
        t = stamp_of(message.header, first_ns)
        for joint, position in zip(message.name, message.position):
            times, positions = series.setdefault(joint, ([], []))
            if (not times or t > times[-1]) and np.isfinite(position):
                times.append(t)
                positions.append(position)
    if not series:
        raise ValueError("the bag has no joint state")
    begin = max(times[0] for times, _ in series.values())
    end = min(times[-1] for times, _ in series.values())
    every = np.unique(np.concatenate([times for times, _ in series.values()]))
    times = every[(every >= begin) & (every <= end)]
    if times.size == 0:
        raise ValueError("the bag has no time at which all joints are known")
    columns = [np.interp(times, *values) for values in series.values()]
    return list(series), np.column_stack([times, *columns])


def links_of(urdf):
    import xml.etree.ElementTree as ElementTree
    try:
        return [link.get("name") for link in ElementTree.fromstring(urdf).findall("link")]
    except ElementTree.ParseError as error:
        raise ValueError(f"the URDF: {error}; expected XML") from error


def write_scene(bag, options, write_png):
    if options.urdf:
        urdf = pathlib.Path(options.urdf).read_text(encoding="utf-8")
    elif bag.description:
        urdf = bag.description
    else:
        raise ValueError(f"{options.bag}: no /robot_description; expected --urdf")
    headers = [image.header for images in bag.images.values() for image in images]
    if not headers:
        raise ValueError(f"{options.bag}: no depth image of {', '.join(options.camera)}")
    first_ns = min(header.stamp.sec * 10**9 + header.stamp.nanosec for header in headers)
    links = links_of(urdf)
    for link in options.environment_link:
        if link not in links:
            raise ValueError(f"--environment-link {link}: no link of the robot; expected one of {', '.join(links)}")
    names, rows = joint_rows(bag, first_ns)
    cameras = [camera_entry(bag, name, links, first_ns) for name in options.camera]
    pngs = {name: [depth_of(name, image) for image in bag.images[name]] for name in options.camera}
    # All is known to be right: now it is written, and has its name once it is whole.
    out = pathlib.Path(options.out + ".part")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    for name in options.camera:
        (out / name).mkdir()
        for i, numbers in enumerate(pngs[name]):
            write_png(str(out / name / f"{i:06}.png"), numbers)
        (out / f"{name}_info.yaml").write_text(yaml.safe_dump(info_of(bag.infos[name]), sort_keys=False))
    header = "time," + ",".join(names)
    np.savetxt(out / "joints.csv", rows, delimiter=",", header=header, comments="", fmt="%.9f")
    robot = {"urdf": os.path.relpath(options.urdf, options.out)} if options.urdf else {"urdf": "robot.urdf"}
    if options.environment_link:
        robot["environment_links"] = options.environment_link
    if not options.urdf:
        (out / "robot.urdf").write_text(urdf, encoding="utf-8")
    scene = {"robot": robot, "cameras": cameras, "joints": "joints.csv"}
    text = f"# Made from {os.path.basename(os.path.normpath(options.bag))}.\n"
    (out / "scene.yaml").write_text(text + yaml.safe_dump(scene, sort_keys=False, default_flow_style=None))
    out.rename(options.out)
    return (f"{options.out}/scene.yaml: {len(headers)} images of {len(cameras)} cameras, "
            f"{len(rows)} joint samples")


def camera_entry(bag, name, links, first_ns):
    images = bag.images[name]
    if not images:
        raise ValueError(f"camera {name}: no image in the bag")
    if name not in bag.infos:
        raise ValueError(f"camera {name}: no camera_info in the bag")
    parent, pose = mount_of(bag, name, images[0].header.frame_id, links)
    return {
        "name": name,
        "info": f"{name}_info.yaml",
        "pose": {"parent": parent, "xyz": pose[:3, 3].tolist(), "quaternion_xyzw": quaternion_of(pose[:3, :3])},
        "depth": f"{name}/*.png",
        "depth_scale": 0.001,
        "stamps": [round(stamp_of(image.header, first_ns), 9) for image in images],
    }


def quaternion_of(rotation):
    """x, y, z, w."""
    k = np.array([
        [rotation[0, 0] - rotation[1, 1] - rotation[2, 2], 0, 0, 0],
        [rotation[0, 1] + rotation[1, 0], rotation[1, 1] - rotation[0, 0] - rotation[2, 2], 0, 0],
        [rotation[0, 2] + rotation[2, 0], rotation[1, 2] + rotation[2, 1],
         rotation[2, 2] - rotation[0, 0] - rotation[1, 1], 0],
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1],
         np.trace(rotation)]]) / 3
    values, vectors = np.linalg.eigh(k)
    return vectors[:, np.argmax(values)].tolist()


def info_of(info):
    return {
        "image_width": info.width,
        "image_height": info.height,
        "camera_matrix": {"rows": 3, "cols": 3, "data": [float(x) for x in info.k]},
        "distortion_model": info.distortion_model or "plumb_bob",
        "distortion_coefficients": {"rows": 1, "cols": len(info.d) or 5, "data": [float(x) for x in info.d] or [0.0] * 5},
    }
