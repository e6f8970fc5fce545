#!/usr/bin/env python3
"""What unique_names.py finds, and what it leaves alone."""
import unittest

from unique_names import defined_twice, hidden_constants

CANVAS = "#pragma once\n// It's drawn on.\nnamespace berth {\nclass Canvas { int width; };\n}"


def names(*texts):
    return [name for name, _ in defined_twice(dict(enumerate(texts)))]


def hidden(header, other):
    return [name for name, _, _ in hidden_constants({"a.hpp": header, "b.cpp": other}, {"a.hpp"})]


class UniqueNames(unittest.TestCase):
    def test_the_same_name_twice(self):
        self.assertEqual(names(CANVAS, "namespace berth { struct Canvas : Base<int> { }; }"), ["berth::Canvas"])

    def test_enums_templates_and_alignment(self):
        for other in ("enum class Canvas : int { a, b };", "template <class T, class U = X<T>> struct Canvas {};",
                      "struct alignas(64) Canvas {};", "class [[nodiscard]] Canvas final {};"):
            self.assertEqual(names(CANVAS, "namespace berth { " + other + " }"), ["berth::Canvas"], other)

    def test_an_instruction_set_is_no_place_to_hide(self):
        other = "namespace berth {\nnamespace HWY_NAMESPACE {\nstruct Canvas {};\n}\n}"
        self.assertEqual(names(CANVAS, other), ["berth::Canvas"])

    def test_other_namespaces_are_other_names(self):
        for other in ("namespace berth::lab { class Canvas {}; }", "namespace berth { namespace { class Canvas {}; } }",
                      "namespace berth { struct Picture { class Canvas {}; }; }",
                      "namespace berth { void draw() { struct Canvas {}; } }"):
            self.assertEqual(names(CANVAS, other), [], other)

    def test_declarations_comments_and_texts_define_nothing(self):
        for other in ("class Canvas;", "// class Canvas {};", 'const char* t = "class Canvas {}";',
                      "struct Canvas draw() { }", "#define X struct Canvas { }", "template <class Canvas> struct Y {};"):
            self.assertEqual(names(CANVAS, "namespace berth { " + "\n" + other + "\n }"), [], other)

    def test_a_constant_that_hides_a_headers(self):
        header = "namespace berth {\ninline constexpr double kLeast = 0.01;\n}"
        for other in ("namespace { constexpr double kLeast = 0.5; }", "constexpr Range<int> kLeast[2][2] = {{1, f(2)}};",
                      "namespace { const std::string kLeast{}; }", "namespace HWY_NAMESPACE { constexpr int kLeast = kMost; }"):
            self.assertEqual(hidden(header, "namespace berth {\n" + other + "\n}"), ["kLeast"], other)

    def test_constants_that_hide_none_of_a_header(self):
        header = "namespace berth { inline constexpr double kLeast = 0.01; struct Node { static constexpr int kMost = 2; }; }"
        for other in ("namespace berth::lab { constexpr int kLeast = 1; }", "namespace berth { void f() { constexpr int kLeast = 1; } }",
                      "namespace berth { constexpr int kMost = Node::kMost; }", "namespace berth { constexpr int f(int x = kLeast) {} }",
                      "namespace berth { namespace { constexpr int kOther = kLeast; } }"):
            self.assertEqual(hidden(header, other), [], other)
        self.assertEqual(hidden_constants({"a.cpp": header, "b.cpp": header}, set()), [])


if __name__ == "__main__":
    unittest.main()
