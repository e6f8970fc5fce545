"""Depth images, camera_info, joint states and TF of a bag, as ROS has them, become a scene folder.

Messages may come from any reader whose objects have the fields of ROS 2's messages: rclpy, rosbags,
mcap. Nothing of berth is needed, so that the ROS 2 package uses this file too.
"""
import os
import pathlib
import re
import shutil
import struct
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass, field
from typing import Optional

import numpy as np
import yaml

IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
PIXELS = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}
PNG = b"\x89PNG\r\n\x1a\n"
# Poses of one frame that differ by less are of one publisher that rounds, or of two that agree.
SAME_M, SAME_RAD = 0.001, 0.002


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
    rectified: list = field(default_factory=list)
    """Cameras whose images are rectified though their topic has no part "rect"."""
    fixed_joint: dict = field(default_factory=dict)
    """Positions of joints that never move and that nobody tells."""

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
        self.infos = {}  # as it is written, by camera
        self.joints = []
        self.description = None
        self.transforms = {}  # child frame -> where it is, and where else it is said to be
        self.notes = []


def read_bag(options, types, messages):
    for topic in options.topics.values():
        if types.get(topic) not in (IMAGE, COMPRESSED):
            images = [name for name, kind in types.items() if kind in (IMAGE, COMPRESSED)]
            raise ValueError(f"{options.bag}: no {IMAGE} or CompressedImage on {topic}; "
                             f"images are on {', '.join(images) or 'no topic'}")
    if options.joints not in types:
        raise ValueError(f"{options.bag}: no topic {options.joints}; expected the joint states there")
    for name in options.rectified:
        if name not in options.topics:
            raise ValueError(f"--rectified {name}: no camera; expected one of {', '.join(options.topics)}")
    bag = Bag(options.camera)
    take = takers(bag, options, types)
    counts = {}
    for topic, message in messages(list(take)):
        counts[topic] = counts.get(topic, -1) + 1
        take[topic](message, counts[topic])
    return bag


def takers(bag, options, types):
    """What to do with each message, by topic."""
    take = {
        options.joints: lambda message, _: bag.joints.append(message),
        "/tf_static": lambda message, _: keep_transforms(bag, "/tf_static", message),
        "/tf": lambda message, _: keep_transforms(bag, "/tf", message),
        "/robot_description": lambda message, _: setattr(bag, "description", message.data),
    }
    for name, topic in options.topics.items():
        def take_image(message, count, name=name):
            if count % options.every == 0:
                bag.images[name].append(message)
        take[topic] = take_image
        # image_transport puts compressed images below the image's own topic.
        image = topic.rsplit("/", 1)[0] if types[topic] == COMPRESSED and "/compressed" in topic else topic
        info = image.rsplit("/", 1)[0] + "/camera_info"
        take[info] = lambda message, _, name=name: keep_info(bag, name, message)
    return take


def keep_info(bag, name, message):
    """One must hold for all images: nothing says which of them another one is meant for."""
    info = info_of(message)
    kept = bag.infos.setdefault(name, info)
    changed = [key for key in info if info[key] != kept[key]]
    if changed:
        key = changed[0]
        raise ValueError(f"camera {name}: camera_info changes at {stamp_of(message.header):.3f} s: {key} from {kept[key]} "
                         f"to {info[key]}; expected one for all images: take a bag of each")


@dataclass
class Mount:
    """Where a frame is, as a message said."""

    topic: str
    parent: str
    pose: np.ndarray
    """4 x 4, of the frame in its parent."""

    def is_as(self, other):
        turn = self.pose[:3, :3].T @ other.pose[:3, :3]
        return (self.parent == other.parent and np.linalg.norm(self.pose[:3, 3] - other.pose[:3, 3]) <= SAME_M
                and np.linalg.norm(turn - np.eye(3)) <= SAME_RAD * 2 ** 0.5)

    def __str__(self):
        # Without it, -0.0 stands among the numbers.
        xyz, turn = np.round(self.pose[:3, 3], 4) + 0.0, np.round(self.pose[:3, :3], 4) + 0.0
        return f"{self.topic}, in {self.parent}: xyz {xyz.tolist()}, rotation {turn.tolist()}"


def keep_transforms(bag, topic, message):
    for transform in message.transforms:
        mounts = bag.transforms.setdefault(transform.child_frame_id, [])
        if len(mounts) < 2:
            mount = Mount(topic, transform.header.frame_id, pose_of(transform.transform))
            if not mounts or not mounts[0].is_as(mount):
                mounts.append(mount)


def pose_of(transform):
    q, t = transform.rotation, transform.translation
    quaternion = np.array([q.x, q.y, q.z, q.w])
    x, y, z, w = quaternion / (np.linalg.norm(quaternion) or np.nan)
    pose = np.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = [t.x, t.y, t.z]
    return pose


def mount_of(bag, name, frame, links):
    """The first link of the robot above the camera's frame, and the camera's pose in it."""
    if frame in links and not any(mount.topic == "/tf_static" for mount in bag.transforms.get(frame, [])):
        return frame, np.eye(4)  # the robot's own joints tell where it is
    pose, at = np.eye(4), frame
    for _ in bag.transforms:  # no way is longer, unless it goes round
        if at not in bag.transforms:
            break
        mount = only_mount(bag, name, at)
        at, pose = mount.parent, mount.pose @ pose
        if at in links:
            return at, pose
    raise ValueError(f"camera {name}: TF leads from its frame {frame} to {at}, which is no link of the robot; "
                     f"expected a transform from a link to the camera")


def only_mount(bag, name, frame):
    """Of two either may be right: where two nodes publish a frame, chance says which is the later."""
    mount = bag.transforms[frame][0]
    if not np.isfinite(mount.pose).all():
        raise ValueError(f"camera {name}: TF has frame {frame} ({mount}), which is no pose; expected finite numbers")
    if len(bag.transforms[frame]) > 1:
        raise ValueError(f"camera {name}: TF has two transforms of frame {frame} that differ: {mount}; "
                         f"{bag.transforms[frame][1]}; expected one: stop the node that publishes the wrong one, and "
                         f"record again")
    return mount


def stamp_of(header, first_ns=0):
    return (header.stamp.sec * 10**9 + header.stamp.nanosec - first_ns) * 1e-9


def depth_of(name, image):
    """The image in millimetres, as 16-bit numbers; 0 is no reading."""
    try:
        numbers = unpacked(image) if hasattr(image, "format") else pixels_of(image)
        return numbers if numbers.dtype.kind == "u" else millimetres_of(numbers)
    except (ValueError, IndexError, struct.error, zlib.error) as error:
        raise ValueError(f"camera {name}: image of {stamp_of(image.header):.3f} s: {error}") from error


def pixels_of(image):
    """Without what may follow on each row."""
    if image.encoding not in PIXELS:
        raise ValueError(f"encoding {image.encoding}; expected 16UC1 or 32FC1")
    kind = PIXELS[image.encoding]
    used = image.width * int(kind[1])
    if image.step < used or len(image.data) != image.height * image.step:
        raise ValueError(f"{len(image.data)} bytes in rows of {image.step}; expected {image.height} rows of {used} or more")
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)[:, :used]
    return rows.copy().view((">" if image.is_bigendian else "<") + kind).astype("<" + kind)


def millimetres_of(metres):
    """What is infinite or NaN (REP 117), or a driver's mark such as FLT_MAX, is no reading, nor what 16 bits do not hold."""
    numbers = np.rint(metres.astype(float) * 1000)
    far = numbers[np.isfinite(numbers) & (numbers >= 65535)]
    near = (numbers > 0) & (numbers < 65535)
    if far.size > 100 * np.count_nonzero(near) and np.unique(far).size > 100:  # marks are few
        raise ValueError(f"32FC1 with numbers such as {np.median(far) / 1000:.6g}; expected metres")
    return np.where(near, numbers, 0).astype("<u2")


def unpacked(image):
    """Of image_transport: a 16-bit PNG; or 12 bytes, of which 8 tell how depth was coded, and then a PNG or RVL."""
    data = bytes(image.data)
    encoding, _, coding = image.format.partition(";")
    if data.startswith(PNG):
        return png_numbers(data)
    if not data[12:].startswith(PNG) and "rvl" not in coding:
        raise ValueError(f"format {image.format!r}; expected a 16-bit PNG, or compressedDepth of PNG or RVL")
    numbers = png_numbers(data[12:]) if data[12:].startswith(PNG) else rvl_numbers(data[12:])
    if encoding.strip() != "32FC1":
        return numbers
    a, b = struct.unpack("<ff", data[4:12])
    valid = (numbers > 0) & (numbers < 65535)  # the last one is what a depth of 0 becomes
    return np.where(valid, a / np.where(valid, numbers - b, 1), np.nan)


def png_numbers(data):
    width, height, bits, color, _, _, interlace = struct.unpack(">IIBBBBB", data[16:29])
    if (bits, color, interlace) != (16, 0, 0):
        raise ValueError(f"a PNG of {bits} bits and colour type {color}; expected 16-bit grayscale, not interlaced")
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 2 * width)
    return unfiltered(rows[:, :1], rows[:, 1:].reshape(height, width, 2)).view(">u2").reshape(height, width).astype("<u2")


def unfiltered(filters, pixels):
    """Along diagonals: what a PNG's bytes are told from is to their left and above."""
    height, width, _ = pixels.shape
    raw = np.zeros((height + 1, width + 1, 2), np.int16)
    raw[1:, 1:] = pixels
    for diagonal in range(height + width - 1):
        y = np.arange(max(0, diagonal - width + 1), min(height, diagonal + 1)) + 1
        x = diagonal + 2 - y
        left, up, corner = raw[y, x - 1], raw[y - 1, x], raw[y - 1, x - 1]
        off_left, off_up, off_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
        paeth = np.where((off_left <= off_up) & (off_left <= off_corner), left, np.where(off_up <= off_corner, up, corner))
        raw[y, x] = raw[y, x] + np.choose(filters[y - 1], [0, left, up, (left + up) // 2, paeth]) & 255
    return raw[1:, 1:].astype(np.uint8)


def rvl_numbers(data):
    """Of A. Wilson, Fast Lossless Depth Image Compression, 2017.

    Runs: a count of zeros, a count of others, and of these the differences. Each in groups of four bits from the top
    of words, the lowest first, of which one says whether more follow.
    """
    width, height = struct.unpack("<II", data[:8])
    words = np.frombuffer(data, "<u4", offset=8).astype(np.int64)
    groups = np.stack([words >> shift & 15 for shift in range(28, -1, -4)], 1).ravel()
    begins = np.flatnonzero(np.concatenate([[True], groups[:-1] < 8]))
    place = np.arange(groups.size) - np.repeat(begins, np.diff(begins, append=groups.size))
    values = np.add.reduceat((groups & 7) << 3 * place, begins)
    numbers, pixel, at, before = np.zeros(width * height, "<u2"), 0, 0, 0
    while pixel < numbers.size:
        zeros, count = values[at:at + 2]
        coded = values[at + 2:at + 2 + count]
        run = before + np.cumsum(coded >> 1 ^ -(coded & 1))
        pixel, at = pixel + zeros + count, at + 2 + count
        numbers[pixel - count:pixel] = run
        before = run[-1] if count else before
    return numbers.reshape(height, width)


@dataclass
class Joint:
    """Of the URDF, that moves by itself."""

    kind: str
    lower: float
    upper: float
    speed: float

    def __post_init__(self):
        self.turns = self.kind != "prismatic"
        self.unit = "rad" if self.turns else "m"
        # Some URDFs allow less than the robot can, and others nothing, or anything.
        least, most = (3, 30) if self.turns else (0.5, 5)
        self.most_speed = min(max(3 * self.speed, least), most) if self.speed > 0 else most
        # What a joint at full speed goes in 50 ms: as long may be between two messages whose stamps say less.
        self.slack = 0.1 if self.turns else 0.01
        self.most_acceleration = 200 if self.turns else 100

    def jumps(self, steps, apart):
        """Where it goes farther and faster than any; or less far, but there and back in no time."""
        found = (abs(steps) > self.slack) & (abs(steps) > self.most_speed * apart)
        apart = np.maximum(apart, 1e-6)
        acceleration = abs(np.diff(steps / apart)) / (apart[:-1] + apart[1:]) * 2
        back = (steps[:-1] * steps[1:] < 0) & (np.minimum(abs(steps[:-1]), abs(steps[1:])) > self.slack / 10)
        swings = back & (acceleration > self.most_acceleration)
        if np.count_nonzero(swings) > 2:  # an arm that hits on something has one
            found[:-1] |= swings
        return found


def joints_of(robot):
    found = {}
    for joint in robot.findall("joint"):
        name, kind, limit = joint.get("name"), joint.get("type"), joint.find("limit")
        if kind not in ("revolute", "continuous", "prismatic") or joint.find("mimic") is not None:
            continue
        try:
            told = {} if limit is None else limit.attrib
            found[name] = Joint(kind, *(float(told.get(key, 0)) for key in ("lower", "upper", "velocity")))
        except ValueError as error:
            raise ValueError(f"the URDF: limit of joint {name}: {error}; expected a number") from error
    return found


def joint_rows(bag, options, joints, first_ns):
    """Whole rows: each joint interpolated between its own messages, at every message's time."""
    series = series_of(bag, options, first_ns)
    own = [name for name in joints if name in series and name not in options.fixed_joint]
    missing = [name for name in joints if name not in series and name not in options.fixed_joint]
    others = [name for name in series if name not in own]
    if missing:
        raise ValueError(f"joint {', '.join(missing)}: moves in the URDF and is in no message on {options.joints}, which has "
                         f"{', '.join(series) or 'no joint'}; expected all: of one that never moves, --fixed-joint NAME=POSITION")
    if not own:
        raise ValueError("the bag has no joint state of a joint that moves")
    if others:
        bag.notes.append(f"left out {', '.join(others)}: no joint of the URDF that moves by itself, or a fixed one")
    for name in own:
        check_limits(bag, name, joints[name], series[name][1])
    ways = [way_of(name, joints[name], *series[name], first_ns) for name in own]
    begin = max(times[0] for times, _ in ways)
    end = min(times[-1] for times, _ in ways)
    every = np.unique(np.concatenate([times for times, _ in ways]))
    times = every[(every >= begin) & (every <= end)]
    if times.size == 0:
        raise ValueError("the bag has no time at which all joints are known")
    return own, np.column_stack([times, *(np.interp(times, *way) for way in ways)])


def series_of(bag, options, first_ns):
    """Times and positions of each joint, sorted: what another clock told is not dropped as late, but seen as a jump."""
    series = {}
    for message in bag.joints:
        if len(message.position) not in (0, len(message.name)):
            raise ValueError(f"{options.joints} at {stamp_of(message.header):.3f} s: {len(message.name)} names and "
                             f"{len(message.position)} positions; expected equally many")
        for name, position in zip(message.name, message.position):
            if np.isfinite(position):
                series.setdefault(name, []).append((stamp_of(message.header, first_ns), position))
    return {name: np.array(sorted(values, key=lambda value: value[0])).T for name, values in series.items()}


def check_limits(bag, name, joint, positions):
    if joint.kind == "continuous" or joint.upper <= joint.lower:
        return
    beyond = max(joint.lower - positions.min(), positions.max() - joint.upper)
    told = (f"joint {name}: from {positions.min():.6g} to {positions.max():.6g} in the bag; "
            f"expected {joint.lower:g} to {joint.upper:g} {joint.unit}, the URDF's limits")
    # From where on distance_node refuses it: no robot is built so.
    if beyond > (6.3 if joint.turns else 1):
        raise ValueError(f"{told}: is it in {'degrees' if joint.turns else 'mm'}?")
    if beyond > joint.slack:
        bag.notes.append(told)


def way_of(name, joint, times, positions, first_ns):
    """Times, and positions without whole turns between them."""
    steps, apart = np.diff(positions), np.diff(times)
    if joint.turns:
        shorter = (steps + np.pi) % (2 * np.pi) - np.pi
        # Some drivers tell 181 degrees as -179 of a joint with limits, too.
        wraps = (joint.kind == "continuous") | (joint.jumps(steps, apart) & (abs(steps) > np.pi))
        steps = np.where(wraps, shorter, steps)
    jumps = np.flatnonzero(joint.jumps(steps, apart))
    if jumps.size:
        i = jumps[0]
        raise ValueError(f"joint {name}: jumps from {positions[i]:.6g} at {first_ns * 1e-9 + times[i]:.3f} s by {steps[i]:.6g} "
                         f"{joint.unit} in {apart[i]:.3g} s, the first of {jumps.size} jumps; expected at most "
                         f"{joint.most_speed:g} {joint.unit}/s, and not there and back at once: perhaps two nodes publish "
                         f"it, or a driver sends 0 at first")
    kept = np.flatnonzero(np.diff(times, prepend=-np.inf) > 0)
    return times[kept], (positions[0] + np.concatenate([[0], np.cumsum(steps)]))[kept]


def parse_urdf(text):
    try:
        return ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ValueError(f"the URDF: {error}; expected XML") from error


def write_scene(bag, options, write_png):
    if options.urdf:
        urdf = pathlib.Path(options.urdf).read_bytes()
    elif bag.description:
        urdf = bag.description
    else:
        raise ValueError(f"{options.bag}: no /robot_description; expected --urdf")
    headers = [image.header for images in bag.images.values() for image in images]
    if not headers:
        raise ValueError(f"{options.bag}: no depth image of {', '.join(options.camera)}")
    first_ns = min(header.stamp.sec * 10**9 + header.stamp.nanosec for header in headers)
    robot = parse_urdf(urdf)
    links = [link.get("name") for link in robot.findall("link")]
    for link in options.environment_link:
        if link not in links:
            raise ValueError(f"--environment-link {link}: no link of the robot; expected one of {', '.join(links)}")
    names, rows = joint_rows(bag, options, joints_of(robot), first_ns)
    cameras = [camera_entry(bag, options, name, links, first_ns) for name in options.camera]
    pngs = {name: [depth_of(name, image) for image in bag.images[name]] for name in options.camera}
    # All is known to be right: now it is written, and has its name once it is whole.
    out = pathlib.Path(options.out + ".part")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    for name in options.camera:
        (out / name).mkdir()
        for i, numbers in enumerate(pngs[name]):
            write_png(str(out / name / f"{i:06}.png"), numbers)
        (out / f"{name}_info.yaml").write_text(yaml.safe_dump(bag.infos[name], sort_keys=False, default_flow_style=None))
    header = "time," + ",".join(names)
    np.savetxt(out / "joints.csv", rows, delimiter=",", header=header, comments="", fmt="%.9f")
    robot = {"urdf": os.path.relpath(options.urdf, options.out)} if options.urdf else {"urdf": "robot.urdf"}
    if options.environment_link:
        robot["environment_links"] = options.environment_link
    if not options.urdf:
        (out / "robot.urdf").write_text(urdf, encoding="utf-8")
    scene = {"robot": robot, "cameras": cameras, "joints": "joints.csv"}
    if options.fixed_joint:
        scene["fixed_joints"] = options.fixed_joint
    text = f"# Made from {os.path.basename(os.path.normpath(options.bag))}.\n"
    (out / "scene.yaml").write_text(text + yaml.safe_dump(scene, sort_keys=False, default_flow_style=None))
    out.rename(options.out)
    return "\n".join([f"{options.out}/scene.yaml: images: {len(headers)}, cameras: {len(cameras)}, "
                      f"joint samples: {len(rows)}", *bag.notes])


def camera_entry(bag, options, name, links, first_ns):
    images = bag.images[name]
    if not images:
        raise ValueError(f"camera {name}: no image in the bag")
    if name not in bag.infos:
        raise ValueError(f"camera {name}: no camera_info in the bag")
    frames = sorted({image.header.frame_id for image in images})
    if len(frames) > 1:
        raise ValueError(f"camera {name}: its images are in frames {', '.join(frames)}; expected one: two publishers?")
    parent, pose = mount_of(bag, name, frames[0], links)
    # So image_pipeline and the drivers name them: image_rect, image_rect_raw.
    is_rectified = name in options.rectified or re.search(r"(^|[/_])rect(if\w*)?([/_]|$)", options.topics[name])
    return {
        "name": name,
        "info": f"{name}_info.yaml",
        "pose": {"parent": parent, "xyz": pose[:3, 3].tolist(), "quaternion_xyzw": quaternion_of(pose[:3, :3])},
        "depth": f"{name}/*.png",
        "depth_scale": 0.001,
        **({"rectified": True} if is_rectified else {}),
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
    """As `ros2 topic echo` prints it: berth knows what counts of it. Of ROS 1 the matrices' names are large letters."""
    def numbers(key):
        return [float(x) for x in (getattr(info, key) if hasattr(info, key) else getattr(info, key.upper()))]

    roi = {key: getattr(info.roi, key) for key in ("x_offset", "y_offset", "height", "width")}
    return {
        "height": info.height, "width": info.width,
        "distortion_model": info.distortion_model, "d": numbers("d"),
        "k": numbers("k"), "r": numbers("r"), "p": numbers("p"),
        "binning_x": info.binning_x, "binning_y": info.binning_y, "roi": roi,
    }
