"""The JSON Schemas of data/schema against what berth reads and writes. The reader of scenes is asked by open_scene()."""
import copy
import functools
import json
import os
import re
import subprocess

import numpy as np
import pytest
import yaml
from conftest import BOXES, SOURCE, thinned
from jsonschema import Draft202012Validator

import berth
import berth.io

NAMES = ("scene", "result", "calibration")
BERTH = os.environ["BERTH"]


def run(*arguments):
    done = subprocess.run([BERTH, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def lines(*arguments):
    return [json.loads(line) for line in run(*arguments).splitlines()]


@functools.lru_cache
def validator(name):
    return Draft202012Validator(json.loads((SOURCE / f"data/schema/{name}.json").read_text()))


def why_not(name, value):
    return [f"{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in validator(name).iter_errors(value)]


@pytest.mark.parametrize("name", NAMES)
def test_the_files_are_what_berth_tells(name):
    file = SOURCE / f"data/schema/{name}.json"
    assert file.read_text() == run("schema", name), f"berth schema {name} >data/schema/{name}.json makes it anew"
    Draft202012Validator.check_schema(json.loads(file.read_text()))


def test_bundled_scenes_and_the_documents_examples_are_scenes():
    scenes = [file.read_text() for file in (SOURCE / "data/bundled").glob("*.yaml") if not file.name.startswith("camera_info")]
    assert len(scenes) == 2 and all(text.startswith("# yaml-language-server: $schema=../schema/scene.json\n") for text in scenes)
    examples = re.findall(r"<!-- example: .*? -->\n```yaml\n(.*?)```", (SOURCE / "docs/scene.md").read_text(), re.S)
    assert len(examples) == 3
    for text in scenes + examples:
        assert why_not("scene", yaml.safe_load(text)) == []


def test_a_new_scene_is_one_and_names_its_schema(tmp_path):
    (tmp_path / "robot.urdf").write_text(BOXES)
    run("init", tmp_path / "robot.urdf", "--out", tmp_path / "scene.yaml")
    text = (tmp_path / "scene.yaml").read_text()
    schema = re.match(r"# yaml-language-server: \$schema=(.*)\n", text)[1]
    assert json.loads(open(schema).read())["$id"] == "urn:berth:scene"
    assert why_not("scene", yaml.safe_load(text)) == []


# Scenes: each key and each value, by the schema and by the reader.

LEAST = {"robot": {"urdf": "robot.urdf"},
         "cameras": [{"name": "camera", "info": "info.yaml", "depth": ["0.png"],
                      "pose": {"parent": "base_link", "xyz": [2.0, 0.0, 0.5], "rpy": [-1.5708, 0.0, 1.5708]}}],
         "joints": "joints.csv", "separation": {}}
# What is put there, so that each map of a scene is there to be changed.
PARTS = {"attached": [{"link": "arm", "box": [0.1, 0.1, 0.1], "pose": {"xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}}],
         "separation": {"stopping": [{"speed_m_s": 1.0, "time_s": 0.1, "distance_m": 0.1}]}}
MAPS = ["", "robot", "cameras.0", "cameras.0.pose", "cameras.0.self_filter", "attached.0", "attached.0.pose", "self_filter", "sensor",
        "space", "watch", "evaluation", "time", "separation", "separation.stopping.0"]
VALUES = [-10**9, -1.5, -1, 0, 0.5, 1, 2, 7, 101, 10**9, True, "word", {}, [], [0.5], [0.5, 0.5], [0.5, 0.5, 0.5], [0.5, -1, 0.5],
          [0.5, 0.5, "x"], [0.5, 0.5, 0.5, 0.5], ["word"], {"word": 0.5}, {"word": -0.5}, {"word": "x"}]


@pytest.fixture(scope="module")
def refusal(tmp_path_factory):
    """What the reader says of a scene; empty where it takes it."""
    folder = tmp_path_factory.mktemp("scene")
    (folder / "robot.urdf").write_text(BOXES)
    (folder / "joints.csv").write_text("time,a\n0,0\n1,0\n")
    (folder / "info.yaml").write_text(yaml.safe_dump({
        "image_width": 32, "image_height": 24, "camera_matrix": {"data": [30, 0, 16, 0, 30, 12, 0, 0, 1]},
        "distortion_model": "plumb_bob", "distortion_coefficients": {"data": [0] * 5}}))
    berth.io.write_depth(str(folder / "0.png"), np.full((24, 32), 1.5, np.float32))

    def ask(scene):
        (folder / "scene.yaml").write_text(yaml.safe_dump(scene, default_flow_style=None))
        try:
            berth.open_scene(folder / "scene.yaml")
        except (RuntimeError, ValueError, OSError) as error:
            return str(error)
        return ""
    return ask


def scene_with_all_maps():
    scene = {**copy.deepcopy(LEAST), **copy.deepcopy(PARTS)}
    for group in ("self_filter", "sensor", "space", "watch", "evaluation", "time"):
        scene[group] = {}
    scene["cameras"][0]["self_filter"] = {}
    return scene


def at(value, path):
    for step in filter(None, path.split(".")):
        value = value[int(step) if step.isdigit() else step]
    return value


def schema_at(path):
    schema = root = validator("scene").schema
    for step in filter(None, path.split(".")):
        schema = schema["items"] if step.isdigit() else schema["properties"][step]
        if "$ref" in schema:
            schema = root["$defs"][schema["$ref"].split("/")[-1]]
    return schema


def test_the_scene_that_is_changed_is_one(refusal):
    assert why_not("scene", scene_with_all_maps()) == [] and refusal(scene_with_all_maps()) == ""


@pytest.mark.parametrize("path", MAPS)
def test_the_reader_knows_the_schemas_keys_and_no_others(path, refusal):
    scene = scene_with_all_maps()
    at(scene, path)["no_key"] = 1
    message = refusal(scene)
    nearest, others = re.search(r"unknown key; expected (\w+) \(the nearest\), or another of (.*)", message).groups()
    properties = schema_at(path)["properties"]
    assert set(others.split(", ")) == {key for key, value in properties.items() if not value.get("deprecated")}
    assert why_not("scene", scene) != []


@pytest.mark.parametrize("path", MAPS)
def test_the_reader_and_the_schema_want_the_same_keys(path, refusal):
    for key in list(at(scene_with_all_maps(), path)):
        scene = scene_with_all_maps()
        del at(scene, path)[key]
        assert bool(why_not("scene", scene)) == bool(refusal(scene)), (path, key, refusal(scene))


def hangs_on_more(key, value):
    """Whether the reader looks at more than a schema can: as many stamps as images, a quaternion of length 1."""
    return key in ("stamps", "quaternion_xyzw") and isinstance(value, list)


@pytest.mark.parametrize("path", MAPS)
def test_the_reader_and_the_schema_take_the_same_values(path, refusal):
    looked_at = 0
    for key, schema in schema_at(path)["properties"].items():
        if schema.get("deprecated") or "$ref" in schema:
            continue
        edges = [schema[word] for word in ("minimum", "maximum", "exclusiveMinimum") if word in schema]
        values = VALUES + schema.get("enum", []) + edges + [edge + step for edge in edges for step in (-1e-3, 1e-3)]
        for value in values:
            # A text may look like a number or a truth to YAML, and names a file or a link that has to be there.
            if '"string"' in json.dumps(schema) and value not in ([], {}, ["word"], {"word": "x"}) or hangs_on_more(key, value):
                continue
            scene = scene_with_all_maps()
            if key == "quaternion_xyzw":
                del at(scene, path)["rpy"]
            at(scene, path)[key] = value
            where = f"{path}.{key}".lstrip(".")
            place = re.escape(re.sub(r"\.(\d+)", r"[\1]", where))
            by_reader = re.search(rf"scene\.yaml:\d+: {place}\b", refusal(scene))
            by_schema = [told for told in why_not("scene", scene) if told.startswith(where.replace(".", "/"))]
            assert bool(by_schema) == bool(by_reader), (where, value, by_schema, refusal(scene))
            looked_at += 1
    assert looked_at > 0


# Results and calibrations: what berth writes is valid, and what differs from it is not.

@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Lines of all kinds: of several cameras with a monitor, stale ones, of images with times, of three images alone."""
    folder = tmp_path_factory.mktemp("results")
    one = thinned(folder, "one_camera.yaml", "one.yaml", 12)
    run("filter", one, "--out", folder / "images")
    images = [f"--{name.replace('_', '-')}={folder}/images/{name}_000000.png" for name in ("robot_depth", "link_ids", "obstacle_depth")]
    json_of = lambda *arguments: lines(*arguments, "--format", "json")
    found = json_of("run", thinned(folder, "scene.yaml", "monitored.yaml", 12, separation={"no_reading": "ignore"}))
    found += json_of("run", thinned(folder, "scene.yaml", "late.yaml", 12, last_stamp_s=9.0))
    found += json_of("run", one, "--visibility", "on", "--candidates", 2, "--gradient", "on") + json_of("run", one, "--repeat", 2)
    found += json_of("evaluate", one)
    return found + json_of("evaluate", f"--camera={SOURCE}/data/bundled/camera_info.yaml", *images, "--repeat", 2)


def test_results_are_valid_and_each_field_is_in_one(results):
    check = validator("result")
    assert {line["status"] for line in results} >= {"ok", "stale"}
    for line in results:
        assert check.is_valid(line), why_not("result", line)[:3]
    schema = check.schema["properties"]
    assert set(schema) - {"gl_renderer"} == {key for line in results for key in line}
    assert set(schema["links"]["items"]["properties"]) == {key for line in results for link in line["links"] for key in link}


def changed(value, path=()):
    """The value with a single thing wrong: a field less, a field more, one of another kind."""
    if isinstance(value, dict):
        yield (*path, "no_field"), {**value, "no_field": 1}
        for key, part in value.items():
            yield (*path, "without", key), {k: v for k, v in value.items() if k != key}
            for place, wrong in changed(part, (*path, key)):
                yield place, {**value, key: wrong}
    elif isinstance(value, list) and value:
        for place, wrong in changed(value[0], (*path, 0)):
            yield place, [wrong, *value[1:]]
    elif not isinstance(value, list):
        yield path, [value]


def test_what_differs_from_a_result_is_none(results):
    check = validator("result")
    # Fields that not every line has.
    free = {"pairs", "separation", "timing", "robot_point_camera_m", "obstacle_point_camera_m", "mean_direction_camera", "robot_pixel",
            "robot_pixels", "visibility", "known", "candidates", "gradient"}
    for line in (results[0], results[-1]):
        assert sum(1 for place, _ in changed(line)) > 40
        for place, wrong in changed(line):
            assert check.is_valid(wrong) == (place[-2:-1] == ("without",) and place[-1] in free), place


def test_calibrations_are_valid_and_what_differs_is_none(tmp_path):
    check = validator("calibration")
    told = lines("calibrate", thinned(tmp_path, "one_camera.yaml", "scene.yaml", 6), "--out", tmp_path / "new.yaml", "--format", "json",
                 "--joint-zeros")[0]
    assert why_not("calibration", told) == []
    assert set(check.schema["properties"]) == set(told)
    free = {"tolerance_m", "surface_tolerance_m", "padding_m", "speckle_px", *told["joint_offsets"]}
    for place, wrong in changed(told):
        if place[0] == "joint_offsets" and place[-1] == "no_field":
            continue  # a joint of any name
        assert check.is_valid(wrong) == (place[-2:-1] == ("without",) and place[-1] in free), place
    assert why_not("scene", yaml.safe_load((tmp_path / "new.yaml").read_text())) == []
