"""Figures 3.17 to 3.19: all parameter sets by their time, and the fastest of them."""
import numpy

from measurements import groups, set_means
from style import (ERROR_NAMES, EXACT, GPU, MISSED, TIME, from_zero, legend_above, panels, select,
                   values)
from style import ERRORS as ERROR_COLOURS

FASTEST = 30
PARAMETERS = ("surveillance_length_m", "step_x", "step_y", "initial_grid_radius_px",
              "final_grid_radius_px", "initial_tile_px")
COLUMNS = ("time_ms", "distance_error_mm", "distance_error_greatest_mm", "robot_point_error_mm",
           "obstacle_point_error_mm", "links_missed_percent")


def exact(rows):
    """What exact did at the 2L of the parameter sets, over the scenes."""
    length = rows.where(part="parameters").values("surveillance_length_m")[0]
    found, = set_means(rows.where(part="exact", surveillance_length_m=length))
    return {"rank": 0, "method": "exact"} | {name: found[name] for name in COLUMNS}


def ranked(rows, group, count=None):
    """The sets by ascending time, over the scenes, and exact as rank 0."""
    sets = sorted(set_means(rows.where(part="parameters")), key=lambda found: found["time_ms"])
    table = [{"scenes": group} | exact(rows)]
    for rank, found in enumerate(sets[:count], 1):
        table.append({"scenes": group, "rank": rank, "method": "lattice"} |
                     {name: found[name] for name in PARAMETERS + COLUMNS})
    return table


def words_of(right):
    return f"exact: {right['time_ms']:.3g} ms, error {right['distance_error_mm']:.1g} mm"


def table_3_17(rows):
    return [line for group, of_group in groups(rows) for line in ranked(of_group, group)]


def draw_3_17(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 3)
    for place, group in enumerate(names):
        lattice = select(table, scenes=group, method="lattice")
        right = select(table, scenes=group, method="exact")[0]
        rank = [row["rank"] for row in lattice]
        time = [row["time_ms"] for row in lattice]
        error = [row["distance_error_mm"] for row in lattice]
        first, second, third = axes[place]
        first.plot(rank, time, ".", color=TIME, markersize=2.5, label="lattice", rasterized=True)
        first.axhline(right["time_ms"], color=EXACT, linewidth=1.4, label="exact")
        first.set(ylabel="time [ms]", xlabel="parameter sets by time", title=f"(a) {group}")
        second.plot(rank, error, ".", color=ERROR_COLOURS["distance"], markersize=2.5,
                    rasterized=True, label="mean error")
        width = max(1, len(error) // 20)
        if len(error) > width:
            running = numpy.convolve(error, numpy.ones(width) / width, "valid")
            second.plot(numpy.arange(len(running)) + width / 2 + 0.5, running, color=MISSED,
                        label=f"mean of {width} neighbours")
        second.set(ylabel="distance error [mm]", xlabel="parameter sets by time",
                   title=f"(b) {group}")
        third.plot(time, error, ".", color=ERROR_COLOURS["distance"], markersize=2.5,
                   rasterized=True, label="lattice")
        third.plot(right["time_ms"], right["distance_error_mm"], "*", color=EXACT, markersize=13,
                   clip_on=False, zorder=5, label=words_of(right))
        third.set(xlabel="time [ms]", ylabel="distance error [mm]", title=f"(c) {group}")
        third.set_xlim(left=0)
        for axis in axes[place]:
            from_zero(axis)
        legend_above(third)
        if place == 0:
            legend_above(first)
            legend_above(second)
    return figure


def fastest_on_gpu(rows, method):
    sets = sorted(set_means(rows.where(part=method)), key=lambda found: found["time_ms"])
    return [{"rank": rank, "method": method} | {name: found[name] for name in PARAMETERS + COLUMNS}
            for rank, found in enumerate(sets[:FASTEST], 1)]


def table_3_18(rows):
    table = []
    for group, of_group in groups(rows):
        table += ranked(of_group, group, FASTEST)
        for method in (*GPU, "gl_exact"):
            table += [{"scenes": group} | line for line in fastest_on_gpu(of_group, method)]
    return table


def draw_ranks(axes, lines, title):
    """Time, and errors, of sets by rank."""
    rank = [row["rank"] for row in lines]
    axes[0].plot(rank, [row["time_ms"] for row in lines], "o", color=TIME, markersize=4,
                 label="lattice")
    for what, colour in ERROR_COLOURS.items():
        axes[1].plot(rank, [row[f"{what}_error_mm"] for row in lines], "o", color=colour,
                     markersize=4, label=f"{ERROR_NAMES[what]}, mean")
    axes[1].plot(rank, [row["distance_error_greatest_mm"] for row in lines], "_",
                 color=ERROR_COLOURS["distance"], markersize=7, label="distance, greatest")
    axes[1].set_yscale("symlog", linthresh=1)
    axes[1].axhline(5, color=MISSED, linewidth=1, linestyle="--")
    axes[0].set(xlabel="the fastest parameter sets", ylabel="time [ms]", title=f"(a) {title}")
    axes[1].set(xlabel="the fastest parameter sets", ylabel="error [mm]; dashed: 5 mm",
                title=f"(b) {title}")


def draw_exact(axes, right):
    axes[0].axhline(right["time_ms"], color=EXACT, linewidth=1.4)
    for axis, name in zip(axes, ("time_ms", "distance_error_mm")):
        axis.plot(0, right[name], "*", color=EXACT, markersize=13, clip_on=False, zorder=5,
                  label=words_of(right))
        from_zero(axis)


def draw_methods(axes, lines, title):
    """Time and the distance's error of the fastest sets of each method, the CPU's and the GPU's."""
    for method, colour in {"lattice": ERROR_COLOURS["distance"], **GPU}.items():
        own = [row for row in lines if row["method"] == method]
        rank = [row["rank"] for row in own]
        for axis, name in zip(axes, ("time_ms", "distance_error_mm")):
            axis.plot(rank, [row[name] for row in own], "o", color=colour, markersize=4,
                      label=method)
        axes[1].plot(rank, [row["distance_error_greatest_mm"] for row in own], "_", color=colour,
                     markersize=7)
    for method, style in (("exact", "-"), ("gl_exact", "--")):
        for row in lines:
            if row["method"] == method:
                axes[0].axhline(row["time_ms"], color=EXACT, linewidth=1.4, linestyle=style,
                                label=f"{method}: {row['time_ms']:.3g} ms")
    axes[0].set_yscale("log")
    axes[1].set_yscale("symlog", linthresh=1)
    axes[1].axhline(5, color=MISSED, linewidth=1, linestyle="--")
    from_zero(axes[1])
    axes[0].set(xlabel="the fastest parameter sets", ylabel="time [ms]", title=f"(c) {title}")
    axes[1].set(xlabel="the fastest parameter sets", title=f"(d) {title}",
                ylabel="distance error [mm]")
    legend_above(axes[0], 2)
    legend_above(axes[1], 3)


def has_gpu(table):
    return any(row["method"] in GPU for row in table)


def draw_3_18(table):
    names = values(table, "scenes")
    of_group = 2 if has_gpu(table) else 1
    figure, axes = panels(of_group * len(names), 2, 3.2)
    for place, group in enumerate(names):
        lines = select(table, scenes=group)
        left_and_right = axes[of_group * place]
        draw_ranks(left_and_right, select(lines, method="lattice"), group)
        draw_exact(left_and_right, lines[0])
        legend_above(left_and_right[0])
        if place == 0:
            legend_above(left_and_right[1])
        if of_group == 2:
            draw_methods(axes[2 * place + 1], lines, group)
    return figure


def table_3_19(rows):
    """The fastest sets of the worst case, with their errors on the scenes that are compared."""
    table = []
    name, normal = groups(rows)[0]
    errors = {tuple(found[key] for key in PARAMETERS): found
              for found in set_means(normal.where(part="parameters"))}
    worst = rows.where(kind="worst_case")
    for part, search in (("every_pair", "every pair"), ("parameters", "shrinking region")):
        table.append({"search": search, "errors_on": name} | exact(normal) |
                     {"time_ms": exact(worst)["time_ms"]})
        table += fastest_there(worst, part, "lattice", errors,
                               {"search": search, "errors_on": name})
    for method in (*GPU, "gl_exact"):
        errors = {tuple(found[key] for key in PARAMETERS): found
                  for found in set_means(normal.where(part=method))}
        table += fastest_there(worst, method, method, errors,
                               {"search": "every pair", "errors_on": name})
    return table


def fastest_there(worst, part, method, errors, head):
    """The fastest sets of the worst case by their time there, with their errors elsewhere."""
    sets = sorted(set_means(worst.where(part=part)), key=lambda found: found["time_ms"])
    lines = []
    for rank, found in enumerate(sets[:FASTEST], 1):
        there = errors[tuple(found[key] for key in PARAMETERS)]
        lines.append(head | {"rank": rank, "method": method, "time_ms": found["time_ms"]} |
                     {key: there[key] for key in COLUMNS[1:]} |
                     {key: found[key] for key in PARAMETERS})
    return lines


def draw_3_19(table):
    figure, axes = panels(3 if has_gpu(table) else 2, 2, 3.2)
    for place, search in enumerate(values(table, "search")):
        lines = select(table, search=search)
        draw_ranks(axes[place], select(lines, method="lattice"), search)
        axes[place][1].set_title(f"(b) {search}; errors on {lines[0]['errors_on']}")
        draw_exact(axes[place], lines[0])
        legend_above(axes[place][0])
        if place == 0:
            legend_above(axes[place][1])
    if has_gpu(table):
        draw_methods(axes[2], select(table, search="every pair"), "every pair")
        axes[2][1].set_title(f"(d) every pair; errors on {table[0]['errors_on']}")
    return figure
