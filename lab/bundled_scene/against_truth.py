#!/usr/bin/env python3
"""Compares what berth says of the bundled scene with its true distances: against_truth.py BERTH [SCENE].

Only results at an image of the first camera count, since the truth is of those times. Prints one line; with --list
also each reading that is more than 5 cm too small. A reading is out of date if it is not that much less than some truth
since the oldest image in use was exposed.
"""

import csv
import json
import pathlib
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "data/bundled"
RANGE_M = 1.0


def truth():
    with open(FOLDER / "truth.csv") as rows:
        return {(int(row["frame"]), row["link"]): min(RANGE_M, float(row["whole_m"])) for row in csv.DictReader(rows)}


def results(berth, scene):
    lines = subprocess.run([berth, "run", scene, "--format", "json"], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in lines.splitlines()]


def in_range(pair):
    return RANGE_M if pair["distance_m"] is None else pair["distance_m"]


def main(berth, scene=FOLDER / "scene.yaml"):
    true_m = truth()
    count = dict.fromkeys(["links", "readings > 5 cm too small", "of these out of date", "readings > 1 cm too large", "> 2 cm too large", "< 1 cm though > 5 cm"], 0)
    small = []
    stamps_s = {}
    for result in results(berth, scene):
        first = result["cameras"][0]
        if first["stamp_s"] != result["stamp_s"]:
            continue
        stamps_s[first["frame"]] = first["stamp_s"]
        oldest_s = min(camera["stamp_s"] for camera in result["cameras"] if camera["stamp_s"] is not None)
        since = [frame for frame, stamp_s in stamps_s.items() if not any(stamp_s < later_s <= oldest_s for later_s in stamps_s.values())]
        for link in result["links"]:
            true = true_m[first["frame"], link["link"]]
            over_m = in_range(link["occupied"]) - true
            count["links"] += 1
            count["readings > 5 cm too small"] += over_m < -0.05
            count["readings > 1 cm too large"] += over_m > 0.01
            count["> 2 cm too large"] += in_range(link) > true + 0.02
            count["< 1 cm though > 5 cm"] += in_range(link) < 0.01 and true > 0.05
            if over_m < -0.05:
                was_m = min(true_m[frame, link["link"]] for frame in since)
                count["of these out of date"] += in_range(link["occupied"]) >= was_m - 0.05
                small.append((over_m, first["frame"], link["link"], link["occupied"]["camera"], link["occupied"]["obstacle_pixel"]))
    print(", ".join(f"{name}: {number}" for name, number in count.items()))
    return sorted(small, key=lambda row: row[0])


if __name__ == "__main__":
    arguments = [argument for argument in sys.argv[1:] if argument != "--list"]
    too_small = main(*arguments)
    if "--list" in sys.argv:
        for over_m, *rest in too_small:
            print(f"{over_m:+.3f} m", *rest)
