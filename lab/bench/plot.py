#!/usr/bin/python3
"""Draws the CSV of `berth_bench` as a chart: plot.py bench.csv bench.svg

Left, the time of each method in each set of scenes: a dot at the median, a line to the greatest;
the same logarithmic scale in each. Right, the greatest error of the same rows that makes a distance
too large, the dangerous side.
"""
import csv
import sys
from collections import defaultdict

import matplotlib
matplotlib.use("svg")
matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["svg.hashsalt"] = "berth"
from matplotlib import pyplot

EXACT = "#1a7f37"
OTHERS = "#8c959f"


def read_tables(path):
    """{table: {row: {column: value}}}, in the order of the file."""
    tables = defaultdict(lambda: defaultdict(dict))
    with open(path, newline="") as file:
        for line in csv.DictReader(file):
            tables[line["table"]][line["row"]][line["column"]] = float(line["value"])
    return {name: rows for name, rows in tables.items() if "brute force" in rows}


def draw_times(axes, title, rows):
    for place, (method, row) in enumerate(rows.items()):
        colour = EXACT if method.startswith("berth") else OTHERS
        axes.plot([row["median ms"], row["max ms"]], [place, place], color=colour, linewidth=2)
        axes.plot(row["median ms"], place, "o", color=colour)
    axes.set_yticks(range(len(rows)), list(rows))
    axes.set_xscale("log")
    axes.set_xlim(0.01, 20000)
    axes.grid(axis="x", color="#dddddd")
    axes.set_title(title, loc="left", fontsize=10)
    axes.set_xlabel("ms: dot at the median, line to the greatest", fontsize=8)
    axes.invert_yaxis()


def draw_errors(axes, rows):
    for place, row in enumerate(rows.values()):
        if "too far mm" not in row:
            continue
        value = row["too far mm"]
        axes.barh(place, value, color=OTHERS)
        text = f"{value:.0f}" if value >= 10 else f"{value:.2g}"
        axes.text(value, place, f" {text}", va="center", fontsize=8)
    axes.set_yticks([])
    axes.margins(x=0.2)
    axes.set_xlim(left=0, right=max(1, axes.get_xlim()[1]))
    axes.set_xlabel("greatest error to the far side, mm", fontsize=8)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: plot.py bench.csv bench.svg")
    tables = read_tables(sys.argv[1])
    figure, axes = pyplot.subplots(len(tables), 2, figsize=(10, 2.9 * len(tables)), squeeze=False,
                                   width_ratios=[3, 1], layout="constrained")
    for (title, rows), (left, right) in zip(tables.items(), axes):
        draw_times(left, title, rows)
        draw_errors(right, rows)
        right.set_ylim(left.get_ylim())
    figure.savefig(sys.argv[2], format="svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
