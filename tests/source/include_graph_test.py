#!/usr/bin/env python3
"""What include_graph.py finds, and what it leaves alone."""
import unittest

from include_graph import going_up, ranks

RANKS = ranks("# In order.\nadd_subdirectory(types)\nadd_subdirectory(distance)\nadd_subdirectory(image_distance)\n"
              "if(BERTH_OPENGL)\n  add_subdirectory(image_distance/opengl)\nendif()\n")


def up(file, *includes):
    text = "".join(f'#include "{included}"\n' for included in includes)
    return [included for _, included in going_up({file: text}, RANKS)]


class IncludeGraph(unittest.TestCase):
    def test_up(self):
        self.assertEqual(up("berth/types/image.hpp", "berth/image_distance/evaluate.hpp"), ["berth/image_distance/evaluate.hpp"])
        for above in ("berth/image_distance/opengl/gl_frame.hpp", "berth/berth.hpp", "apps/berth/arguments.hpp", "lab/measure/errors.hpp",
                      "tests/support/scenes.hpp"):
            self.assertEqual(up("berth/distance/settings.cpp", above), [above])
        for above in ("sim/random.hpp", "lab/measure/errors.hpp"):
            self.assertEqual(up("apps/berth/output.cpp", above), [above])
        for file in ("sim/random.hpp", "lab/measure/errors.hpp"):
            self.assertEqual(up(file, "tests/support/scenes.hpp"), ["tests/support/scenes.hpp"])
        self.assertEqual(up("sim/random.hpp", "lab/measure/errors.hpp"), ["lab/measure/errors.hpp"])

    def test_down_and_beside(self):
        self.assertEqual(up("berth/image_distance/opengl/gl_frame.cpp", "berth/image_distance/opengl/gl_frame.hpp", "berth/types/image.hpp"), [])
        self.assertEqual(up("apps/berth/output.cpp", "berth/image_distance/opengl/gl_frame.hpp", "apps/support/program.hpp"), [])
        self.assertEqual(up("berth/image_distance/settings.cpp", "hwy/highway.h"), [])

    def test_a_folder_of_its_own_inside_another(self):
        self.assertEqual(up("berth/image_distance/evaluate.cpp", "berth/image_distance/opengl/gl_frame.hpp"),
                         ["berth/image_distance/opengl/gl_frame.hpp"])
        self.assertEqual(up("berth/image_distance/evaluate.cpp", "berth/image_distance/exact/search.hpp"), [])

    def test_a_header_for_users_has_no_place(self):
        self.assertEqual(up("berth/berth.hpp", "berth/image_distance/opengl/gl_frame.hpp"), [])


if __name__ == "__main__":
    unittest.main()
