#!/usr/bin/env python3
"""The pictures of an encounter side by side, over its distances and speeds: FOLDER OUT.png."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Of each picture the camera's image alone: its size, and the title's height, in pixels.
IMAGE = (960, 720)


def main(folder, out):
    with open(folder / "samples.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    pictures = sorted(folder.glob("film_*.png"))
    figure = plt.figure(figsize=(12, 5.6), layout="constrained")
    grid = figure.add_gridspec(2, len(pictures), height_ratios=[1, 1.5])
    for i, picture in enumerate(pictures):
        image = plt.imread(picture)
        top = image.shape[0] - IMAGE[1]
        axes = figure.add_subplot(grid[0, i])
        axes.imshow(image[max(0, top // 2):, :IMAGE[0]])
        axes.set_title("ABCDEFGH"[i], loc="left", fontsize=10, fontweight="bold")
        axes.axis("off")
    axes = figure.add_subplot(grid[1, :])
    time = [row["time_s"] for row in rows]
    axes.plot(time, [row["clearance_m"] for row in rows], color="#0072B2", label="true distance of arm and person [m]")
    axes.plot(time, [row["fastest_m_s"] for row in rows], color="#D55E00", label="speed of the arm's fastest point [m/s]")
    axes.plot(time, [row["scale"] for row in rows], color="#000000", linestyle=":", label="speed_scale")
    for i, share in enumerate((0.12, 0.3, 0.42, 0.55, 0.8)[:len(pictures)]):
        axes.axvline(share * time[-1], color="#BBBBBB", linewidth=0.8, zorder=0)
        axes.text(share * time[-1], axes.get_ylim()[1], " " + "ABCDEFGH"[i], va="top", fontsize=10, fontweight="bold")
    axes.set_xlabel("time [s]")
    axes.set_ylim(bottom=0)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, frameon=False)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
