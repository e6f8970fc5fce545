#!/usr/bin/python3
"""figures.py BERTH_BENCH: measures the speeds that README.md and lab/bench/RESULTS.md quote, and writes them there between
<!-- figures --> and <!-- end of figures -->, with commit and processor. `make figures` runs it, best where nothing else runs."""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENE = "data/bundled/scene.yaml"
BUNDLED = "640 x 480 and 424 x 240 at 30 images a second, 480 x 360 at 24"
ROWS = {
    "1 camera": ["--cameras", "1"],
    "2 cameras": ["--cameras", "2"],
    "3 cameras": ["--cameras", "3"],
    "room 1, 3 cameras of 640 x 480": ["--room", "1", "--cameras", "3"],
    "room 2, 4 cameras of 640 x 480": ["--room", "2", "--cameras", "4"],
    "room 2, 3 cameras of 1280 x 720": ["--room", "2", "--cameras", "3", "--image", "1280", "720"],
}


def output(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


def measure_stream(bench, options):
    return json.loads(output(bench, "--stream", SCENE, "--seconds", "6", "--format", "json", *options))


def measure_exact_ms(bench):
    """The median over the random scenes of one image against one image."""
    with tempfile.TemporaryDirectory() as folder:
        output(bench, "--quick", "--out", folder)
        lines = (Path(folder) / "results.md").read_text().splitlines()
    row = next(line for line in lines if line.startswith("| berth exact |"))
    return float(row.split("|")[2])


def where():
    commit = output("git", "describe", "--always", "--abbrev=8", "--dirty").strip()
    processor = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())[1]
    return f"{commit}, {processor}"


def short(value):
    """Two digits, or all before the point."""
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def ms(us):
    return short(us / 1000)


def readme_block(place, three, exact_ms):
    return f"""- **How fast** ({place}, one core for requests, one for images): three cameras ({BUNDLED}; 8 links) give
  {three['answers_per_s']:.0f} answers a second, {100 * three['ok_share']:.0f} % of them `ok`, 99 % within {ms(three['ask_us']['p99'])} ms, with bounds {short(1000 * three['gap_m']['p50'])} mm apart in the median;
  {three['exposure_to_answer_ms']['p50']:.0f} ms from an exposure to an answer that knows of it. `--deadline-us` cuts a request, and gives what is certain by then.
  The closest pairs of one image alone (`berth evaluate`) take {short(exact_ms)} ms in the median of random scenes. [All figures](lab/bench/RESULTS.md).
"""


def results_block(place, rows):
    lines = [f"Measured on {place}.", "",
             "| | answers a second | ok | request, ms: median / 99 % / 99.9 % / greatest | an image, ms: median / 99 % | exposure to answer, ms: median / 99 % "
             "| bounds apart, mm: median / 99 % |", "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for name, row in rows.items():
        ask, image, exposure, gap = row["ask_us"], row["image_ms"], row["exposure_to_answer_ms"], row["gap_m"]
        pair = lambda values, factor=1: " / ".join("-" if values[p] is None else short(factor * values[p]) for p in ("p50", "p99"))
        asked = " / ".join(ms(ask[p]) for p in ("p50", "p99", "p999", "max"))
        lines.append(f"| {name} | {row['answers_per_s']:.0f} | {100 * row['ok_share']:.0f} % | {asked} | {pair(image)} | {pair(exposure)} | {pair(gap, 1000)} |")
    return "\n".join(lines) + "\n"


def put(file, block):
    text = file.read_text(encoding="utf-8")
    begin, end = "<!-- figures -->\n", "<!-- end of figures -->\n"
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{file}: expected one {begin.strip()} and one {end.strip()}")
    before, rest = text.split(begin)
    file.write_text(before + begin + block + end + rest.split(end)[1], encoding="utf-8")


def main(bench):
    place = where()
    rows = {name: measure_stream(bench, options) for name, options in ROWS.items()}
    put(ROOT / "README.md", readme_block(place, rows["3 cameras"], measure_exact_ms(bench)))
    put(ROOT / "lab/bench/RESULTS.md", results_block(place, rows))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: figures.py BERTH_BENCH, the program that `make bench` builds")
    main(str(Path(sys.argv[1]).resolve()))
