#!/usr/bin/env python3
"""What include_graph.py finds, and what it leaves alone."""
import unittest

from include_graph import going_up, ranks

RANKS = ranks("# In order.\nadd_subdirectory(types)\nadd_subdirectory(distance)\nadd_subdirectory(scene)\n")


def up(file, *includes):
    text = "".join(f'#include "{included}"\n' for included in includes)
    return [included for _, included in going_up({file: text}, RANKS)]


class IncludeGraph(unittest.TestCase):
    def test_up(self):
        self.assertEqual(up("berth/types/image.hpp", "berth/scene/open_scene.hpp"), ["berth/scene/open_scene.hpp"])
        for above in ("thesis/opengl/gl_frame.hpp", "berth/berth.hpp", "apps/berth/arguments.hpp", "lab/measure/errors.hpp",
                      "tests/support/scenes.hpp"):
            self.assertEqual(up("berth/distance/settings.cpp", above), [above])
        for above in ("sim/random.hpp", "lab/measure/errors.hpp"):
            self.assertEqual(up("apps/berth/output.cpp", above), [above])
        for file in ("sim/random.hpp", "lab/measure/errors.hpp"):
            self.assertEqual(up(file, "tests/support/scenes.hpp"), ["tests/support/scenes.hpp"])
        self.assertEqual(up("sim/random.hpp", "lab/measure/errors.hpp"), ["lab/measure/errors.hpp"])

    def test_down_and_beside(self):
        self.assertEqual(up("thesis/opengl/gl_frame.cpp", "thesis/opengl/gl_frame.hpp", "berth/types/image.hpp"), [])
        self.assertEqual(up("apps/berth/output.cpp", "thesis/opengl/gl_frame.hpp", "apps/support/program.hpp"), [])
        self.assertEqual(up("thesis/settings.cpp", "hwy/highway.h", "berth/scene/open_scene.hpp"), [])

    def test_a_folder_of_its_own_inside_another(self):
        self.assertEqual(up("thesis/evaluate.cpp", "thesis/study/page.hpp"), ["thesis/study/page.hpp"])
        self.assertEqual(up("thesis/study/page.cpp", "thesis/evaluate.hpp", "lab/measure/stopwatch.hpp"), [])
        self.assertEqual(up("thesis/evaluate.cpp", "thesis/exact/search.hpp"), [])

    def test_a_header_for_users_has_no_place(self):
        self.assertEqual(up("berth/berth.hpp", "thesis/opengl/gl_frame.hpp"), [])


if __name__ == "__main__":
    unittest.main()
