#!/usr/bin/python3
"""Makes the figures and the page of a study: make_page.py DIR, the folder given to
`berth_study --out`."""
import csv
import html
import io
import re
import sys
import textwrap
from pathlib import Path

import numpy

import figures_error
import figures_gpu
import figures_length
import figures_sets
from findings import FAILS, FINDINGS, HOLDS, IN_PART, judge
from measurements import missed_share, pooled_error, read, scenes_of, set_means
from style import pyplot

# Number: (title, table, drawing, what else has to be known to read it).
FIGURES = {
    "3.5": ("Brute force", figures_length.table_3_05, figures_length.draw_3_05,
            "Every pair within the region around each robot pixel; nothing shrinks."),
    "3.6": ("Search pattern", figures_length.table_3_06, figures_length.draw_3_06,
            "Bars: deviation over steps and grid radii."),
    "3.7": ("Object skipping, pairs", figures_length.table_of_steps, figures_length.draw_3_07,
            "Bars: deviation over search patterns and grid radii."),
    "3.8": ("Object skipping, time", figures_length.table_of_steps, figures_length.draw_3_08,
            "Bars: deviation over search patterns and grid radii."),
    "3.9": ("Object skipping, error", figures_error.table_3_09, figures_error.draw_3_09,
            "Against brute force, over all links that both found; bars: deviation. Links that the "
            "lattice did not find have no error: they are counted on the right."),
    "3.10": ("Grid radii, error", figures_error.table_3_10, figures_error.draw_3_10,
             "Bars: deviation over links, steps and the other radius."),
    "3.11": ("Grid radii, time", figures_error.table_3_11, figures_error.draw_3_11,
             "(b): deviation over the steps."),
    "3.12": ("The fastest parameters", figures_length.table_3_12, figures_length.draw_3_12,
             "(b): solid, the mean over all radii; dotted, the fastest set."),
    "3.13": ("GPU: object skipping", *figures_gpu.FIGURES["3.13"],
             "Bars: deviation over radii and tile sizes, of the error over links as well."),
    "3.14": ("GPU: robot and obstacle points", *figures_gpu.FIGURES["3.14"],
             "Bars: deviation over links, radii and tile sizes."),
    "3.15": ("GPU: initial radius and tile size, time", *figures_gpu.FIGURES["3.15"],
             "Bars: deviation over steps and final radii."),
    "3.16": ("GPU: tile size and initial radius, error", *figures_gpu.FIGURES["3.16"],
             "Bars: deviation over links, steps and final radii."),
    "3.17": ("All parameter sets", figures_sets.table_3_17, figures_sets.draw_3_17,
             "Each averaged over the scenes; the thesis shows the GPU's, here they are lattice's."),
    "3.18": ("The fastest sets", figures_sets.table_3_18, figures_sets.draw_3_18,
             "The thesis shows the GPU's; (a) and (b) are lattice's, on the processor; (c) and (d) "
             "are all methods' (dots: mean, bars: greatest), where OpenGL was measured."),
    "3.19": ("The worst case", figures_sets.table_3_19, figures_sets.draw_3_19,
             "Every pixel an obstacle, the robot behind every pixel. Its own distances are 0, so "
             "the errors are those of the same sets elsewhere, as in the thesis. (c) and (d) are "
             "all methods' (dots: mean, bars: greatest), where OpenGL was measured."),
}
NO_GPU = ("OpenGL ran on the processor ({}), not on a GPU: its times are no measure of one, and "
          "findings about them are not judged.")
CLASSES = {HOLDS: "holds", IN_PART: "part", FAILS: "fails"}


def file_name(number, ending):
    chapter, figure = number.split(".")
    return f"figure_{chapter}_{int(figure):02}.{ending}"


def write_table(path, table):
    columns = list(dict.fromkeys(name for row in table for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        for row in table:
            writer.writerow({name: "" if value is None or value != value else
                             f"{value:.6g}" if isinstance(value, float) else value
                             for name, value in row.items()})


def runs_in_software(study):
    return study["OpenGL"].endswith(", software")


def caption(number, verdicts, width):
    """What stands beside the figure on the page, for a picture that is taken from it."""
    title, _, _, note = FIGURES[number]
    lines = [f"Figure {number}: {title}. {note}"]
    lines += [f"{found.finding.claim} – {found.verdict}: {found.number} ({found.holds} of "
              f"{found.scenes})" for found in verdicts if found.finding.figure == number]
    return "\n".join("\n".join(textwrap.wrap(line, width)) for line in lines)


def add_below(figure, text):
    """Makes the figure higher, by room for the text. Returns the room's share of the height."""
    room_in = 0.15 + 0.145 * (text.count("\n") + 1)
    height_in = figure.get_figheight() + room_in
    share = room_in / height_in
    figure.set_figheight(height_in)
    figure.get_layout_engine().set(rect=(0, share, 1, 1 - share))
    figure.text(0.01, share - 0.1 / height_in, text, va="top", fontsize=8.5)
    return share


def without_below(svg, share):
    """The picture cut above what add_below() added."""
    width, height = re.search(r'viewBox="0 0 ([0-9.]+) ([0-9.]+)"', svg).groups()
    cut = float(height) * (1 - share)
    return (svg.replace(f'viewBox="0 0 {width} {height}"', f'viewBox="0 0 {width} {cut:.2f}"', 1)
            .replace(f'height="{height}pt"', f'height="{cut:.2f}pt"', 1))


def make_figure(folder, number, rows, verdicts):
    """Writes the figure's files; returns its SVG for the page, which has the caption as text. None
    where nothing was measured."""
    _, make_table, draw, _ = FIGURES[number]
    table = make_table(rows)
    if not table:
        return None
    write_table(folder / file_name(number, "csv"), table)
    figure = draw(table)
    share = add_below(figure, caption(number, verdicts, int(15 * figure.get_figwidth())))
    figure.savefig(folder / file_name(number, "png"))
    # Laid out once; a second time takes as long as the first.
    figure.set_layout_engine("none")
    svg = io.StringIO()
    # The prefix keeps the names inside one picture apart from those of the others on the page.
    pyplot.rcParams["svg.hashsalt"] = number
    figure.savefig(svg, format="svg", metadata={"Date": None})
    pyplot.close(figure)
    (folder / file_name(number, "svg")).write_text(svg.getvalue(), encoding="utf-8")
    return without_below(svg.getvalue()[svg.getvalue().index("<svg"):], share)


def badge(verdict):
    return f'<span class="badge {CLASSES[verdict]}">{verdict}</span>'


def finding_item(verdict):
    return (f"<tr><td>{html.escape(verdict.finding.claim)}</td><td>{badge(verdict.verdict)} "
            f"{html.escape(verdict.number)} <small>({verdict.holds} of {verdict.scenes} "
            f"{'scene' if verdict.scenes == 1 else 'scenes'})</small></td></tr>")


def section(number, svg, verdicts):
    title, _, _, note = FIGURES[number]
    name = file_name(number, "svg")[:-4]
    text = f'<section id="{name}"><h2>Figure {number}: {html.escape(title)}</h2>'
    if svg is None:
        return text + ('<p class="absent">This figure needs the OpenGL methods gl_lattice and '
                       "gl_hybrid, which this study did not measure: it needs "
                       "<code>--backend opengl</code>.</p></section>")
    width_pt = float(re.search(r'width="([0-9.]+)pt"', svg).group(1))
    text += (f'<div class="figure" style="--natural:{width_pt * 4 / 3:.0f}px">{svg}</div>'
             f'<p class="note">{html.escape(note)} ')
    text += f'<a href="{name}.csv">table</a> · <a href="{name}.png">picture</a></p>'
    own = [verdict for verdict in verdicts if verdict.finding.figure == number]
    if own:
        text += ('<table class="findings"><tr><th>The thesis, 2015</th><th>Here</th></tr>' +
                 "".join(map(finding_item, own)) + "</table>")
    return text + "</section>"


def advice(rows, renderer):
    """What to choose, from the numbers."""
    compared = rows.take(rows["kind"] != "worst_case")
    sets = list(set_means(compared.where(part="parameters")))
    length = compared.where(part="parameters").values("surveillance_length_m")[0]
    exact = compared.where(part="exact", surveillance_length_m=length)
    error = pooled_error(exact, "distance")[2]
    quickest = min(sets, key=lambda found: found["time_ms"])
    best = min(sets, key=lambda found: (found["links_missed_percent"],
                                        found["distance_error_mm"]))
    faster = sum(found["time_ms"] < exact["time_ms"].mean() for found in sets)
    def words(found):
        return (f"{found['time_ms']:.2f} ms in the mean, with a mean error of "
                f"{found['distance_error_mm']:.2f} mm, at most "
                f"{found['distance_error_greatest_mm']:.0f} mm, and "
                f"{found['links_missed_percent']:.2g} % of the links in range not found")
    lines = [
        f"<code>exact</code> takes {exact['time_ms'].mean():.3f} ms in the mean over {len(exact)} "
        f"scenes ({exact['time_ms'].max():.3f} ms on the slowest) at 2L = {length:g} m; its "
        f"distances differ from brute force's by {error:.1g} mm at most, and it leaves "
        f"{100 * missed_share(exact):.2g} % of the links in range out.",
        f"The fastest of {len(sets)} lattice sets takes {words(quickest)}.",
        f"The most accurate of them takes {words(best)}.",
        f"{faster} of the {len(sets)} lattice sets are faster than <code>exact</code>. " +
        ("There is no reason to choose a lattice on this machine." if faster == 0 else
         "A lattice is worth a look only where an error of its size does no harm."),
    ]
    on_gpu = compared.where(part="gl_exact")
    if len(on_gpu):
        lines.append(
            f"On {html.escape(renderer)}, <code>gl_exact</code> takes "
            f"{on_gpu['time_ms'].mean():.3f} ms in the mean over {len(on_gpu)} scenes, from images "
            "that are there already to the answer in memory; its distances differ from brute "
            f"force's by {pooled_error(on_gpu, 'distance')[2]:.1g} mm at most.")
    return lines


def on_opengl(study):
    """How the methods on OpenGL were measured; nothing where they were not."""
    if study["OpenGL"] == "none":
        return ""
    return ("<p>Times of gl_hybrid, gl_lattice and gl_exact are by the clock on the wall, on " +
            html.escape(study["OpenGL"]) + ", one after another and with nothing of the study "
            "beside them: from images that were uploaded before to the answer in memory, the "
            "read-back included. gl_hybrid, which makes its lattices on the processor, reads the "
            "robot image back as well. The region is the whole image." +
            (" As each set takes so long there, they were measured on fewer scenes and sets."
             if runs_in_software(study) else "") + "</p>")


def facts(study, rows):
    """What the study is; its recordings by name, not by where they lie on somebody's disk."""
    recordings = ", ".join(rows.where(kind="recording").values("scene")) or "none"
    lines = "".join(f"<tr><th>{html.escape(name)}</th><td>{html.escape(str(value))}</td></tr>"
                    for name, value in (study | {"recordings": recordings}).items())
    return f'<table class="facts">{lines}</table>'


def page(study, rows, svgs, verdicts):
    style = (Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    counts = ", ".join(f"{sum(found.verdict == kind for found in verdicts)} "
                       f"{kind.replace('holds', 'hold')}" if kind != FAILS else
                       f"{sum(found.verdict == kind for found in verdicts)} do not"
                       for kind in (HOLDS, IN_PART, FAILS))
    contents = "".join(
        f'<li><a href="#{file_name(number, "svg")[:-4]}">{number} {html.escape(figure[0])}</a> ' +
        "".join(badge(found.verdict) for found in verdicts if found.finding.figure == number) +
        "</li>" for number, figure in FIGURES.items())
    missed = 100 * missed_share(rows.where(part="parameters"))
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>berth_study: the thesis's experiments again</title><style>{style}</style></head><body>
<header><h1>The thesis's experiments again</h1>
<p>Fabian Hirt, <i>Fast Robot-Obstacles Distance Evaluation in the Depth Space</i> (TU Munich,
2015), chapter 3.2, made again by <code>berth_study</code> on {len(scenes_of(rows))} scenes and a
worst case. Of {len(verdicts)} findings {counts}.</p>
{'<p class="warning">This was a quick study: few values of each parameter, few and small '
 'scenes. Its verdicts are rough.</p>' if study["extent"] == "quick" else ""}
{f'<p class="warning">{html.escape(NO_GPU.format(study["OpenGL"]))}</p>'
 if runs_in_software(study) else ""}</header>
<section id="choice"><h2>What to choose</h2><ul>{''.join(f'<li>{line}</li>'
for line in advice(rows, study["OpenGL"]))}</ul></section>
<nav><h2>Figures</h2><ol>{contents}</ol></nav>
<section id="how"><h2>How it was measured</h2>
<p>A time is processor time of one thread, from three images in memory to the distances of all
links, the least of three runs (of more where they are short, of one where it takes longer than
30 ms); several such threads ran side by side. Errors are against brute force, per link: the
distance's difference, and how far robot and obstacle point lie from the right ones. {missed:.2g} % of the links in range were
not found by a lattice and have no error. A finding is judged on each scene by itself: it holds
where it holds on nine of ten scenes, in part where it does on half of them; the number beside it
is the median over the scenes. Hirt measured on one scene, an i7-4790K and a GTX 660.</p>
{on_opengl(study)}{facts(study, rows)}</section>
{"".join(section(number, svgs[number], verdicts) for number in FIGURES)}
</body></html>
"""


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: make_page.py DIR, the folder given to berth_study --out")
    folder = Path(sys.argv[1])
    study, rows = read(folder)
    numpy.seterr(all="raise", under="ignore")
    verdicts = [found for found in (judge(finding, rows) for finding in FINDINGS
                                    if not (finding.times_a_gpu and runs_in_software(study)))
                if found]
    svgs = {number: make_figure(folder, number, rows, verdicts) for number in FIGURES}
    (folder / "index.html").write_text(page(study, rows, svgs, verdicts), encoding="utf-8")


if __name__ == "__main__":
    main()
