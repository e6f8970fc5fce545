#!/usr/bin/env python3
"""What versions.py takes for a version."""
import unittest

from versions import FORTHCOMING, TOLD, differing, newest_day, version_of

WHERE = dict(TOLD)


def told(pattern, text):
    return list(differing({"file": (text, WHERE[pattern])}, ["1.2.0"]))


class Versions(unittest.TestCase):
    def test_the_one_place(self):
        self.assertEqual(version_of("cmake_minimum_required(VERSION 3.22)\nproject(berth VERSION 1.2.0 LANGUAGES CXX\n"), "1.2.0")

    def test_each_place_is_read(self):
        texts = {"package.xml": "<package><version>{}</version>", "CHANGELOG.md": "# Changes\n\n## {}, 2026-01-31\n## 0.9.0\n",
                 "ros2/*/CHANGELOG.rst": "Changelog\n=========\n\n{} (2026-01-31)\n------------------\n\n0.9.0\n-----\n",
                 "debian/changelog": "berth ({}-1) unstable; urgency=medium\n\nberth (0.9.0-1) unstable\n"}
        for pattern, text in texts.items():
            self.assertEqual(told(pattern, text.format("1.2.0")), [], pattern)
            self.assertEqual(told(pattern, text.format("1.3.0")), [("file", "1.3.0")], pattern)
            self.assertEqual(told(pattern, "nothing"), [("file", "no version")], pattern)

    def test_what_ros_calls_forthcoming_is_allowed_until_the_release(self):
        text = "Changelog\n=========\n\nForthcoming\n-----------\n\n1.1.0\n-----\n"
        self.assertEqual(told("CHANGELOG.rst", text), [("file", FORTHCOMING)])
        self.assertEqual(list(differing({"file": (text, WHERE["CHANGELOG.rst"])}, ["1.2.0", FORTHCOMING])), [])

    def test_a_release_has_a_day(self):
        self.assertEqual(newest_day("# Changes\n\n## 1.2.0, 2026-01-31\n## 1.1.0, 2025-01-31\n"), "2026-01-31")
        self.assertIsNone(newest_day("# Changes\n\n## 1.2.0, not released yet\n## 1.1.0, 2025-01-31\n"))
        self.assertIsNone(newest_day("# Changes\n"))


if __name__ == "__main__":
    unittest.main()
