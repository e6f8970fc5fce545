"""What the thesis found, figure by figure, and the rule that tells whether it holds here.

A rule takes the rows of one scene and gives (whether the finding holds there, the number that it
was judged by), or None where the scene has nothing to judge by. It holds here where it holds on
nine of ten scenes, and in part where it does on half of them.
"""
from dataclasses import dataclass
from typing import Callable

import numpy

from figures_length import fastest
from measurements import missed_share, over_sets, pooled_error, rank_correlation, scenes_of, set_means

HOLDS = "holds"
IN_PART = "holds in part"
FAILS = "does not hold"


@dataclass
class Finding:
    figure: str
    """What the thesis says, in short."""
    claim: str
    """What the number is that judges it; `{}` stands for its median over the scenes."""
    number: str
    rule: Callable
    """Judged on the worst case alone."""
    on_worst_case: bool = False


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
    """The mean errors of the fastest set of each step_x + step_y, and those of all of them."""
    rows = parameters(rows)
    sums = rows["step_x"] + rows["step_y"]
    parts = [rows.take(sums == both) for both in numpy.unique(sums)]
    found = [(fastest(part)["distance_error_mm"], distance_error(part)) for part in parts]
    return numpy.nanmean(found, axis=0)


def fastest_errs_more(rows):
    best, mean = errors_of_the_fastest(rows)
    return best > mean, ratio(best, mean)


def fastest_is_acceptable(rows):
    best, _ = errors_of_the_fastest(rows)
    return best <= 5, best


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
    if numpy.std(error) == 0:
        return None
    tenths = numpy.array_split(error[numpy.argsort(time)], 10)
    within = numpy.sqrt(numpy.mean([numpy.var(tenth) for tenth in tenths if len(tenth)]))
    return within >= 0.5 * numpy.std(error), within / numpy.std(error)


def fast_within_5_mm(rows):
    times = [found["time_ms"] for found in set_means(parameters(rows))
             if found["distance_error_greatest_mm"] <= 5 and found["links_missed_percent"] == 0]
    return min(times, default=numpy.inf) <= 2.2, min(times, default=numpy.inf)


def worst_case_time(rows, part):
    times = sorted(found["time_ms"] for found in set_means(rows.where(part=part)))
    return times[:30][-1]


def worst_case_with_every_pair(rows):
    time_ms = worst_case_time(rows, "every_pair")
    return time_ms <= 10, time_ms


def worst_case_that_shrinks(rows):
    time_ms = worst_case_time(rows, "parameters")
    return time_ms <= 10, time_ms


FINDINGS = [
    Finding("3.5", "Brute force computes more pairs the larger 2L is, until the region is the "
            "whole image; then no more.",
            "pairs at the greatest 2L are {:.3g} times those at the one before", pairs_grow_then_stay),
    Finding("3.5", "Its time does what the pairs do.",
            "rank correlation of time and pairs {:.2f}", time_grows_with_pairs),
    Finding("3.6", "The spiral is the slowest search pattern.",
            "spiral takes {:.2f} times as long as row_major", spiral_is_slowest),
    Finding("3.6", "The plain loop over rows is the fastest.",
            "row_major takes {:.2f} times as long as oscillating", row_major_is_fastest),
    Finding("3.6", "All patterns compute almost the same number of pairs.",
            "the most are {:.2f} times the fewest", patterns_compute_alike),
    Finding("3.7", "The more obstacle pixels are skipped, the fewer pairs.",
            "pairs with step 4 are {:.2f} times those with step 1", skipping_saves_pairs),
    Finding("3.7", "Above a bound, larger steps save no more pairs: the last step skips nothing.",
            "pairs with step 32 are {:.2f} times those with step 8", skipping_has_a_floor),
    Finding("3.8", "The time follows the pairs.",
            "correlation of time and pairs over 2L and steps {:.2f}", time_follows_pairs),
    Finding("3.9", "Even with steps of 32 the mean error of the distance is below 2 mm.",
            "{:.2f} mm", error_is_small_at_32),
    Finding("3.9", "Each link in range gets a distance (the thesis shows no link that was passed "
            "over, and warns of small objects).",
            "{:.2f} % of the links in range are not found", nothing_is_missed),
    Finding("3.10", "The initial grid radius shows no clear trend in the error.",
            "rank correlation of radius and error {:.2f}", initial_radius_has_no_trend),
    Finding("3.10", "The larger the final grid radius, the smaller the error.",
            "the error with the greatest is {:.2f} times that with the least",
            final_radius_saves_error),
    Finding("3.11", "Initial radii of 40 to 100 px take about the same time.",
            "the slowest takes {:.2f} times as long as the fastest", initial_radius_hardly_matters),
    Finding("3.11", "The final radius matters more to the time than the initial one.",
            "the slowest final radius takes {:.2f} times as long as the fastest",
            final_radius_matters_more),
    Finding("3.12", "The fastest parameters need about 70 ms at 2L = 0.8 m (judged: no more).",
            "{:.2f} ms", fastest_at_800_mm),
    Finding("3.12", "The fastest parameters err more than the mean of all.",
            "{:.2f} times the mean error", fastest_errs_more),
    Finding("3.12", "Their distance is still acceptable (judged: 5 mm in the mean).",
            "{:.2f} mm", fastest_is_acceptable),
    Finding("3.17", "The slower a parameter set, the more accurate.",
            "rank correlation of time and error {:.2f}", slower_is_more_accurate),
    Finding("3.17", "The scatter is wide: sets of the same time differ much in error.",
            "the deviation among sets of like time is {:.2f} of that of all", scatter_is_wide),
    Finding("3.18", "2.2 ms are enough for at most 5 mm at every link (on the GTX 660).",
            "the fastest set that keeps to it on a scene takes {:.2f} ms", fast_within_5_mm),
    Finding("3.19", "The worst case takes little more, 1 to 10 ms (on the GTX 660; judged: the 30 "
            "fastest within 10 ms when every pair is computed, as there).",
            "the slowest of the 30 takes {:.3g} ms", worst_case_with_every_pair, True),
    Finding("3.19", "The same when the region shrinks, as the thesis's CPU algorithm does: the "
            "distance there is 0, and found at once.",
            "the slowest of the 30 takes {:.3g} ms", worst_case_that_shrinks, True),
]


@dataclass
class Verdict:
    finding: Finding
    verdict: str
    """Scenes on which it holds, and scenes that were judged."""
    holds: int
    scenes: int
    number: str


def judge(finding, rows):
    """None where no scene has anything to judge it by."""
    names = (rows.where(kind="worst_case").values("scene") if finding.on_worst_case
             else scenes_of(rows))
    results = [finding.rule(rows.where(scene=name)) for name in names]
    results = [result for result in results if result is not None]
    if not results:
        return None
    share = sum(bool(holds) for holds, _ in results) / len(results)
    verdict = HOLDS if share >= 0.9 else IN_PART if share >= 0.5 else FAILS
    middle = float(numpy.median([number for _, number in results]))
    number = (finding.number.format(middle) if numpy.isfinite(middle)
              else "on half of the scenes there is none")
    return Verdict(finding, verdict, round(share * len(results)), len(results), number)
