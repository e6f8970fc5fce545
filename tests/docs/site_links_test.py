#!/usr/bin/env python3
"""Which links docs/site/links.py takes for lost."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "docs/site"))
from links import check  # noqa: E402


class SiteLinks(unittest.TestCase):
    def test_lost_links_are_found_and_others_are_not(self):
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder)
            (site / "api/cpp").mkdir(parents=True)
            (site / "picture one.png").write_text("")
            (site / "api/cpp/class.html").write_text('<a id="there"></a><a href="not looked at">x</a>')
            (site / "index.html").write_text(
                '<h1 id="top">x</h1><a href="#top">x</a><a href="#gone">x</a><img src="picture%20one.png"><img src="no.png">'
                '<a href="api/cpp/class.html#there">x</a><a href="api/cpp/class.html#gone">x</a><a href="https://example.org/">x</a>'
                '<a href="mailto:somebody">x</a><a href="">x</a>')
            elsewhere, lost = check(site)
            self.assertEqual(elsewhere, {"https://example.org/", "mailto:somebody"})
            self.assertEqual(lost, [("index.html", "#gone", "no such anchor"), ("index.html", "no.png", "no such file"),
                                    ("index.html", "api/cpp/class.html#gone", "no such anchor")])


if __name__ == "__main__":
    unittest.main()
