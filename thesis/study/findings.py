"""What the thesis found, figure by figure, and whether it holds here: where its rule does on nine
of ten scenes, and in part where it does on half of them.
"""
from dataclasses import dataclass
from typing import Callable

import numpy

import rules
from measurements import scenes_of

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
    """Not judged where OpenGL runs on the processor."""
    times_a_gpu: bool = False


FINDINGS = [
    Finding("3.5", "Brute force computes more pairs the larger 2L is, until the region is the "
            "whole image; then no more.",
            "pairs at the greatest 2L are {:.3g} times those at the one before",
            rules.pairs_grow_then_stay),
    Finding("3.5", "Its time does what the pairs do.",
            "rank correlation of time and pairs {:.2f}", rules.time_grows_with_pairs),
    Finding("3.6", "The spiral is the slowest search pattern.",
            "spiral takes {:.2f} times as long as row_major", rules.spiral_is_slowest),
    Finding("3.6", "The plain loop over rows is the fastest.",
            "row_major takes {:.2f} times as long as oscillating", rules.row_major_is_fastest),
    Finding("3.6", "All patterns compute almost the same number of pairs.",
            "the most are {:.2f} times the fewest", rules.patterns_compute_alike),
    Finding("3.7", "The more obstacle pixels are skipped, the fewer pairs.",
            "pairs with step 4 are {:.2f} times those with step 1", rules.skipping_saves_pairs),
    Finding("3.7", "Above a bound, larger steps save no more pairs: the last step skips nothing.",
            "pairs with step 32 are {:.2f} times those with step 8", rules.skipping_has_a_floor),
    Finding("3.8", "The time follows the pairs.",
            "correlation of time and pairs over 2L and steps {:.2f}", rules.time_follows_pairs),
    Finding("3.9", "Even with steps of 32 the mean error of the distance is below 2 mm.",
            "{:.2f} mm", rules.error_is_small_at_32),
    Finding("3.9", "Each link in range gets a distance (the thesis shows no link that was passed "
            "over, and warns of small objects).",
            "{:.2f} % of the links in range are not found", rules.nothing_is_missed),
    Finding("3.10", "The initial grid radius shows no clear trend in the error.",
            "rank correlation of radius and error {:.2f}", rules.initial_radius_has_no_trend),
    Finding("3.10", "The larger the final grid radius, the smaller the error.",
            "the error with the greatest is {:.2f} times that with the least",
            rules.final_radius_saves_error),
    Finding("3.11", "Initial radii of 40 to 100 px take about the same time.",
            "the slowest takes {:.2f} times as long as the fastest",
            rules.initial_radius_hardly_matters),
    Finding("3.11", "The final radius matters more to the time than the initial one.",
            "the slowest final radius takes {:.2f} times as long as the fastest",
            rules.final_radius_matters_more),
    Finding("3.12", "The fastest parameters need about 70 ms at 2L = 0.8 m (judged: no more).",
            "{:.2f} ms", rules.fastest_at_800_mm),
    Finding("3.12", "The fastest parameters err more than the mean of all.",
            "{:.2f} times the mean error", rules.fastest_errs_more),
    Finding("3.12", "Their distance is still acceptable (judged: 5 mm in the mean).",
            "{:.2f} mm", rules.fastest_is_acceptable),
    Finding("3.13", "GPU rasterization (gl_lattice) is much faster than CPU rasterization "
            "(gl_hybrid; judged: half the time).",
            "it takes {:.2f} times as long", rules.gpu_rasterization_is_faster, times_a_gpu=True),
    Finding("3.13", "Beyond steps of 32 the distances of GPU rasterization are worse than those of "
            "CPU rasterization.",
            "their error is {:.2f} times as large", rules.beyond_32("distance")),
    Finding("3.14", "Beyond steps of 32 the robot points of GPU rasterization are worse as well.",
            "their error is {:.2f} times as large", rules.beyond_32("robot_point")),
    Finding("3.14", "And so are its obstacle points.",
            "their error is {:.2f} times as large", rules.beyond_32("obstacle_point")),
    Finding("3.15", "The tile size hardly matters to the time.",
            "the slowest takes {:.2f} times as long as the fastest", rules.tile_hardly_matters,
            times_a_gpu=True),
    Finding("3.16", "The fastest initial radius is the least accurate.",
            "its error is {:.2f} times the least", rules.fastest_radius_errs_most,
            times_a_gpu=True),
    Finding("3.17", "The slower a parameter set, the more accurate.",
            "rank correlation of time and error {:.2f}", rules.slower_is_more_accurate),
    Finding("3.17", "The scatter is wide: sets of the same time differ much in error.",
            "the deviation among sets of like time is {:.2f} of that of all",
            rules.scatter_is_wide),
    Finding("3.18", "2.2 ms are enough for at most 5 mm at every link (on the GTX 660).",
            "the fastest lattice set that keeps to it on a scene takes {:.2f} ms",
            rules.fast_within_5_mm),
    Finding("3.18", "The same on the GPU here.",
            "the fastest set of gl_lattice and gl_hybrid that keeps to it on a scene takes "
            "{:.2f} ms", rules.gpu_within_5_mm, times_a_gpu=True),
    Finding("3.19", "The worst case takes little more, 1 to 10 ms (on the GTX 660; judged: the 30 "
            "fastest within 10 ms when every pair is computed, as there).",
            "the slowest of the 30 takes {:.3g} ms", rules.worst_case_with_every_pair, True),
    Finding("3.19", "The same when the region shrinks, as the thesis's CPU algorithm does: the "
            "distance there is 0, and found at once.",
            "the slowest of the 30 takes {:.3g} ms", rules.worst_case_that_shrinks, True),
    Finding("3.19", "The same on the GPU here, with gl_lattice.",
            "the slowest of the 30 takes {:.3g} ms", rules.gpu_worst_case, True,
            times_a_gpu=True),
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
    results = [result for result in results if result is not None and not numpy.isnan(result[1])]
    if not results:
        return None
    share = sum(bool(holds) for holds, _ in results) / len(results)
    verdict = HOLDS if share >= 0.9 else IN_PART if share >= 0.5 else FAILS
    middle = float(numpy.median([number for _, number in results]))
    number = (finding.number.format(middle) if numpy.isfinite(middle)
              else "on half of the scenes there is none")
    return Verdict(finding, verdict, round(share * len(results)), len(results), number)
