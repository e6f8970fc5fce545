#!/usr/bin/env python3
"""What promises.py takes for a promise, and which changes it tells."""
import unittest
from xml.etree import ElementTree

from promises import by_key, cpp_names, messages, newest_section, python_names, schema_keys, unnamed, word_of


class Promises(unittest.TestCase):
    def test_a_message_is_its_fields_and_constants_in_their_order(self):
        text = "# What it is.\nuint8 OK = 0   # fine\n\nfloat32  distance_m\n"
        self.assertEqual(dict(messages({"ros2/m/msg/Link.msg": text})), {"message Link.msg": "uint8 OK = 0; float32 distance_m"})

    def test_a_schema_gives_each_key_by_its_path(self):
        schema = {"properties": {"a": {"description": "what", "type": "array", "items": {"required": ["b"], "properties": {"b": {"minimum": 0}}}}},
                  "$defs": {"space": {"properties": {"c": {"enum": ["x"]}}}}}
        self.assertEqual(dict(schema_keys("scene", schema)),
                         {"scene a": '{"type": "array"}', "scene a.b": '{"minimum": 0} always', "scene space.c": '{"enum": ["x"]}'})

    def test_python_gives_public_functions_and_members(self):
        text = "class Query:\n    def ask(self, x: int) -> float: ...\n    def __init__(self) -> None: ...\n    count: int\n"
        self.assertEqual(dict(python_names(text)), {"python berth.Query": "self", "python berth.Query.ask": "self, x: int -> float", "python berth.Query.count": "int"})

    def test_cpp_gives_public_members_without_blanks_and_overloads_together(self):
        compound = """<compounddef kind="class" prot="public"><compoundname>berth::Query</compoundname>
          <sectiondef><memberdef prot="public"><name>ask</name><definition>int  ask</definition><argsstring>(double x)</argsstring></memberdef>
          <memberdef prot="public"><name>ask</name><definition>int ask</definition><argsstring>()</argsstring></memberdef>
          <memberdef prot="private"><name>own_</name><definition>int own_</definition></memberdef></sectiondef></compounddef>"""
        self.assertEqual(by_key(cpp_names([ElementTree.fromstring(compound)])),
                         {"c++ berth::Query": "class", "c++ berth::Query::ask": "intask() | intask(doublex)"})

    def test_a_public_header_is_one(self):
        file = ElementTree.fromstring('<compounddef kind="file"><location file="src/berth/pipeline/query.hpp"/></compounddef>')
        self.assertEqual(dict(cpp_names([file])), {"header berth/pipeline/query.hpp": "is there"})

    def test_what_went_or_changed_needs_its_name_as_code(self):
        before = {"scene space.slab_m": "1", "message Link.msg": "a", "c++ berth::ask": "x"}
        now = {"c++ berth::ask": "x", "message Link.msg": "b", "scene new_m": "1"}
        keys = lambda section: [key for key, _, _ in unnamed(before, now, section)]
        self.assertEqual(keys("nothing"), ["scene space.slab_m", "message Link.msg"])
        self.assertEqual(keys("slab_m is gone; `LinkDistance` has more"), ["scene space.slab_m", "message Link.msg"])
        self.assertEqual(keys("`slab_m` is gone; `Link.msg` has more"), [])

    def test_a_class_that_went_takes_its_members_along(self):
        before = {"c++ berth::Query": "class", "c++ berth::Query::ask": "x", "c++ berth::Query::~Query": "x"}
        self.assertEqual([key for key, _, _ in unnamed(before, {}, "nothing")], ["c++ berth::Query"])
        self.assertEqual([key for key, _, _ in unnamed(before, {"c++ berth::Query": "class"}, "`ask`")], ["c++ berth::Query::~Query"])

    def test_names_and_sections(self):
        self.assertEqual([word_of(key) for key in ("message Link.msg", "scene space.slab_m", "c++ berth::Query::ask", "header berth/query.hpp")],
                         ["Link", "slab_m", "ask", "query"])
        self.assertEqual(newest_section("# Changes\n\n## 2.0.0, today\nb\n## 1.0.0\na\n"), "2.0.0, today\nb")


if __name__ == "__main__":
    unittest.main()
