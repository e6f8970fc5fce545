#!/usr/bin/env python3
"""README.md and ARCHITECTURE.md quote speeds only between the markers that `make figures` fills."""
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "lab/bench"))
import figures

SPEED = re.compile(r"\d (?:ms|µs|us)\b|\d (?:answers|requests|configurations) a second|\d kHz")


def quoted(text):
    """The speeds outside of the markers."""
    outside = re.sub(r"(?s)<!-- figures -->.*?<!-- end of figures -->", "", text)
    return SPEED.findall(outside)


class Figures(unittest.TestCase):
    def test_pages_quote_no_speed_by_hand(self):
        for page in ("README.md", "ARCHITECTURE.md"):
            with self.subTest(page):
                self.assertEqual(quoted((ROOT / page).read_text(encoding="utf-8")), [])

    def test_a_speed_outside_of_the_markers_is_found(self):
        self.assertEqual(quoted("<!-- figures -->\n991 answers a second\n<!-- end of figures -->\nan image takes 5 ms"), ["5 ms"])

    def test_what_is_measured_takes_the_place_between_the_markers(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text("a\n<!-- figures -->\nold\n<!-- end of figures -->\nb\n")
            figures.put(page, "new\n")
            self.assertEqual(page.read_text(), "a\n<!-- figures -->\nnew\n<!-- end of figures -->\nb\n")
            page.write_text("a\n")
            with self.assertRaisesRegex(SystemExit, "page.md: expected one <!-- figures -->"):
                figures.put(page, "new\n")

    def test_a_row_has_what_was_measured_and_a_dash_for_what_was_not(self):
        none = {"p50": None, "p99": None}
        row = {"answers_per_s": 990.6, "ok_share": 0.5, "ask_us": {"p50": 440, "p99": 740, "p999": 1600, "max": 2000},
               "image_ms": {"p50": 6.8, "p99": 9.1}, "exposure_to_answer_ms": none, "gap_m": {"p50": 0.001, "p99": 0.007}}
        self.assertIn("| 3 cameras | 991 | 50 % | 0.44 / 0.74 / 1.6 / 2 | 6.8 / 9.1 | - / - | 1 / 7 |", figures.results_block("here", {"3 cameras": row}))


if __name__ == "__main__":
    unittest.main()
