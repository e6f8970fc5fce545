#!/usr/bin/env python3
"""What Python adds to a request and to an image, as a table.

    PYTHONPATH=build/release/python lab/bench/python_overhead.py build/release/berth data/bundled/one_camera.yaml
"""
import json
import os
import statistics
import subprocess
import sys
import time

import berth
import numpy as np

REPEAT = 200


def median_us(call):
    """Of many calls, the first ones left out."""
    times = []
    for i in range(REPEAT + 20):
        begin = time.perf_counter()
        call()
        times.append(1e6 * (time.perf_counter() - begin))
    return statistics.median(times[20:])


def ask_anew(query, frame):
    """As `berth run --repeat` asks."""
    query.forget()
    return query.ask(frame)


def ask_us(line):
    if "ask_us" in line:
        return line["ask_us"]["p50"]
    return next((found for value in line.values() if isinstance(value, dict) and (found := ask_us(value))), None)


def main(command, scene_file):
    run = subprocess.run([command, "run", scene_file, "--format", "json", "--repeat", str(REPEAT)], check=True,
                         capture_output=True, text=True)
    in_cpp = [ask_us(json.loads(line)) for line in run.stdout.splitlines()]
    scene = berth.open_scene(scene_file)
    query = berth.Query(scene.robot)
    steps = list(scene)
    in_python = [median_us(lambda: ask_anew(query, step.frame)) for step in steps]
    step = steps[0]
    result = query.ask(step.frame)
    late_s = step.frame.stamp_s + 10
    observer = berth.Observer(scene.views[0])
    zeros = np.nan_to_num(step.depth_m)
    wide = np.asfortranarray(step.depth_m)
    rows = [
        ("request, C++ (`berth run --repeat`), median over the frames", statistics.median(in_cpp)),
        ("request, Python", statistics.median(in_python)),
        ("Python's part: median of the differences, frame by frame", statistics.median(np.subtract(in_python, in_cpp))),
        ("request without a search (too old)", median_us(lambda: query.ask(step.frame, now_s=late_s))),
        ("`result.distance_m`", median_us(lambda: result.distance_m)),
        ("image to frame, float32 as it is", median_us(lambda: observer.observe(step.depth_m, step.joints))),
        ("image to frame, float32 with zeros: copied", median_us(lambda: observer.observe(zeros, step.joints))),
        ("image to frame, float32 by columns: copied", median_us(lambda: observer.observe(wide, step.joints))),
    ]
    print(f"{os.path.basename(scene_file)}, {step.depth_m.shape[1]} x {step.depth_m.shape[0]}, {len(steps)} frames, "
          f"{REPEAT} times each\n\n| | µs |\n| --- | ---: |")
    for name, value in rows:
        print(f"| {name} | {value:.1f} |")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python_overhead.py BERTH SCENE.yaml")
    main(*sys.argv[1:])
