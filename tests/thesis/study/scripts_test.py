"""The averages and the rules behind the study's page, on rows made by hand."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "thesis" / "study"))

import numpy  # noqa: E402

import figures_gpu  # noqa: E402
import findings  # noqa: E402
import make_page  # noqa: E402
from measurements import (Rows, groups, missed_share, over_sets, pooled_error,  # noqa: E402
                          rank_correlation, set_means)

USUAL = {"scene": "a", "kind": "bundled", "part": "parameters", "method": "lattice",
         "initial_tile_px": numpy.nan,
         "region": "cube_projection", "shrinking": "per_link", "search_pattern": "row_major",
         "surveillance_length_m": 2.0, "step_x": 1.0, "step_y": 1.0,
         "initial_grid_radius_px": 40.0, "final_grid_radius_px": 2.0, "time_ms": 1.0, "pairs": 10.0,
         "links_in_range": 4.0, "links_missed": 0.0}
USUAL |= {f"{what}_error_{kind}_mm": 0.0 for what in ("distance", "robot_point", "obstacle_point")
          for kind in ("mean", "deviation", "greatest")}


def rows(*lines):
    lines = [USUAL | line for line in lines]
    names = dict.fromkeys(name for line in lines for name in line)
    return Rows({name: numpy.array([line.get(name, numpy.nan) for line in lines])
                 for name in names})


def verdict(figure, place, *lines):
    """Of the place-th finding of a figure."""
    found = [each for each in findings.FINDINGS if each.figure == figure][place]
    return findings.judge(found, rows(*lines))


class Averages(unittest.TestCase):
    def test_errors_are_pooled_over_the_links_that_have_one(self):
        # 2 mm and 4 mm; then 9 mm three times; a link that was not found has none.
        mean, deviation, greatest = pooled_error(rows(
            {"links_in_range": 2.0, "distance_error_mean_mm": 3.0,
             "distance_error_deviation_mm": 1.0, "distance_error_greatest_mm": 4.0},
            {"links_in_range": 4.0, "links_missed": 1.0, "distance_error_mean_mm": 9.0,
             "distance_error_greatest_mm": 9.0},
            {"links_in_range": 2.0, "links_missed": 2.0, "distance_error_mean_mm": numpy.nan}),
            "distance")
        values = [2, 4, 9, 9, 9]
        self.assertAlmostEqual(mean, numpy.mean(values))
        self.assertAlmostEqual(deviation, numpy.std(values))
        self.assertEqual(greatest, 9)

    def test_missed_links_are_a_share_of_those_in_range(self):
        self.assertAlmostEqual(missed_share(rows({"links_missed": 1.0}, {"links_in_range": 6.0})),
                               0.1)

    def test_deviation_is_over_sets_not_over_scenes(self):
        table = rows({"time_ms": 1.0}, {"time_ms": 3.0, "scene": "b"},
                     {"time_ms": 5.0, "step_x": 2.0}, {"time_ms": 7.0, "scene": "b", "step_x": 2.0})
        mean, deviation = over_sets(table, "time_ms")
        self.assertEqual((mean, deviation), (4, 2))

    def test_sets_are_averaged_over_the_scenes(self):
        found = list(set_means(rows({"time_ms": 1.0}, {"time_ms": 3.0, "scene": "b"})))
        self.assertEqual(len(found), 1)
        self.assertEqual(found[0]["time_ms"], 2)

    def test_sets_without_a_parameter_are_one_set(self):
        table = rows({"final_grid_radius_px": numpy.nan},
                     {"final_grid_radius_px": numpy.nan, "scene": "b"}, {})
        self.assertEqual(len(list(set_means(table))), 2)

    def test_the_worst_case_is_in_no_group(self):
        table = rows({}, {"scene": "b", "kind": "drawn"}, {"scene": "w", "kind": "worst_case"})
        self.assertEqual([(name, len(each)) for name, each in groups(table)],
                         [("bundled scene", 1), ("2 scenes", 2)])

    def test_rank_correlation_is_spearmans(self):
        self.assertAlmostEqual(rank_correlation([1, 2, 3, 4], [1, 10, 100, 101]), 1)
        self.assertAlmostEqual(rank_correlation([1, 2, 3, 4], [9, 8, 2, 1]), -1)
        self.assertAlmostEqual(rank_correlation([1, 2, 2, 3], [1, 2, 3, 4]), 0.9486833)
        self.assertTrue(numpy.isnan(rank_correlation([1, 2], [1, 1])))


class Findings(unittest.TestCase):
    def test_a_finding_holds_by_the_share_of_scenes(self):
        def scenes(good, bad):
            lines = []
            for i in range(good + bad):
                slow = 3.0 if i < good else 0.1
                lines += [{"scene": f"s{i}", "part": "surveillance_length",
                           "search_pattern": pattern, "time_ms": time}
                          for pattern, time in (("row_major", 1.0), ("oscillating", 2.0),
                                                ("spiral", slow))]
            return verdict("3.6", 0, *lines)
        for good, bad, expected in ((10, 0, findings.HOLDS), (9, 1, findings.HOLDS),
                                    (8, 2, findings.IN_PART), (5, 5, findings.IN_PART),
                                    (4, 6, findings.FAILS)):
            found = scenes(good, bad)
            self.assertEqual(found.verdict, expected, (good, bad))
            self.assertEqual((found.holds, found.scenes), (good, good + bad))

    def test_a_finding_without_rows_has_no_verdict(self):
        self.assertIsNone(verdict("3.5", 0, {}))

    def test_brute_force_grows_until_it_is_flat(self):
        def pairs(*counts):
            return verdict("3.5", 0, *({"part": "brute_force", "surveillance_length_m": float(i),
                                        "pairs": count} for i, count in enumerate(counts)))
        self.assertEqual(pairs(1.0, 5.0, 9.0, 9.0).verdict, findings.HOLDS)
        self.assertEqual(pairs(1.0, 5.0, 9.0, 12.0).verdict, findings.FAILS)
        self.assertEqual(pairs(1.0, 5.0, 4.0, 4.0).verdict, findings.FAILS)

    def test_an_error_of_2_mm_at_steps_of_32_is_too_large(self):
        for error, expected in ((1.9, findings.HOLDS), (2.1, findings.FAILS)):
            found = verdict("3.9", 0, {"step_x": 32.0, "step_y": 32.0,
                                       "distance_error_mean_mm": error},
                            {"distance_error_mean_mm": 50.0})
            self.assertEqual(found.verdict, expected)

    def test_a_fast_set_that_misses_a_link_does_not_keep_to_5_mm(self):
        slow = {"time_ms": 2.0, "distance_error_greatest_mm": 4.0}
        fast = {"time_ms": 0.5, "step_x": 2.0, "links_missed": 1.0}
        found = verdict("3.18", 0, slow, fast)
        self.assertEqual(found.verdict, findings.HOLDS)
        self.assertIn("2.00 ms", found.number)
        self.assertEqual(verdict("3.18", 0, slow | {"distance_error_greatest_mm": 6.0}).verdict,
                         findings.FAILS)

    def test_the_worst_case_is_judged_alone(self):
        found = verdict("3.19", 0, {"time_ms": 500.0},
                        {"scene": "w", "kind": "worst_case", "part": "every_pair", "time_ms": 9.0})
        self.assertEqual((found.verdict, found.scenes), (findings.HOLDS, 1))


    def test_gpu_rasterization_is_judged_against_cpu_rasterization(self):
        def judged(figure, place, lattice, hybrid):
            return verdict(figure, place, {"part": "gl_lattice"} | lattice,
                           {"part": "gl_hybrid"} | hybrid)
        self.assertIsNone(verdict("3.13", 0, {}))
        self.assertIsNone(verdict("3.13", 0, {"part": "gl_lattice"}))
        for time, expected in ((1.9, findings.HOLDS), (2.1, findings.FAILS)):
            self.assertEqual(judged("3.13", 0, {"time_ms": time}, {"time_ms": 4.0}).verdict,
                             expected)
        for figure, place, what in (("3.13", 1, "distance"), ("3.14", 0, "robot_point"),
                                    ("3.14", 1, "obstacle_point")):
            error = f"{what}_error_mean_mm"
            for step, ours, expected in ((64.0, 9.0, findings.HOLDS), (64.0, 7.0, findings.FAILS)):
                found = judged(figure, place, {"step_x": step, error: ours},
                               {"step_x": step, error: 8.0})
                self.assertEqual(found.verdict, expected, (figure, place))
            self.assertIsNone(judged(figure, place, {"step_x": 32.0, error: 9.0},
                                     {"step_x": 32.0, error: 8.0}))

    def test_sizes_on_the_gpu_are_judged_by_time_and_error(self):
        for time, expected in ((1.2, findings.HOLDS), (1.3, findings.FAILS)):
            found = verdict("3.15", 0, *({"part": "gl_lattice", "initial_tile_px": tile,
                                          "time_ms": each} for tile, each in ((16.0, 1.0),
                                                                              (32.0, time))))
            self.assertEqual(found.verdict, expected)
        for error, expected in ((5.0, findings.HOLDS), (3.0, findings.FAILS)):
            found = verdict("3.16", 0, *({"part": "gl_hybrid", "initial_grid_radius_px": radius,
                                          "time_ms": time, "distance_error_mean_mm": each}
                                         for radius, time, each in ((10.0, 2.0, 4.0),
                                                                    (100.0, 1.0, error))))
            self.assertEqual(found.verdict, expected)

    def test_the_gpu_is_judged_by_the_better_method_and_the_worst_case_alone(self):
        good = {"part": "gl_hybrid", "time_ms": 2.0, "distance_error_greatest_mm": 4.0}
        bad = {"part": "gl_lattice", "time_ms": 0.5, "distance_error_greatest_mm": 6.0}
        self.assertEqual(verdict("3.18", 1, good, bad).verdict, findings.HOLDS)
        self.assertEqual(verdict("3.18", 1, good | {"time_ms": 2.3}, bad).verdict, findings.FAILS)
        self.assertEqual(verdict("3.19", 2, {"part": "gl_lattice", "time_ms": 50.0},
                                 {"scene": "w", "kind": "worst_case", "part": "gl_lattice",
                                  "time_ms": 9.0}).verdict, findings.HOLDS)

    def test_what_times_a_gpu_is_told_from_what_does_not(self):
        times = [each.figure for each in findings.FINDINGS if each.times_a_gpu]
        self.assertEqual(times, ["3.13", "3.15", "3.16", "3.18", "3.19"])


class Page(unittest.TestCase):
    def test_names_the_recordings_but_not_where_they_lie(self):
        study = {"commit": "abc", "recordings": "/home/me/arm/scene.yaml, /srv/hand/scene.yaml"}
        arm, hand = ({"scene": f"Recording {name}; frame 3", "kind": "recording"}
                     for name in ("arm", "hand"))
        found = make_page.facts(study, rows({}, arm, hand))
        self.assertIn("<td>Recording arm; frame 3, Recording hand; frame 3</td>", found)
        self.assertIn("<td>abc</td>", found)
        self.assertNotIn("/home", found)
        self.assertIn("<td>none</td>", make_page.facts(study, rows({})))


class GpuFigures(unittest.TestCase):
    def test_are_empty_without_the_methods_and_drawn_with_them(self):
        lattice = [{"step_x": step, "initial_grid_radius_px": radius}
                   for step in (1.0, 8.0) for radius in (20.0, 40.0)]
        hybrid = [line | {"method": "gl_hybrid"} for line in lattice]
        tiles = [{"method": "gl_lattice", "step_x": step, "initial_grid_radius_px": numpy.nan,
                  "final_grid_radius_px": numpy.nan, "initial_tile_px": tile}
                 for step in (1.0, 8.0) for tile in (16.0, 32.0)]
        for make, draw in figures_gpu.FIGURES.values():
            self.assertEqual(make(rows(*lattice)), [])
            table = make(rows(*lattice, *hybrid, *tiles))
            self.assertEqual({line["method"] for line in table}, {"gl_hybrid", "gl_lattice"})
            draw(table).savefig("/dev/null", format="svg")


if __name__ == "__main__":
    unittest.main()
