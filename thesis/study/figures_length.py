"""Figures 3.5 to 3.8 and 3.12: over the length of the area of surveillance."""
import numpy

from measurements import ERRORS, groups, missed_share, over_sets, pooled_error, set_means
from style import (ERROR_NAMES, EXACT, LENGTH, PAIRS, PATTERNS, TIME, bars, from_zero, legend_above,
                   many, panels, select, shades, values)
from style import ERRORS as ERROR_COLOURS


def means(rows, *names):
    """Time and pairs with their deviations over the sets, for each combination of the columns."""
    table = []
    for group, of_group in groups(rows):
        for key, each in of_group.by(*names):
            row = {"scenes": group} | dict(zip(names, key))
            for column in ("time_ms", "pairs"):
                row[column], row[f"{column}_deviation"] = over_sets(each, column)
            table.append(row)
    return table


def table_3_05(rows):
    table = []
    for group, of_group in groups(rows.where(part="brute_force")):
        for (length, pattern), each in of_group.by("surveillance_length_m", "search_pattern"):
            table.append({"scenes": group, "surveillance_length_m": length,
                          "search_pattern": pattern, "time_ms": float(each["time_ms"].mean()),
                          "pairs": float(each["pairs"].mean())})
    return table


def draw_3_05(table):
    names = values(table, "scenes")
    figure, axes = panels(1, len(names), 3.4)
    for place, (axis, group) in enumerate(zip(axes[0], names)):
        counts = axis.twinx()
        counts.grid(False)
        counts.spines["right"].set_visible(True)
        for pattern, colour in PATTERNS.items():
            lines = select(table, scenes=group, search_pattern=pattern)
            x = [row["surveillance_length_m"] for row in lines]
            axis.plot(x, [row["time_ms"] for row in lines], "o-", color=colour, markersize=3.5,
                      label=f"time, {pattern}")
            counts.plot(x, [row["pairs"] for row in lines], "--", color=PAIRS, linewidth=1)
        axis.plot([], [], "--", color=PAIRS, linewidth=1, label="pairs, each pattern")
        axis.set(xlabel=LENGTH, ylabel="time [ms]", title=group)
        counts.set_ylabel("pairs computed", color=PAIRS)
        from_zero(axis)
        from_zero(counts)
        many(counts)
        if place == 0:
            legend_above(axis)
    return figure


def table_3_06(rows):
    return means(rows.where(part="surveillance_length"), "search_pattern", "surveillance_length_m")


def draw_3_06(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2)
    for place, group in enumerate(names):
        for axis, column, letter in zip(axes[place], ("time_ms", "pairs"), "ab"):
            for pattern, colour in PATTERNS.items():
                bars(axis, select(table, scenes=group, search_pattern=pattern),
                     "surveillance_length_m", column, color=colour, label=pattern)
            axis.set(xlabel=LENGTH, title=f"({letter}) {group}",
                     ylabel="time [ms]" if column == "time_ms" else "pairs computed")
            from_zero(axis)
        many(axes[place][1])
        if place == 0:
            legend_above(axes[0][0], 3)
    return figure


def table_of_steps(rows):
    return means(rows.where(part="surveillance_length"), "step_x", "surveillance_length_m")


def draw_steps(table, column, label):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2)
    for place, group in enumerate(names):
        for axis, few, letter in zip(axes[place], (True, False), "ab"):
            steps = [step for step in values(table, "step_x") if (step <= 4) == few]
            for step, colour in zip(steps, shades(len(steps))):
                bars(axis, select(table, scenes=group, step_x=step), "surveillance_length_m",
                     column, color=colour, label=f"{step:.0f}")
            axis.set(xlabel=LENGTH, ylabel=label, title=f"({letter}) {group}")
            from_zero(axis)
            if column == "pairs":
                many(axis)
            if place == 0:
                legend_above(axis, 4, "step in x and y [px]")
    return figure


def draw_3_07(table):
    return draw_steps(table, "pairs", "pairs computed")


def draw_3_08(table):
    return draw_steps(table, "time_ms", "time [ms]")


def fastest(rows):
    """The set with the least time, averaged over the scenes."""
    return min(set_means(rows), key=lambda found: found["time_ms"])


def table_3_12(rows):
    table = []
    for group, of_group in groups(rows.where(part="surveillance_length")):
        for (length,), each in of_group.by("surveillance_length_m"):
            best = fastest(each)
            table.append({"panel": "a", "scenes": group, "x": length, "time_ms": best["time_ms"],
                          "pairs": best["pairs"]})
    for group, of_group in groups(rows.where(part="exact")):
        for (length,), each in of_group.by("surveillance_length_m"):
            table.append({"panel": "a exact", "scenes": group, "x": length,
                          "time_ms": float(each["time_ms"].mean())})
    for group, of_group in groups(rows.where(part="parameters")):
        sums = of_group["step_x"] + of_group["step_y"]
        for both in numpy.unique(sums):
            each = of_group.take(sums == both)
            best = fastest(each)
            row = {"panel": "b", "scenes": group, "x": float(both),
                   "links_missed_percent": 100 * missed_share(each),
                   "fastest_links_missed_percent": best["links_missed_percent"]}
            for what in ERRORS:
                row[f"{what}_error_mm"] = pooled_error(each, what)[0]
                row[f"fastest_{what}_error_mm"] = best[f"{what}_error_mm"]
            table.append(row)
    return table


def draw_3_12(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2, 3.2)
    for place, group in enumerate(names):
        left, right = axes[place]
        counts = left.twinx()
        counts.grid(False)
        counts.spines["right"].set_visible(True)
        lines = select(table, panel="a", scenes=group)
        left.plot([row["x"] for row in lines], [row["time_ms"] for row in lines], "o-", color=TIME,
                  markersize=3.5, label="time of the fastest lattice")
        counts.plot([row["x"] for row in lines], [row["pairs"] for row in lines], "--",
                    color=PAIRS, linewidth=1)
        left.plot([], [], "--", color=PAIRS, linewidth=1, label="its pairs")
        lines = select(table, panel="a exact", scenes=group)
        left.plot([row["x"] for row in lines], [row["time_ms"] for row in lines], "*-",
                  color=EXACT, markersize=8, label="exact")
        left.set(xlabel=LENGTH, ylabel="time [ms]", title=f"(a) {group}")
        counts.set_ylabel("pairs computed", color=PAIRS)
        lines = select(table, panel="b", scenes=group)
        for what, colour in ERROR_COLOURS.items():
            x = [row["x"] for row in lines]
            right.plot(x, [row[f"{what}_error_mm"] for row in lines], "-", color=colour,
                       label=f"{ERROR_NAMES[what]}, mean of all")
            right.plot(x, [row[f"fastest_{what}_error_mm"] for row in lines], ":", color=colour,
                       label="… the fastest")
        right.set(xlabel="step_x + step_y [px]", ylabel="error [mm]", title=f"(b) {group}")
        for axis in (left, right, counts):
            from_zero(axis)
        many(counts)
        if place == 0:
            legend_above(left, 2)
            # By columns: the means, then the fastest.
            handles, labels = right.get_legend_handles_labels()
            order = [0, 2, 4, 1, 3, 5]
            legend_above(right, 2, handles=[handles[i] for i in order],
                         labels=[labels[i] for i in order])
    return figure
