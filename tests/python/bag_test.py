"""Messages of bags, made here, become scenes or are refused with their cause."""
import math
import struct
import zlib
from types import SimpleNamespace as N

import numpy as np
import pytest
import yaml

import berth
import berth.io
from berth.bag_scene import BagOptions, bag_to_scene, depth_of
from conftest import BOX

LINKS = "".join(f'<link name="{name}">{BOX}</link>' for name in ("base", "arm", "tip", "finger", "thumb", "tray"))
URDF = f"""<robot name="boxes">{LINKS}
<joint name="lift" type="prismatic"><parent link="base"/><child link="arm"/><limit lower="0" upper="0.5" effort="1" velocity="0.2"/></joint>
<joint name="wrist" type="continuous"><parent link="arm"/><child link="tip"/></joint>
<joint name="bend" type="revolute"><parent link="tip"/><child link="finger"/><limit lower="-3.1" upper="3.1" effort="1" velocity="2"/></joint>
<joint name="slide" type="prismatic"><parent link="base"/><child link="tray"/><limit lower="-1" upper="1" effort="0" velocity="0"/></joint>
<joint name="copy" type="revolute"><parent link="tip"/><child link="thumb"/><mimic joint="bend"/>
<limit lower="-3.1" upper="3.1" effort="1" velocity="2"/></joint></robot>"""
IMAGE = np.arange(500, 500 + 48 * 64, dtype="<u2").reshape(48, 64)
PNG = b"\x89PNG\r\n\x1a\n"


def header(t, frame=""):
    ns = round((1000 + t) * 1e9)
    return N(stamp=N(sec=ns // 10**9, nanosec=ns % 10**9), frame_id=frame)


def image(t, numbers=IMAGE, encoding="16UC1", frame="optical", is_bigendian=0):
    return N(header=header(t, frame), width=numbers.shape[1], height=numbers.shape[0], step=numbers.shape[1] * numbers.itemsize,
             encoding=encoding, is_bigendian=is_bigendian, data=numbers.tobytes())


def compressed(data, form):
    return N(header=header(0.1, "optical"), format=form, data=data)


def info(t=0, **changed):
    fields = {"height": 48, "width": 64, "distortion_model": "plumb_bob", "d": [0.0] * 5, "k": [60.0, 0.0, 31.0, 0.0, 61.0, 23.0, 0.0, 0.0, 1.0],
              "r": np.eye(3).ravel(), "p": [70.0, 0.0, 32.0, 0.0, 0.0, 71.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0], "binning_x": 0, "binning_y": 0,
              "roi": N(x_offset=0, y_offset=0, height=0, width=0, do_rectify=False)}
    return N(header=header(t), **{**fields, **changed})


def transform(child, parent, x=0.0, turn=0.0):  # above the robot, so that it sees nothing of it
    rotation = N(x=0.0, y=0.0, z=math.sin(turn / 2), w=math.cos(turn / 2))
    return N(transforms=[N(header=header(0, parent), child_frame_id=child, transform=N(translation=N(x=x, y=0.0, z=5.0), rotation=rotation))])


def joints(t, **positions):
    return N(header=header(t), name=list(positions), position=list(positions.values()))


REST = {"lift": 0.1, "wrist": 0.0, "bend": 0.0, "slide": 0.0}


def moved(name, samples):
    """One joint at these (time, position), and the others at rest beside it."""
    rest = {other: position for other, position in REST.items() if other != name}
    return [("/joint_states", joints(t, **{name: position}, **rest)) for t, position in samples]


STILL = moved("lift", [(0.0, 0.1), (0.1, 0.1), (0.2, 0.1)])
TF = [("/tf_static", transform("optical", "base", 0.3))]


def write(tmp_path, joint_states=STILL, tf=TF, infos=(info(),), images=None, topic="/front/depth_image", kind="Image", **options):
    """The sentence; what is not said is as in a bag without faults."""
    messages = [("/robot_description", N(data=URDF)), *tf, *((topic.rsplit("/", 1)[0] + "/camera_info", one) for one in infos),
                *joint_states, *((topic, one) for one in images or [image(0.1)])]
    options = BagOptions(bag="bag", out=str(tmp_path / "out"), camera=["front"], topics={"front": topic}, **options)
    kinds = {topic: f"sensor_msgs/msg/{kind}", "/joint_states": "sensor_msgs/msg/JointState"}
    return bag_to_scene(options, kinds, lambda wanted: (one for one in messages if one[0] in wanted), berth.io.write_depth)


def refused(tmp_path, *words, **bag):
    with pytest.raises(ValueError) as error:
        write(tmp_path, **bag)
    for word in words:
        assert word in str(error.value)
    assert list(tmp_path.iterdir()) == []


def scene_of(tmp_path):
    return yaml.safe_load((tmp_path / "out/scene.yaml").read_text())


def rows_of(tmp_path):
    """Of each joint its positions."""
    text = (tmp_path / "out/joints.csv").read_text().splitlines()
    return dict(zip(text[0].split(","), np.loadtxt(text[1:], delimiter=",", ndmin=2).T))


# Joints

@pytest.mark.parametrize("name, before, after, apart_s, halfway", [
    ("wrist", 3.13, -3.13, 0.02, math.pi),
    ("wrist", 0.01, 2 * math.pi - 0.01, 0.02, 0),  # of a driver that tells 0 to 360 degrees
    ("wrist", 3.0, -3.0, 1.0, math.pi),
    ("wrist", 6.27, 6.29, 0.02, 6.28),  # of one that counts turns
    ("bend", 3.13, -3.13, 0.02, math.pi),  # has limits, and its driver wraps it all the same
    ("bend", -2.0, 2.0, 1.0, 0),  # goes the longer way: it has limits, and the time
])
def test_a_joint_that_turns_goes_the_right_way_round(tmp_path, name, before, after, apart_s, halfway):
    others = {other: position for other, position in REST.items() if other != name}
    states = [joints(t, **others) for t in (0, apart_s / 2, apart_s)] + [joints(0, **{name: before}), joints(apart_s, **{name: after})]
    write(tmp_path, [("/joint_states", state) for state in states], images=[image(apart_s / 2)])
    positions = rows_of(tmp_path)[name]
    assert len(positions) == 3
    assert math.remainder(positions[1] - halfway, 2 * math.pi) == pytest.approx(0, abs=1e-6)
    assert math.remainder(positions[2] - after, 2 * math.pi) == pytest.approx(0, abs=1e-6)


def test_messages_that_come_late_are_sorted(tmp_path):
    write(tmp_path, moved("bend", [(0, 0.0), (0.2, 0.2), (0.1, 0.1)]))
    assert rows_of(tmp_path)["bend"] == pytest.approx([0, 0.1, 0.2])


def test_only_joints_that_move_by_themselves_have_columns(tmp_path):
    states = [("/joint_states", joints(t, gone=1.0, copy=0.0, **REST)) for t in (0.0, 0.1, 0.2)]
    said = write(tmp_path, states)
    assert list(rows_of(tmp_path)) == ["time", "lift", "wrist", "bend", "slide"]
    assert "left out gone, copy" in said
    assert berth.open_scene(tmp_path / "out/scene.yaml").robot.model.joint_names == ["lift", "wrist", "bend", "slide"]


def test_a_joint_that_nobody_tells_is_named_or_given(tmp_path):
    told = [("/joint_states", joints(t, lift=0.1, wrist=0.0, slide=0.0)) for t in (0.0, 0.1, 0.2)]
    refused(tmp_path, "joint bend", "lift, wrist, slide", "--fixed-joint", joint_states=told)
    write(tmp_path, told, fixed_joint={"bend": 0.5})
    assert scene_of(tmp_path)["fixed_joints"] == {"bend": 0.5}
    step = next(iter(berth.open_scene(tmp_path / "out/scene.yaml")))
    assert step.joints == pytest.approx([0.1, 0.0, 0.5, 0.0])


def test_a_joint_that_is_given_and_told_is_the_one_given(tmp_path):
    assert "left out bend" in write(tmp_path, fixed_joint={"bend": 0.5})
    assert "bend" not in rows_of(tmp_path)


def test_no_joint_that_moves(tmp_path):
    refused(tmp_path, "no joint state", fixed_joint=REST)


def test_names_and_positions_are_equally_many(tmp_path):
    state = joints(0.1, **REST)
    state.position.pop()
    refused(tmp_path, "/joint_states at 1000.100 s: 4 names and 3 positions", joint_states=[*STILL, ("/joint_states", state)])
    state.position = []  # tells velocities alone
    write(tmp_path, [*STILL, ("/joint_states", state)])


def alternating(one, other, apart_s=0.01):
    return [(0.02 * k + t, position) for k in range(15) for t, position in ((0, one), (apart_s, other))]


@pytest.mark.parametrize("name, samples, said", [
    ("bend", alternating(-0.6, 0.0), "joint bend: jumps from -0.6 at 1000.000 s by 0.6 rad in 0.01 s, the first of 29 jumps; expected at most 6 rad/s"),
    ("wrist", alternating(3.0, 0.0), "expected at most 30 rad/s"),  # nothing tells how fast it is
    ("lift", alternating(0.04, 0.0), "joint lift: jumps from 0.04 at 1000.000 s by -0.04 m"),
    ("bend", alternating(0.3, 0.25, 0.005), "joint bend"),  # small steps, but there and back
    ("bend", alternating(0.3, 0.28), "joint bend"),
    ("lift", alternating(0.3, 0.295), "joint lift"),
    ("bend", alternating(0.3, 0.0, 0.0), "joint bend"),  # of one stamp
    ("slide", [(0, 0.0), (0.1, 0.0), (0.105, 0.04), (0.2, 0.04)], "expected at most 5 m/s"),  # nothing tells how fast it is
    ("bend", [(0, 0.0), (0.1, 0.0), (0.11, 0.9), (0.2, 0.9)], "joint bend: jumps from 0 at 1000.100 s by 0.9 rad in 0.01 s, the first of 1 jumps"),
    # The clock of the second one is 0.1 s ahead: all of the first one is late.
    ("bend", [(0.02 * k + late, position) for k in range(15) for late, position in ((0, -0.6), (0.105, 0.0))], "joint bend"),
])
def test_a_joint_that_no_robot_moves_so_fast_is_refused(tmp_path, name, samples, said):
    refused(tmp_path, said, "two nodes publish", joint_states=moved(name, samples))


def jittering(speed, period_s):
    """Stamps up to 0.9 of the period late."""
    late = np.random.default_rng(1).uniform(0, 0.9 * period_s, 60)
    return [(k * period_s + late[k], speed * k * period_s) for k in range(60)]


@pytest.mark.parametrize("name, samples", [
    ("bend", jittering(2, 0.01)),
    ("bend", jittering(1, 0.05)),
    ("lift", jittering(0.2, 0.02)),
    ("bend", [(0.001 * k, 0.004 * (k % 2)) for k in range(200)]),  # noise of a coarse encoder
    ("bend", [(0.0, 0.0), (0.1, 0.0), (0.1, 0.0), (0.2, 0.0)]),  # told twice
    ("bend", [(0.0, 0.0), (0.1, 0.0), (0.105, 0.02), (0.11, 0.0), (0.2, 0.0)]),  # hits on something
])
def test_a_robot_at_full_speed_whose_stamps_are_late_is_none(tmp_path, name, samples):
    write(tmp_path, moved(name, samples))


def test_a_joint_beyond_its_limits(tmp_path):
    refused(tmp_path, "joint lift: from 50 to 50", "expected 0 to 0.5 m", "mm?", joint_states=moved("lift", [(0, 50.0), (0.1, 50.0), (0.2, 50.0)]))
    refused(tmp_path, "joint bend: from 20 to 20", "degrees?", joint_states=moved("bend", [(0, 20.0), (0.1, 20.0), (0.2, 20.0)]))
    said = write(tmp_path, moved("lift", [(0, 0.52), (0.1, 0.52), (0.2, 0.52)]))
    assert "joint lift: from 0.52 to 0.52 in the bag; expected 0 to 0.5 m" in said
    assert "joint bend" not in said


def test_a_limit_of_the_urdf_that_is_no_number_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(globals(), "URDF", URDF.replace('upper="0.5"', 'upper="much"'))
    refused(tmp_path, "joint lift", "much")


# Where the camera is

@pytest.mark.parametrize("tf", [
    [*TF, ("/tf_static", transform("optical", "base", 0.25))],
    [*TF, ("/tf_static", transform("optical", "base", 0.3, turn=0.01))],
    [*TF, ("/tf_static", transform("optical", "tip", 0.3))],
    [*TF, ("/tf", transform("optical", "base", 0.31))],
    [("/tf_static", transform("optical", "rail", 0.3)), *(("/tf", transform("rail", "base", 0.1 * k)) for k in range(3))],
])
def test_a_camera_that_is_in_two_places_is_refused(tmp_path, tf):
    refused(tmp_path, "camera front", "two transforms of frame", "in base", tf=tf)


@pytest.mark.parametrize("tf, parent, xyz", [
    ([*TF, ("/tf_static", transform("optical", "base", 0.3 + 1e-4, turn=1e-3))], "base", [0.3, 0, 5]),
    # What is not between the camera and the robot may move.
    ([*TF, ("/tf", transform("cart", "base", 0.1)), ("/tf", transform("cart", "base", 0.2))], "base", [0.3, 0, 5]),
    ([("/tf", transform("optical", "rail", 0.3)), ("/tf", transform("rail", "tip", 0.1))], "tip", [0.4, 0, 10]),
])
def test_a_camera_that_stays_is_taken(tmp_path, tf, parent, xyz):
    write(tmp_path, tf=tf)
    pose = scene_of(tmp_path)["cameras"][0]["pose"]
    assert pose["parent"] == parent and pose["xyz"] == pytest.approx(xyz)


def test_a_frame_that_is_a_link_of_the_robot_moves_with_it(tmp_path):
    moving = [("/tf", transform("tip", "arm", turn=0.1 * k)) for k in range(3)]
    write(tmp_path, tf=moving, images=[image(0.1, frame="tip")])
    pose = scene_of(tmp_path)["cameras"][0]["pose"]
    assert pose["parent"] == "tip" and pose["xyz"] == [0, 0, 0]


def test_transforms_that_lead_nowhere_are_named(tmp_path):
    refused(tmp_path, "camera front", "optical", tf=[("/tf_static", transform("optical", "a")), ("/tf_static", transform("a", "optical"))])
    nothing = transform("optical", "base")
    nothing.transforms[0].transform.rotation.w = 0.0
    refused(tmp_path, "frame optical", "no pose", tf=[("/tf_static", nothing)])


def test_images_of_two_frames_are_refused(tmp_path):
    refused(tmp_path, "camera front", "left, optical", images=[image(0.1), image(0.15, frame="left")])


# camera_info

def test_camera_info_is_kept_as_it_is(tmp_path):
    write(tmp_path, infos=[info(0), info(0.1)])
    assert yaml.safe_load((tmp_path / "out/front_info.yaml").read_text()) == {
        "height": 48, "width": 64, "distortion_model": "plumb_bob", "d": [0.0] * 5,
        "k": [60.0, 0.0, 31.0, 0.0, 61.0, 23.0, 0.0, 0.0, 1.0], "r": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "p": [70.0, 0.0, 32.0, 0.0, 0.0, 71.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0], "binning_x": 0, "binning_y": 0,
        "roi": {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0}}
    camera = berth.open_scene(tmp_path / "out/scene.yaml").views[0].camera
    assert (camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px) == (70, 71, 32, 24)


def test_an_image_that_was_cut_and_binned(tmp_path):
    """The sensor has 160 x 120 pixels, of which 128 x 96 were taken, two by two."""
    roi = N(x_offset=16, y_offset=8, height=96, width=128, do_rectify=False)
    write(tmp_path, infos=[info(width=160, height=120, binning_x=2, binning_y=2, roi=roi)])
    camera = berth.open_scene(tmp_path / "out/scene.yaml").views[0].camera
    assert (camera.width_px, camera.fx_px, camera.cx_px, camera.cy_px) == (64, 35, 8, 8)


def test_matrices_of_ros_1_have_large_letters(tmp_path):
    old = info()
    old.D, old.K, old.R, old.P = (old.__dict__.pop(key) for key in "dkrp")
    write(tmp_path, infos=[old])
    assert yaml.safe_load((tmp_path / "out/front_info.yaml").read_text())["p"][0] == 70


@pytest.mark.parametrize("changed, said", [
    ({"k": [61.0, 0.0, 31.0, 0.0, 61.0, 23.0, 0.0, 0.0, 1.0]}, "k from [60.0"),
    ({"p": [0.0] * 12}, "p from [70.0"),
    ({"d": [0.1, 0.0, 0.0, 0.0, 0.0]}, "d from [0.0"),
    ({"width": 320}, "width from 64 to 320"),
    ({"binning_x": 2}, "binning_x from 0 to 2"),
])
def test_camera_info_that_changes_is_refused(tmp_path, changed, said):
    refused(tmp_path, "camera front: camera_info changes at 1000.200 s: " + said, infos=[info(0), info(0.2, **changed)])


@pytest.mark.parametrize("topic, is_rectified", [
    ("/front/depth/image_rect_raw", True), ("/front/image_rect", True), ("/rectified/depth", True), ("/front/depth_rect", True),
    ("/front/depth_image", False), ("/front/image_raw", False), ("/front/corrected", False), ("/direct/depth", False),
])
def test_a_rectified_topic_is_known_by_its_name(tmp_path, topic, is_rectified):
    write(tmp_path, topic=topic)
    assert scene_of(tmp_path)["cameras"][0].get("rectified", False) == is_rectified


def test_of_a_rectified_image_p_counts(tmp_path):
    write(tmp_path, infos=[info(d=[-0.2, 0.05, 0.0, 0.0, 0.0])], rectified=["front"])
    assert berth.open_scene(tmp_path / "out/scene.yaml").views[0].camera.fx_px == 70


def test_an_unknown_camera_is_named(tmp_path):
    refused(tmp_path, "--rectified left", "front", rectified=["left"])


# Images

def pixels(one):
    return depth_of("front", one)


@pytest.mark.parametrize("is_bigendian, order", [(0, "<"), (1, ">")])
def test_bytes_of_either_order(is_bigendian, order):
    for encoding in ("16UC1", "mono16"):
        np.testing.assert_array_equal(pixels(image(0.1, IMAGE.astype(order + "u2"), encoding, is_bigendian=is_bigendian)), IMAGE)
    metres = (IMAGE * 0.001).astype(order + "f4")
    np.testing.assert_array_equal(pixels(image(0.1, metres, "32FC1", is_bigendian=is_bigendian)), IMAGE)


def test_what_is_no_reading_of_metres_is_0():
    metres = np.full((8, 8), 1.5, "<f4")
    none = [math.nan, math.inf, -math.inf, 0.0, -1.0, np.finfo("f4").max, 1e6, 65.535, 100.0, 1e-38]
    metres.ravel()[:10] = none
    assert pixels(image(0.1, metres, "32FC1")).ravel().tolist() == [0] * 10 + [1500] * 54
    assert pixels(image(0.1, np.full((2, 2), 65.5, "<f4"), "32FC1"))[0, 0] == 65500
    # An image of marks alone, and one of a long way, are none in millimetres.
    assert not pixels(image(0.1, np.full((48, 64), np.finfo("f4").max, "<f4"), "32FC1")).any()
    pixels(image(0.1, np.linspace(5, 100, 48 * 64, dtype="<f4").reshape(48, 64), "32FC1"))


def test_float_millimetres_are_refused():
    with pytest.raises(ValueError, match="camera front: image of 1000.100 s: 32FC1 with numbers such as .*; expected metres"):
        pixels(image(0.1, IMAGE.astype("<f4"), "32FC1"))


@pytest.mark.parametrize("changed, said", [({"encoding": "rgb8"}, "rgb8"), ({"step": 100}, "rows of 100"), ({"height": 49}, "49 rows")])
def test_an_image_that_cannot_be_read_is_named(changed, said):
    one = image(0.1)
    one.__dict__.update(changed)
    with pytest.raises(ValueError, match=f"camera front: image of 1000.100 s: .*{said}"):
        pixels(one)


def filtered(raw, above, kind, size=2):
    """A row of a PNG by one of its five filters."""
    row = bytearray()
    for i, byte in enumerate(raw):
        left, up, corner = (raw[i - size], above[i], above[i - size]) if i >= size else (0, above[i], 0)
        near = min((left, up, corner), key=lambda one: abs(left + up - corner - one))
        row.append(byte - (0, left, up, (left + up) // 2, near)[kind] & 255)
    return bytes([kind]) + bytes(row)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(numbers, bits=16):
    height, width = numbers.shape
    rows = [bytes(2 * width), *(row.tobytes() for row in numbers.astype(">u2"))]
    packed = zlib.compress(b"".join(filtered(rows[y + 1], rows[y], y % 5) for y in range(height)))
    return (PNG + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0)) + chunk(b"tEXt", b"a note")
            + chunk(b"IDAT", packed[:100]) + chunk(b"IDAT", packed[100:]) + chunk(b"IEND", b""))


def rvl(numbers):
    height, width = numbers.shape
    values, before, flat = [], 0, [int(x) for x in numbers.ravel()]
    while flat:
        zeros = next((i for i, x in enumerate(flat) if x), len(flat))
        count = next((i for i, x in enumerate(flat[zeros:]) if not x), len(flat) - zeros)
        values += [zeros, count]
        for number in flat[zeros:zeros + count]:
            step, before = number - before, number
            values.append(2 * step if step >= 0 else -2 * step - 1)
        flat = flat[zeros + count:]
    groups = []
    for value in values:
        while value > 7:
            groups.append(value & 7 | 8)
            value >>= 3
        groups.append(value)
    groups += [0] * (-len(groups) % 8)
    words = [sum(group << 28 - 4 * i for i, group in enumerate(groups[at:at + 8])) for at in range(0, len(groups), 8)]
    return struct.pack("<II", width, height) + struct.pack(f"<{len(words)}I", *words)


NOISE = np.random.default_rng(2).integers(0, 65535, (23, 31)).astype("<u2")
NOISE[3:6, 4:] = NOISE[-1, -9:] = 0
NOISE[6:20] %= 4  # of which many are predicted equally well
CODED = struct.pack("<iff", 0, 10100.0, -9.1)  # as 32FC1 is coded for 1 to 1000 m


@pytest.mark.parametrize("data, form", [
    (png(NOISE), "16UC1; png compressed "), (png(NOISE), "png"),
    (CODED + png(NOISE), "16UC1; compressedDepth png"), (CODED + png(NOISE), "16UC1; compressedDepth"),
    (CODED + rvl(NOISE), "16UC1; compressedDepth rvl"),
])
def test_compressed_images(data, form):
    np.testing.assert_array_equal(pixels(compressed(data, form)), NOISE)


@pytest.mark.parametrize("code", [png, rvl])
def test_compressed_metres(code):
    metres = np.linspace(0.4, 10, 48 * 64).reshape(48, 64)
    numbers = np.floor(10100.0 / metres - 9.1).astype("<u2")
    numbers[0, :2] = 0, 65535
    form = f"32FC1; compressedDepth {code.__name__}"
    found = pixels(compressed(CODED + code(numbers), form))
    assert found[0, :2].tolist() == [0, 0]
    np.testing.assert_allclose(found.ravel()[2:], 1000 * metres.ravel()[2:], atol=11)


@pytest.mark.parametrize("data, form, said", [
    (b"\xff\xd8\xff\xe0" + bytes(100), "16UC1; jpeg compressed bgr8", "jpeg"),
    (png(NOISE, bits=8), "mono8; png compressed", "8 bits"),
    (png(NOISE)[:-200], "16UC1; png compressed", ""),
    (png(NOISE)[:10], "16UC1; png compressed", ""),
    (CODED + rvl(NOISE)[:-200], "16UC1; compressedDepth rvl", ""),
    (CODED + rvl(NOISE)[:8], "16UC1; compressedDepth rvl", ""),
    (b"", "16UC1; compressedDepth rvl", ""),
])
def test_compressed_images_that_cannot_be_read_are_named(data, form, said):
    with pytest.raises(ValueError, match=f"camera front: image of 1000.100 s: .*{said}"):
        pixels(compressed(data, form))


@pytest.mark.parametrize("topic", ["/front/depth_image/compressedDepth", "/front/depth_png"])
def test_a_compressed_topic_becomes_a_scene(tmp_path, topic):
    write(tmp_path, infos=[], tf=[*TF, ("/front/camera_info", info())], topic=topic, kind="CompressedImage",
          images=[compressed(CODED + png(IMAGE), "16UC1; compressedDepth png")])
    camera = berth.open_scene(tmp_path / "out/scene.yaml").views[0].camera
    np.testing.assert_allclose(berth.io.read_depth(str(tmp_path / "out/front/000000.png"), camera), IMAGE * 0.001, rtol=1e-6)


# berth.io

def test_import_bag_passes_on_what_it_is_told(tmp_path, monkeypatch):
    messages = [("/robot_description", N(data=URDF)), *TF, ("/left/camera_info", info()), ("/left/depth", image(0.1)),
                *(("/joint_states", joints(t, lift=0.1, wrist=0.0, slide=0.0)) for t in (0.0, 0.2))]
    kinds = {"/left/depth": "sensor_msgs/msg/Image", "/joint_states": "sensor_msgs/msg/JointState"}
    monkeypatch.setattr(berth.io, "_open_mcap", lambda bag: (kinds, lambda wanted: iter(messages)))
    said = berth.io.import_bag("a.mcap", str(tmp_path / "out"), cameras=["left"], topics={"left": "/left/depth"}, rectified=["left"],
                               fixed_joints={"bend": 0.2})
    assert "images: 1, cameras: 1, joint samples: 2" in said
    assert scene_of(tmp_path)["cameras"][0]["rectified"] and scene_of(tmp_path)["fixed_joints"] == {"bend": 0.2}
