"""The blocks of docs/python.md, copied into an empty file; that of docs/stop.md, asked about results; the
mistakes of docs/first-stop.md, made."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from types import SimpleNamespace

import pytest

from conftest import BOXES, SOURCE


def blocks_of(page):
    return re.findall(r"<!-- snippet -->\n```python\n(.*?)```", (SOURCE / page).read_text(), re.S)


def test_the_pages_lines_run(tmp_path):
    blocks = blocks_of("docs/python.md")
    assert len(blocks) >= 3
    (tmp_path / "robot.urdf").write_text(BOXES)
    (tmp_path / "copied.py").write_text("\n".join(blocks))
    run = subprocess.run([sys.executable, "copied.py"], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert "LinkResult(arm, ok" in run.stdout and "SelfFilterSettings(tolerance_m=0.03" in run.stdout


NAN = float("nan")


def link(bound_m, known_m=NAN, status="ok", is_moved=True):
    return SimpleNamespace(is_moved=is_moved, status=SimpleNamespace(name=status), lower_bound_m=bound_m, known=SimpleNamespace(lower_bound_m=known_m))


@pytest.mark.parametrize("status, links, expected", [
    ("ok", [link(0.2), link(0.11, 0.5)], True),
    ("ok", [link(0.2), link(0.1)], False),
    ("ok", [link(0.2, 0.1)], False),
    ("ok", [link(0.05, is_moved=False), link(1.0, status="none_in_range")], True),
    ("ok", [link(NAN)], False),
    ("ok", [link(1.0, status="not_seen")], False),
    ("ok", [link(1.0, status="not_observed")], False),
    ("degraded", [link(1.0)], False),
    ("stale", [link(NAN, status="stale")], False),
])
def test_the_function_that_stops_goes_on_only_where_all_is_known_to_be_far(status, links, expected):
    names = {}
    exec(blocks_of("docs/stop.md")[0], names)
    assert names["may_go_on"](SimpleNamespace(status=SimpleNamespace(name=status), links=links), 0.1) is expected


def test_it_takes_results(bundled):
    names = {}
    exec(blocks_of("docs/stop.md")[0], names)
    results = [step.result for step, _ in zip(bundled, range(12))]
    assert not names["may_go_on"](results[0], 0.0), "a camera has no image yet"
    assert names["may_go_on"](results[-1], 0.01) and not names["may_go_on"](results[-1], 0.2)


# What the row of docs/first-stop.md begins with, and the change in the bundled scene. The row of stamps needs the whole run.
MISTAKES = {
    "first camera: `depth_scale": ("depth_scale: 0.001", "depth_scale: 0.01"),
    "first camera: `xyz: [120": ("[0.120, -2.250, 0.800]", "[120, -2250, 800]"),
    "first camera: `xyz` 10 cm": ("[0.120, -2.250, 0.800]", "[0.220, -2.250, 0.800]"),
    "`joints.csv` in degrees": None,
    "`range_m: 1,5`": ("range_m: 1.0", "range_m: 1,5"),
    "`environment_links": ("environment_links: [table]", "environment_links: [tabel]"),
    "`rang_m`": ("range_m", "rang_m"),
}


@pytest.fixture
def cell(tmp_path):
    return pathlib.Path(shutil.copytree(SOURCE / "data/bundled", tmp_path / "cell"))


def said_of(cell, frame):
    run = subprocess.run([os.environ["BERTH"], "run", "scene.yaml", "--frame", str(frame)], cwd=cell, capture_output=True, text=True)
    return run.stdout + run.stderr


def expect_quotes(text, said):
    for quote in re.findall(r"`([^`]* [^`]*)`", text):
        for part in quote.split(" …")[0:1] + quote.split("… ")[1:]:
            assert part.strip() in said, said


@pytest.mark.parametrize("row", MISTAKES)
def test_a_mistake_is_told_as_the_page_says(row, cell):
    page = (SOURCE / "docs/first-stop.md").read_text()
    told, = re.findall(r"^\| " + re.escape(row) + r"[^|]*\| ([^|]*) \|$", page, re.M)
    if MISTAKES[row]:
        scene = cell / "scene.yaml"
        scene.write_text(scene.read_text().replace(*MISTAKES[row], 1))
    else:
        header, *rows = (cell / "joints.csv").read_text().splitlines()
        degrees = [",".join([r.split(",")[0], *(str(57.2958 * float(q)) for q in r.split(",")[1:])]) for r in rows]
        (cell / "joints.csv").write_text("\n".join([header, *degrees]) + "\n")
    expect_quotes(told, said_of(cell, 0))


def test_the_first_stop_is_that_of_the_page(cell):
    page = (SOURCE / "docs/first-stop.md").read_text()
    refused, stop = (block for language, block in re.findall(r"^```(\w*)\n(.*?)^```$", page, re.M | re.S) if not language)
    text = (cell / "scene.yaml").read_text()
    (cell / "scene.yaml").write_text(text + "separation: {}\n")
    assert refused.split(" …")[0] in said_of(cell, 48)
    (cell / "scene.yaml").write_text(text + re.search(r"`(separation: {no_reading[^`]*)`", page)[1] + "\n")
    assert stop.strip() in said_of(cell, 48)
