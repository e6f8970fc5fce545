"""The table that `berth_study` measured, and how it is averaged."""
import csv
import json

import numpy

TEXT = ("scene", "kind", "part", "method", "region", "shrinking", "search_pattern")
ERRORS = ("distance", "robot_point", "obstacle_point")


class Rows:
    """Lines of the table: rows["time_ms"] is a column, NaN where a cell is empty."""

    def __init__(self, columns):
        self.columns = columns

    def __len__(self):
        return len(self.columns["scene"])

    def __getitem__(self, name):
        return self.columns[name]

    def parameters(self):
        """The columns that tell a parameter set: those from the method to the first result."""
        names = list(self.columns)
        return names[names.index("method"):names.index("time_ms")]

    def take(self, mask):
        return Rows({name: values[mask] for name, values in self.columns.items()})

    def where(self, **values):
        """The lines in which each column named has the value."""
        mask = numpy.ones(len(self), bool)
        for name, value in values.items():
            mask &= self[name] == value
        return self.take(mask)

    def values(self, name):
        """The different values of a column, sorted, without NaN."""
        column = self[name]
        if name not in TEXT:
            column = column[~numpy.isnan(column)]
        return numpy.unique(column).tolist()

    def by(self, *names):
        """(values, rows) for each different combination of the columns' values, sorted."""
        keys = zip(*(self[name].tolist() for name in names))
        order = {}
        for place, key in enumerate(keys):
            # NaN differs from itself: a parameter that a method does not have.
            key = tuple(None if cell != cell else cell for cell in key)
            order.setdefault(key, []).append(place)
        def place_of(key):
            return [(cell is None, "" if cell is None else cell) for cell in key]
        for key in sorted(order, key=place_of):
            yield key, self.take(numpy.array(order[key]))


def read(folder):
    """(what the study is, its rows) of the folder that `berth_study` wrote."""
    with open(folder / "study.json", encoding="utf-8") as file:
        study = json.load(file)
    with open(folder / "measurements.csv", newline="", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    if not lines:
        raise SystemExit(f"{folder / 'measurements.csv'}: has no measurements; expected some")
    columns = {}
    for name in lines[0]:
        cells = [line[name] for line in lines]
        columns[name] = (numpy.array(cells) if name in TEXT else
                         numpy.array([float(cell) if cell else numpy.nan for cell in cells]))
    return study, Rows(columns)


def scenes_of(rows):
    """The names of the scenes but the worst case."""
    return rows.take(rows["kind"] != "worst_case").values("scene")


def groups(rows):
    """(name, rows): the bundled scene, which is like the thesis's, and all but the worst case."""
    rows = rows.take(rows["kind"] != "worst_case")
    count = len(rows.values("scene"))
    bundled = rows.where(kind="bundled")
    found = [("bundled scene", bundled)] if len(bundled) and count > 1 else []
    return found + [(f"{count} scenes" if count > 1 else rows.values("scene")[0], rows)]


def over_sets(rows, column):
    """(mean, deviation) over the parameter sets, each first averaged over the scenes."""
    means = [each[column].mean() for _, each in rows.by(*rows.parameters())]
    return float(numpy.mean(means)), float(numpy.std(means))


def pooled_error(rows, what):
    """(mean, deviation, greatest) of an error over all links of all rows, in mm; NaN if none."""
    count = rows["links_in_range"] - rows["links_missed"]
    rows, count = rows.take(count > 0), count[count > 0]
    if not len(rows):
        return (numpy.nan,) * 3
    mean, deviation = rows[f"{what}_error_mean_mm"], rows[f"{what}_error_deviation_mm"]
    of_all = numpy.average(mean, weights=count)
    of_squares = numpy.average(mean**2 + deviation**2, weights=count)
    return (float(of_all), float(numpy.sqrt(max(0.0, of_squares - of_all**2))),
            float(rows[f"{what}_error_greatest_mm"].max()))


def missed_share(rows):
    """The share of the links in range for which the method found nothing."""
    in_range = rows["links_in_range"].sum()
    return float(rows["links_missed"].sum() / in_range) if in_range else numpy.nan


def rank_correlation(a, b):
    """Spearman's, ties by their mean rank; NaN where one of both does not vary."""
    def ranks(values):
        _, place, count = numpy.unique(values, return_inverse=True, return_counts=True)
        return (numpy.cumsum(count) - (count - 1) / 2)[place]
    if len(a) < 2 or numpy.ptp(a) == 0 or numpy.ptp(b) == 0:
        return numpy.nan
    a, b = ranks(numpy.asarray(a)), ranks(numpy.asarray(b))
    # Values that are all missing have one rank.
    if numpy.ptp(a) == 0 or numpy.ptp(b) == 0:
        return numpy.nan
    return float(numpy.corrcoef(a, b)[0, 1])


def set_means(rows):
    """One dictionary for each parameter set, over the scenes: its parameters, time, errors."""
    names = rows.parameters()
    for key, each in rows.by(*names):
        found = dict(zip(names, key))
        found["time_ms"] = float(each["time_ms"].mean())
        found["pairs"] = float(each["pairs"].mean())
        found["links_missed_percent"] = 100 * missed_share(each)
        for what in ERRORS:
            mean, _, greatest = pooled_error(each, what)
            found[f"{what}_error_mm"] = mean
            found[f"{what}_error_greatest_mm"] = greatest
        yield found
