#!/usr/bin/env python3
"""Each test that docs/evidence.md and ARCHITECTURE.md's invariants name is in the sources."""
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import evidence


class Evidence(unittest.TestCase):
    def test_no_test_that_a_page_names_is_gone(self):
        for page in ("docs/evidence.md", "ARCHITECTURE.md"):
            with self.subTest(page):
                text = (ROOT / page).read_text(encoding="utf-8")
                self.assertGreater(len(evidence.NAME.findall(text)), 20)
                self.assertEqual(evidence.gone(text), [])

    def test_one_that_is_gone_is_named(self):
        self.assertEqual(evidence.gone("`MeshCertified.AtEveryDeadline`, `MeshCertified.Never`, `ros2/none.py`"), ["MeshCertified.Never", "ros2/none.py"])

    def test_each_row_of_the_page_names_a_test(self):
        page = (ROOT / "docs/evidence.md").read_text(encoding="utf-8")
        rows = [line for line in page.splitlines() if line.startswith("| ") and not line.startswith(("| ---", "| promise", "| what if"))]
        self.assertGreater(len(rows), 25)
        for row in rows:
            self.assertTrue(evidence.NAME.search(row) or evidence.FILE.search(row), row)

    def test_the_outcome_stands_beside_the_name(self):
        self.assertEqual(evidence.with_outcomes("`A.B`, `C.D`", {"A.B": "passed"}), "`A.B` (passed), `C.D`")


if __name__ == "__main__":
    unittest.main()
