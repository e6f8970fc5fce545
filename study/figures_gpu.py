"""Figures 3.13 to 3.16: the thesis's methods on the GPU. Each is empty until they are measured."""
from measurements import ERRORS, groups, missed_share, over_sets, pooled_error
from style import PATTERNS, bars, from_zero, legend_above, panels, select, values

# CPU rasterization and GPU rasterization in the thesis.
METHODS = {"gl_hybrid": PATTERNS["row_major"], "gl_lattice": PATTERNS["oscillating"]}


def over(rows, method, name):
    """Time and errors of one method, for each value of a parameter."""
    table = []
    for group, of_group in groups(rows.where(method=method)) if method in rows["method"] else []:
        for (value,), each in of_group.by(name):
            row = {"scenes": group, "method": method, "parameter": name, "value": value,
                   "links_missed_percent": 100 * missed_share(each)}
            row["time_ms"], row["time_ms_deviation"] = over_sets(each, "time_ms")
            for what in ERRORS:
                error = f"{what}_error_mm"
                row[error], row[f"{error}_deviation"], _ = pooled_error(each, what)
            table.append(row)
    return table


def table_of_steps(rows):
    return over(rows, "gl_hybrid", "step_x") + over(rows, "gl_lattice", "step_x")


def table_of_sizes(rows):
    return (over(rows, "gl_hybrid", "initial_grid_radius_px") +
            over(rows, "gl_lattice", "initial_tile_px"))


def draw(table, columns):
    """A row for each group of scenes, a panel for each column and parameter."""
    names = values(table, "scenes")
    parameters = values(table, "parameter")
    figure, axes = panels(len(names), len(columns) * len(parameters))
    for place, group in enumerate(names):
        cells = [(parameter, column) for parameter in parameters for column in columns]
        for axis, (parameter, column) in zip(axes[place], cells):
            for method, colour in METHODS.items():
                lines = select(table, scenes=group, parameter=parameter, method=method)
                if lines:
                    bars(axis, lines, "value", column, color=colour, label=method)
            axis.set(xlabel=f"{parameter}", ylabel=column, title=group)
            from_zero(axis)
            legend_above(axis)
    return figure


FIGURES = {
    "3.13": (table_of_steps, lambda table: draw(table, ["time_ms", "distance_error_mm"])),
    "3.14": (table_of_steps,
             lambda table: draw(table, ["robot_point_error_mm", "obstacle_point_error_mm"])),
    "3.15": (table_of_sizes, lambda table: draw(table, ["time_ms"])),
    "3.16": (table_of_sizes, lambda table: draw(table, ["distance_error_mm"])),
}
