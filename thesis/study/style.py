"""How the figures look: one colour for a thing in all of them, safe for the colour-blind."""
import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.hashsalt": "berth", "font.size": 10, "axes.grid": True, "grid.color": "#e2e2e2",
    "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "legend.fontsize": 8.5, "axes.titlesize": 10, "axes.titlelocation":
    "left", "errorbar.capsize": 2.5, "savefig.dpi": 130})
from matplotlib import pyplot  # noqa: E402 (after the backend is chosen)
from matplotlib.ticker import EngFormatter  # noqa: E402

PATTERNS = {"row_major": "#0072B2", "oscillating": "#E69F00", "spiral": "#009E73"}
ERRORS = {"distance": "#222222", "robot_point": "#CC79A7", "obstacle_point": "#56B4E9"}
ERROR_NAMES = {"distance": "distance", "robot_point": "robot point",
               "obstacle_point": "obstacle point"}
GPU = {"gl_hybrid": "#0072B2", "gl_lattice": "#E69F00"}
TIME = "#0072B2"
PAIRS = "#882255"
MISSED = "#999999"
EXACT = "#D55E00"
LENGTH = "area of surveillance length 2L [m]"


def shades(count):
    """From dark to light, for values that have an order."""
    return [matplotlib.colormaps["viridis"](0.85 * i / max(1, count - 1)) for i in range(count)]


def panels(rows, columns, height=3.0):
    """A figure with a grid of axes, always a list of lists."""
    figure, axes = pyplot.subplots(rows, columns, squeeze=False, layout="constrained",
                                   figsize=(4.6 * columns, height * rows))
    return figure, axes


def from_zero(axes):
    """Where all is 0 the axis would have a range without a meaning."""
    axes.set_ylim(bottom=0, top=None if axes.dataLim.ymax > 0 else 1)


def many(axes):
    """A vertical axis of large numbers: 50 k, 2 M."""
    axes.yaxis.set_major_formatter(EngFormatter(sep="\N{THIN SPACE}"))


def legend_above(axes, columns=2, title=None, **entries):
    """Outside, where it covers no data."""
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1.08), ncols=columns, borderaxespad=0,
                title=title, title_fontsize=8.5, alignment="left", **entries)


def bars(axes, table, x, name, **style):
    """Means with deviations as the thesis's: a line, and a bar at each point."""
    style = {"marker": "o", "markersize": 3.5, "linewidth": 1.4, "elinewidth": 0.9} | style
    axes.errorbar([row[x] for row in table], [row[name] for row in table],
                  yerr=[row[f"{name}_deviation"] for row in table], **style)


def select(table, **values):
    return [row for row in table if all(row[name] == value for name, value in values.items())]


def values(table, name):
    """In the order of the table."""
    return list(dict.fromkeys(row[name] for row in table))
