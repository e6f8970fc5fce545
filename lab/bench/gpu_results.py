#!/usr/bin/python3
"""gpu_results.py DIR: adds the study's measurements on OpenGL, DIR/study, as tables to
DIR/results.md, which `berth_bench --backend opengl --out DIR` wrote."""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "thesis"))

from measurements import groups, read, set_means  # noqa: E402

METHODS = ("gl_exact", "gl_lattice", "gl_hybrid")
COLUMNS = {"time ms": "time_ms", "distance error mm": "distance_error_mm",
           "greatest mm": "distance_error_greatest_mm", "not found %": "links_missed_percent"}
PARAMETERS = {"step": "step_x", "initial radius": "initial_grid_radius_px",
              "tile": "initial_tile_px", "final radius": "final_grid_radius_px"}


def words_of(method, found):
    named = [f"{name} {found[key]:.0f}" for name, key in PARAMETERS.items()
             if found[key] is not None]
    return ", ".join([method] + named)


def chosen(sets):
    """(what it is, the set): the fastest, the most accurate, the fastest within 5 mm."""
    def time(found):
        return found["time_ms"]
    within = [found for found in sets if found["distance_error_greatest_mm"] <= 5
              and found["links_missed_percent"] == 0]
    yield "fastest", min(sets, key=time)
    yield "most accurate", min(sets, key=lambda found: (found["links_missed_percent"],
                                                        found["distance_error_mm"]))
    if within:
        yield "fastest within 5 mm", min(within, key=time)


def table(title, rows):
    lines = [f"\n## Parameter sets on OpenGL, {title}\n",
             f"| set | which | {' | '.join(COLUMNS)} |", "| --- | --- |" + " ---: |" * len(COLUMNS)]
    for method in METHODS:
        sets = list(set_means(rows.where(part=method)))
        for which, found in chosen(sets) if sets else ():
            cells = [f"{found[key]:.3g}" for key in COLUMNS.values()]
            lines.append(f"| {words_of(method, found)} | {which} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: gpu_results.py DIR, the folder given to berth_bench --out")
    folder = Path(sys.argv[1])
    study, rows = read(folder / "study")
    text = ("\nThe study, on " + study["OpenGL"] + ": from images on the device to the answer in "
            "memory, means over the scenes.\n")
    on_gl = rows.take([part in METHODS for part in rows["part"]])
    for name, of_group in groups(on_gl):
        text += table(name, of_group)
    worst = on_gl.where(kind="worst_case")
    text += ("\n## Worst case on OpenGL\n\n| method | fastest ms | slowest of the 30 fastest ms |\n"
             "| --- | ---: | ---: |\n")
    for method in METHODS:
        times = sorted(found["time_ms"] for found in set_means(worst.where(part=method)))[:30]
        text += f"| {method} | {times[0]:.3g} | {times[-1]:.3g} |\n"
    with open(folder / "results.md", "a", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
