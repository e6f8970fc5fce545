"""The rules that judge the findings, figure by figure.

A rule takes the rows of one scene and gives (whether the finding holds there, the number that it
was judged by), or None where the scene has nothing to judge by.
"""
import numpy

from figures_length import fastest
from measurements import missed_share, over_sets, pooled_error, rank_correlation, set_means


def time_of(rows):
    return over_sets(rows, "time_ms")[0]


def pairs_of(rows):
    return over_sets(rows, "pairs")[0]


def distance_error(rows):
    return pooled_error(rows, "distance")[0]


def lengths(rows):
    return rows.where(part="surveillance_length")


def parameters(rows):
    return rows.where(part="parameters")


def ratio(a, b):
    return a / b if b > 0 else numpy.inf


def pairs_grow_then_stay(rows):
    pairs = [each["pairs"].mean() for _, each in
             rows.where(part="brute_force").by("surveillance_length_m")]
    if len(pairs) < 3:
        return None
    last = ratio(pairs[-1], pairs[-2])
    return all(numpy.diff(pairs) >= 0) and pairs[-1] > 2 * pairs[0] and last <= 1.02, last


def time_grows_with_pairs(rows):
    rows = rows.where(part="brute_force")
    if not len(rows):
        return None
    found = [rank_correlation(each["pairs"], each["time_ms"])
             for _, each in rows.by("search_pattern")]
    return min(found) >= 0.9, min(found)


def by_pattern(rows, measure):
    return {key[0]: measure(each) for key, each in lengths(rows).by("search_pattern")}


def spiral_is_slowest(rows):
    time = by_pattern(rows, time_of)
    return time["spiral"] == max(time.values()), time["spiral"] / time["row_major"]


def row_major_is_fastest(rows):
    time = by_pattern(rows, time_of)
    return time["row_major"] == min(time.values()), time["row_major"] / time["oscillating"]


def patterns_compute_alike(rows):
    pairs = by_pattern(rows, pairs_of).values()
    return ratio(max(pairs), min(pairs)) <= 1.1, ratio(max(pairs), min(pairs))


def by_step(rows, measure):
    return {key[0]: measure(each) for key, each in lengths(rows).by("step_x")}


def skipping_saves_pairs(rows):
    pairs = by_step(rows, pairs_of)
    return pairs[4] < pairs[1], ratio(pairs[4], pairs[1])


def skipping_has_a_floor(rows):
    pairs = by_step(rows, pairs_of)
    return ratio(pairs[32], pairs[8]) >= 0.8, ratio(pairs[32], pairs[8])


def time_follows_pairs(rows):
    cells = [(pairs_of(each), time_of(each))
             for _, each in lengths(rows).by("step_x", "surveillance_length_m")]
    found = float(numpy.corrcoef(*zip(*cells))[0, 1])
    return found >= 0.8, found


def error_is_small_at_32(rows):
    error = distance_error(parameters(rows).where(step_x=32, step_y=32))
    return error < 2, error


def nothing_is_missed(rows):
    missed = 100 * missed_share(parameters(rows))
    return missed == 0, missed


def initial_radius_has_no_trend(rows):
    found = [(key[0], distance_error(each))
             for key, each in parameters(rows).by("initial_grid_radius_px")]
    trend = rank_correlation(*zip(*found))
    return not abs(trend) >= 0.65, trend


def by_final(rows, measure):
    return {key[0]: measure(each) for key, each in parameters(rows).by("final_grid_radius_px")}


def final_radius_saves_error(rows):
    error = by_final(rows, distance_error)
    first, last = error[min(error)], error[max(error)]
    return last < 0.98 * first, ratio(last, first)


def initial_ratio(rows):
    rows = parameters(rows)
    rows = rows.take(rows["initial_grid_radius_px"] >= 40)
    time = [time_of(each) for _, each in rows.by("initial_grid_radius_px")]
    return max(time) / min(time)


def final_ratio(rows):
    time = by_final(rows, time_of).values()
    return max(time) / min(time)


def initial_radius_hardly_matters(rows):
    return initial_ratio(rows) <= 1.25, initial_ratio(rows)


def final_radius_matters_more(rows):
    return final_ratio(rows) > initial_ratio(rows), final_ratio(rows)


def fastest_at_800_mm(rows):
    time_ms = fastest(lengths(rows).where(surveillance_length_m=0.8))["time_ms"]
    return time_ms <= 70, time_ms


def errors_of_the_fastest(rows):
    """The mean errors of the fastest set of each step_x + step_y, and those of all of them; None
    where none of them has an error."""
    rows = parameters(rows)
    sums = rows["step_x"] + rows["step_y"]
    parts = [rows.take(sums == both) for both in numpy.unique(sums)]
    found = [(fastest(part)["distance_error_mm"], distance_error(part)) for part in parts]
    found = [pair for pair in found if numpy.all(numpy.isfinite(pair))]
    return numpy.mean(found, axis=0) if found else None


def fastest_errs_more(rows):
    errors = errors_of_the_fastest(rows)
    if errors is None:
        return None
    best, mean = errors
    return best > mean, ratio(best, mean)


def fastest_is_acceptable(rows):
    errors = errors_of_the_fastest(rows)
    return None if errors is None else (errors[0] <= 5, errors[0])


def times_and_errors(rows):
    sets = [found for found in set_means(parameters(rows))
            if numpy.isfinite(found["distance_error_mm"])]
    return (numpy.array([found["time_ms"] for found in sets]),
            numpy.array([found["distance_error_mm"] for found in sets]))


def slower_is_more_accurate(rows):
    found = rank_correlation(*times_and_errors(rows))
    return found <= -0.1, found


def scatter_is_wide(rows):
    """The errors' deviation among sets of about the same time, over all errors' deviation."""
    time, error = times_and_errors(rows)
    if len(error) == 0 or numpy.std(error) == 0:
        return None
    tenths = numpy.array_split(error[numpy.argsort(time)], 10)
    within = numpy.sqrt(numpy.mean([numpy.var(tenth) for tenth in tenths if len(tenth)]))
    return within >= 0.5 * numpy.std(error), within / numpy.std(error)


def least_time_within_5_mm(rows):
    times = [found["time_ms"] for found in set_means(rows)
             if found["distance_error_greatest_mm"] <= 5 and found["links_missed_percent"] == 0]
    return min(times, default=numpy.inf) <= 2.2, min(times, default=numpy.inf)


def fast_within_5_mm(rows):
    return least_time_within_5_mm(parameters(rows))


def worst_case_time(rows, part):
    times = sorted(found["time_ms"] for found in set_means(rows.where(part=part)))
    return times[:30][-1]


def worst_case_with_every_pair(rows):
    time_ms = worst_case_time(rows, "every_pair")
    return time_ms <= 10, time_ms


def worst_case_that_shrinks(rows):
    time_ms = worst_case_time(rows, "parameters")
    return time_ms <= 10, time_ms


HYBRID, LATTICE = "gl_hybrid", "gl_lattice"


def on_gpu(rows, method):
    """None where it was not measured."""
    rows = rows.where(part=method)
    return rows if len(rows) else None


def of_both(measure):
    """A rule's number: what is measured of gl_lattice, over that of gl_hybrid."""
    def found(rows):
        lattice, hybrid = on_gpu(rows, LATTICE), on_gpu(rows, HYBRID)
        if lattice is None or hybrid is None:
            return None
        of_lattice, of_hybrid = measure(lattice), measure(hybrid)
        if numpy.isnan(of_lattice) or numpy.isnan(of_hybrid):
            return None
        return 1 if of_lattice == of_hybrid else ratio(of_lattice, of_hybrid)
    return found


def gpu_rasterization_is_faster(rows):
    found = of_both(time_of)(rows)
    return None if found is None else (found <= 0.5, found)


def beyond_32(what):
    def error(rows):
        return pooled_error(rows.take(rows["step_x"] > 32), what)[0]
    def rule(rows):
        found = of_both(error)(rows)
        return None if found is None else (found > 1, found)
    return rule


def tile_hardly_matters(rows):
    rows = on_gpu(rows, LATTICE)
    if rows is None:
        return None
    times = [time_of(each) for _, each in rows.by("initial_tile_px")]
    return max(times) / min(times) <= 1.25, max(times) / min(times)


def fastest_radius_errs_most(rows):
    """The error with the fastest initial radius, over the least that another has."""
    rows = on_gpu(rows, HYBRID)
    if rows is None:
        return None
    found = [(time_of(each), distance_error(each)) for _, each in rows.by("initial_grid_radius_px")]
    errors = [error for _, error in found]
    return (min(found)[1] == max(errors) > min(errors),
            ratio(min(found)[1], min(errors)) if max(errors) > 0 else 1)


def gpu_within_5_mm(rows):
    parts = [each for each in (on_gpu(rows, HYBRID), on_gpu(rows, LATTICE)) if each is not None]
    found = [least_time_within_5_mm(part) for part in parts]
    return min(found, key=lambda result: result[1]) if found else None


def gpu_worst_case(rows):
    rows = on_gpu(rows, LATTICE)
    if rows is None:
        return None
    time_ms = worst_case_time(rows, LATTICE)
    return time_ms <= 10, time_ms
