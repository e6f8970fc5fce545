"""Figures 3.9 to 3.11: errors, and times over the grid radii."""
import numpy

from measurements import ERRORS, groups, missed_share, over_sets, pooled_error
from style import ERRORS as ERROR_COLOURS
from style import (ERROR_NAMES, MISSED, bars, from_zero, legend_above, panels, select, shades,
                   values)


def errors(rows):
    row = {}
    for what in ERRORS:
        name = f"{what}_error_mm"
        row[name], row[f"{name}_deviation"], row[f"{name}_greatest"] = pooled_error(rows, what)
    row["links_missed_percent"] = 100 * missed_share(rows)
    return row


def table_3_09(rows):
    table = []
    for group, of_group in groups(rows.where(part="parameters")):
        sums = of_group["step_x"] + of_group["step_y"]
        for both in numpy.unique(sums):
            table.append({"scenes": group, "step_x_plus_step_y_px": float(both)} |
                         errors(of_group.take(sums == both)))
    return table


def draw_errors(axis, lines, x):
    for shift, (what, colour) in zip((-1, 0, 1), ERROR_COLOURS.items()):
        bars(axis, [row | {x: row[x] * (1 + 0.006 * shift)} for row in lines], x,
             f"{what}_error_mm", color=colour, label=ERROR_NAMES[what])
    axis.set_ylabel("error [mm]")
    from_zero(axis)


def draw_missed(axis, lines, x):
    axis.plot([row[x] for row in lines], [row["links_missed_percent"] for row in lines], "s-",
              color=MISSED, markersize=3.5)
    axis.set_ylabel("links not found [%]")
    from_zero(axis)


def draw_3_09(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2)
    x = "step_x_plus_step_y_px"
    for place, group in enumerate(names):
        lines = select(table, scenes=group)
        draw_errors(axes[place][0], lines, x)
        draw_missed(axes[place][1], lines, x)
        for axis in axes[place]:
            axis.set(xlabel="step_x + step_y [px]", title=group)
    legend_above(axes[0][0], 3)
    return figure


def table_3_10(rows):
    table = []
    for group, of_group in groups(rows.where(part="parameters")):
        for panel, name in (("a", "initial_grid_radius_px"), ("b", "final_grid_radius_px")):
            for (radius,), each in of_group.by(name):
                table.append({"panel": panel, "scenes": group, "radius_px": radius} | errors(each))
    return table


def draw_3_10(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2)
    for place, group in enumerate(names):
        for axis, panel, name in zip(axes[place], "ab", ("initial", "final")):
            draw_errors(axis, select(table, scenes=group, panel=panel), "radius_px")
            axis.set(xlabel=f"{name} grid radius [px]", title=f"({panel}) {group}")
    legend_above(axes[0][0], 3)
    return figure


def table_3_11(rows):
    table = []
    for group, of_group in groups(rows.where(part="parameters")):
        for key, each in of_group.by("final_grid_radius_px", "initial_grid_radius_px"):
            row = {"scenes": group, "final_grid_radius_px": key[0],
                   "initial_grid_radius_px": key[1]}
            row["time_ms"], row["time_ms_deviation"] = over_sets(each, "time_ms")
            table.append(row)
    return table


def draw_3_11(table):
    names = values(table, "scenes")
    figure, axes = panels(len(names), 2)
    for place, group in enumerate(names):
        finals = values(table, "final_grid_radius_px")
        for final, colour in zip(finals, shades(len(finals))):
            lines = select(table, scenes=group, final_grid_radius_px=final)
            for axis, column in zip(axes[place], ("time_ms", "time_ms_deviation")):
                axis.plot([row["initial_grid_radius_px"] for row in lines],
                          [row[column] for row in lines], "o-", color=colour, markersize=3.5,
                          label=f"{final:.0f}")
        for axis, letter, label in zip(axes[place], "ab", ("time [ms]", "deviation [ms]")):
            axis.set(xlabel="initial grid radius [px]", ylabel=label, title=f"({letter}) {group}")
            from_zero(axis)
    legend_above(axes[0][0], 4, "final grid radius [px]")
    return figure
