"""installed_includes.py finds what is not installed, and nothing else."""
import unittest

from installed_includes import installed, missing


class InstalledIncludes(unittest.TestCase):
    TEXTS = {"berth/a.hpp": '#include "berth/b.hpp"\n#include <vector>\n', "berth/b.hpp": '#include "berth/a.hpp"\n'}

    def test_what_a_listed_header_includes_is_installed(self):
        self.assertEqual(installed(["berth/a.hpp"], self.TEXTS.get), {"berth/a.hpp", "berth/b.hpp"})

    def test_others_are_found(self):
        texts = {"node.cpp": '#include <berth/a.hpp>\n#include "berth/c.hpp"\n#include "berth_ros/d.hpp"\n'}
        self.assertEqual(missing(texts, {"berth/a.hpp"}), [("node.cpp", "berth/c.hpp")])


if __name__ == "__main__":
    unittest.main()
