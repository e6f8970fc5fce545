"""Figures 3.13 to 3.16: the thesis's methods on the GPU. Each is empty where they were not
measured."""
from measurements import ERRORS, groups, missed_share, over_sets, pooled_error
from style import ERROR_NAMES, EXACT, GPU, bars, from_zero, legend_above, panels, select, values

NAMES = {"gl_hybrid": "gl_hybrid (CPU rasterization)",
         "gl_lattice": "gl_lattice (GPU rasterization)"}
X_LABELS = {"step_x": "step in x and y [px]",
            "initial_grid_radius_px": "gl_hybrid's initial radius [px]",
            "initial_tile_px": "gl_lattice's tile size [px]"}


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


def table_of_few_and_all_steps(rows):
    """Errors over the sizes, of all steps and of those that the thesis's other figures have."""
    few = rows.take(rows["step_x"] <= 32)
    return [line | {"steps": steps} for steps, of_steps in (("all", rows), ("≤ 32", few))
            for line in table_of_sizes(of_steps)]


def with_exact(make_table):
    """The table, and gl_exact's point for each group of scenes."""
    def table(rows):
        exact = over(rows, "gl_exact", "surveillance_length_m")
        lines = make_table(rows)
        return lines + [line | {"parameter": "", "value": ""} for line in exact] if lines else []
    return table


def label_of(column):
    if column == "time_ms":
        return "time [ms]"
    return f"{ERROR_NAMES[column.removesuffix('_error_mm')]} error [mm]"


def draw(table, columns):
    """A row for each group of scenes, a panel for each parameter and column."""
    names = values(table, "scenes")
    parameters = [name for name in values(table, "parameter") if name]
    cells = [(parameter, column) for parameter in parameters for column in columns]
    figure, axes = panels(len(names), len(cells))
    for place, group in enumerate(names):
        for letter, axis, (parameter, column) in zip("abcd", axes[place], cells):
            for method, colour in GPU.items():
                lines = select(table, scenes=group, parameter=parameter, method=method)
                if lines:
                    bars(axis, lines, "value", column, color=colour, label=NAMES[method])
            for right in select(table, scenes=group, method="gl_exact"):
                axis.axhline(right[column], color=EXACT, linewidth=1.4, label="gl_exact")
            axis.set(xlabel=X_LABELS[parameter], ylabel=label_of(column),
                     title=f"({letter}) {group}")
            from_zero(axis)
            if place == 0:
                legend_above(axis, 1)
    return figure


def draw_3_16(table):
    names = values(table, "scenes")
    parameters = ("initial_tile_px", "initial_grid_radius_px")
    figure, axes = panels(len(names), 2)
    for place, group in enumerate(names):
        for letter, axis, parameter in zip("ab", axes[place], parameters):
            for steps, style in (("all", "-"), ("≤ 32", "--")):
                lines = select(table, scenes=group, parameter=parameter, steps=steps)
                bars(axis, lines, "value", "distance_error_mm", linestyle=style,
                     color=GPU[lines[0]["method"]], label=f"steps {steps}")
            axis.set(xlabel=X_LABELS[parameter], ylabel=label_of("distance_error_mm"),
                     title=f"({letter}) {group}")
            from_zero(axis)
            if place == 0:
                legend_above(axis)
    return figure


FIGURES = {
    "3.13": (with_exact(table_of_steps),
             lambda table: draw(table, ["time_ms", "distance_error_mm"])),
    "3.14": (table_of_steps,
             lambda table: draw(table, ["robot_point_error_mm", "obstacle_point_error_mm"])),
    "3.15": (with_exact(table_of_sizes), lambda table: draw(table, ["time_ms"])),
    "3.16": (table_of_few_and_all_steps, draw_3_16),
}
