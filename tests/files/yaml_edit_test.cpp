#include "berth/files/yaml_edit.hpp"

#include <gtest/gtest.h>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

std::string edited(const std::string& text, const YamlScalars& values) {
  return edited_yaml("some.yaml", text, values);
}

TEST(YamlEdit, ListsScalarsByWhereTheyStand) {
  EXPECT_EQ(yaml_scalars("a: {b: [1, 'x y', {}]}\nc: &c\n  - d: 2\ne: *c\nf:\n\"g.h\": ''\n"),
            (YamlScalars{{{"a", "b", "0"}, "1"},
                         {{"a", "b", "1"}, "x y"},
                         {{"c", "0", "d"}, "2"},
                         {{"e", "0", "d"}, "2"},
                         {{"g.h"}, ""}}));
}

TEST(YamlEdit, ReplacesScalarsAndKeepsTheRest) {
  struct Case {
    std::string text;
    YamlScalars values;
    std::string expected;
  };
  const std::vector<Case> table = {
      {"a: 1 # b: 2\n", {{{"a"}, "-2.5"}}, "a: -2.5 # b: 2\n"},
      {"a: 1", {{{"a"}, "22"}}, "a: 22"},
      {"a: 'it''s' # '\n", {{{"a"}, "he's"}}, "a: 'he''s' # '\n"},
      {R"(a: "x\"y" # ")", {{{"a"}, "z\"\\"}}, R"(a: "z\"\\" # ")"},
      {"a: \"x\n  y\"\n", {{{"a"}, "z"}}, "a: \"z\"\n"},
      {"a: x\n", {{{"a"}, "b: c"}}, "a: \"b: c\"\n"},
      {"a: [x,y]\n", {{{"a", "0"}, "*,{"}}, "a: [\"*,{\",y]\n"},
      {"a: [1 , # one\n  2]\n", {{{"a", "0"}, "3"}, {{"a", "1"}, "4"}}, "a: [3 , # one\n  4]\n"},
      {"a:\n- -1\t# tab\n- 2\n", {{{"a", "0"}, "5"}}, "a:\n- 5\t# tab\n- 2\n"},
      {"# \xC3\xA4\r\n\xC3\xA4: 1 # \xE2\x82\xAC\r\nb: 2\r\n",
       {{{"\xC3\xA4"}, "3"}, {{"b"}, "\xC3\xBC"}},
       "# \xC3\xA4\r\n\xC3\xA4: 3 # \xE2\x82\xAC\r\nb: \xC3\xBC\r\n"},
      {"\xEF\xBB\xBF"
       "a: 1\n",
       {{{"a"}, "2"}, {{"b"}, "3"}},
       "\xEF\xBB\xBF"
       "a: 2\nb: 3\n"},
      {"%YAML 1.2\n---\na: !!str &x 1\nb: 2\n...\n",
       {{{"a"}, "3"}},
       "%YAML 1.2\n---\na: !!str &x 3\nb: 2\n...\n"},
      {"a: &x 1\nb: *x\n", {{{"a"}, "2"}, {{"b"}, "2"}}, "a: &x 2\nb: *x\n"},
  };
  for (const Case& good : table) EXPECT_EQ(edited(good.text, good.values), good.expected);
}

TEST(YamlEdit, AddsWhatIsMissing) {
  struct Case {
    std::string text;
    YamlScalars values;
    std::string expected;
  };
  const YamlScalars one = {{{"m", "new"}, "1"}};
  const YamlScalars two = {{{"m", "new"}, "1"}, {{"m", "o p"}, "2"}};
  const std::vector<Case> table = {
      // Into a map on several lines: behind the last line that holds a whole entry.
      {"m:\n  a: 1 # one\nn: 2\n", one, "m:\n  a: 1 # one\n  new: 1\nn: 2\n"},
      {"m:\n  a: 1 # one\n       # and more\n  # of n\nn: 2\n", one,
       "m:\n  a: 1 # one\n       # and more\n  new: 1\n  # of n\nn: 2\n"},
      {"m:\n  a: 1\n     \n  b: [2]\n", one, "m:\n  a: 1\n  new: 1\n     \n  b: [2]\n"},
      {"m:\n  a: 1\n  b:\n    - 2\n", one, "m:\n  a: 1\n  new: 1\n  b:\n    - 2\n"},
      {"m:\n  a: 1", two, "m:\n  a: 1\n  new: 1\n  o p: 2"},
      {"m:\r\n  a: 1\r\n  b: [2]\r\n", two, "m:\r\n  a: 1\r\n  new: 1\r\n  o p: 2\r\n  b: [2]\r\n"},
      {"m:\r\n  a: 1 # one\r\n      # more\r\n", one,
       "m:\r\n  a: 1 # one\r\n      # more\r\n  new: 1\r\n"},
      // Where no entry is a scalar: in front of all.
      {"m:\n    # of a\n    a: [1]\n    b: {c: 2}\n", one,
       "m:\n    # of a\n    new: 1\n    a: [1]\n    b: {c: 2}\n"},
      {"m: {a: [1], b: {c: 2}}\n", two, "m: {new: 1, o p: 2, a: [1], b: {c: 2}}\n"},
      {"m:\n  a: |\n    x\n", one, "m:\n  new: 1\n  a: |\n    x\n"},
      {"x: &x 1\nm:\n  a: *x\n", one, "x: &x 1\nm:\n  new: 1\n  a: *x\n"},
      // Into a map on one line.
      {"m: {a: 1, b: [2]} # m\n", two, "m: {a: 1, new: 1, o p: 2, b: [2]} # m\n"},
      {"m: {a: '}', # a\n  b: \"x\" # b\n  }\n", one,
       "m: {a: '}', # a\n  b: \"x\", new: 1 # b\n  }\n"},
      {"m: {} # none\n", two, "m: {new: 1, o p: 2} # none\n"},
      {"m: &m {\n  # none\n  }\n", one, "m: &m {new: 1\n  # none\n  }\n"},
      // With the map itself.
      {"a: 1\n", two, "a: 1\nm: {new: 1, o p: 2}\n"},
      {"l:\n  - a: 1\n    b: [2]\n  - {a: 1}\n",
       {{{"l", "0", "m", "k"}, "5"}, {{"l", "1", "m", "k", "j"}, "a, b"}},
       "l:\n  - a: 1\n    m: {k: 5}\n    b: [2]\n  - {a: 1, m: {k: {j: \"a, b\"}}}\n"},
      {"l:\n- - a: 1\n", {{{"l", "0", "0", "k"}, "5"}}, "l:\n- - a: 1\n    k: 5\n"},
  };
  for (const Case& good : table) EXPECT_EQ(edited(good.text, good.values), good.expected);
}

TEST(YamlEdit, PutsAnItemInFrontOfAList) {
  struct Case {
    std::string text;
    std::string expected;
  };
  const std::vector<Case> table = {
      {"a: 1 # one\n", "a: 1 # one\nl: [{k: 1, o p: \"b: c\"}]\n"},
      {"{a: 1}\n", "{a: 1, l: [{k: 1, o p: \"b: c\"}]}\n"},
      {"l: [] # none\n", "l: [{k: 1, o p: \"b: c\"}] # none\n"},
      {"l: [{k: 2}, x]\n", "l: [{k: 1, o p: \"b: c\"}, {k: 2}, x]\n"},
      {"l:\n  # of k\n  - k: 2\n    m: [3]\n  - {k: 4}\nb: 1\n",
       "l:\n  # of k\n  - {k: 1, o p: \"b: c\"}\n  - k: 2\n    m: [3]\n  - {k: 4}\nb: 1\n"},
      {"l:\r\n- 'x-y'\r\n", "l:\r\n- {k: 1, o p: \"b: c\"}\r\n- 'x-y'\r\n"},
      {"\xEF\xBB\xBFl: []\n", "\xEF\xBB\xBFl: [{k: 1, o p: \"b: c\"}]\n"},
  };
  const std::vector<std::pair<std::string, std::string>> item = {{"k", "1"}, {"o p", "b: c"}};
  for (const Case& good : table) {
    EXPECT_EQ(with_list_item("some.yaml", good.text, "l", item), good.expected);
  }
  expect_parts(error_message([&] { with_list_item("some.yaml", "b: 1\nl: {a: 2}\n", "l", item); }),
               {"some.yaml:2: l: cannot be added to", "expected a list of items"});
  expect_parts(error_message([&] { with_list_item("some.yaml", "l:\n", "l", item); }),
               {"l: cannot be added to"});
  expect_parts(error_message([&] { with_list_item("some.yaml", "a: &x [1]\nl: *x\n", "l", item); }),
               {"some.yaml", "an alias cannot be edited"});
}

/// yaml-cpp reads it, but its marks are places in another text.
TEST(YamlEdit, RefusesTextsOfWideCharacters) {
  for (const char16_t* text : {u"m: {}\n", u"m: {k: 1}\n", u"m: {k: [1]}\n", u"m:\n  k: [1]\n"}) {
    for (const std::size_t comment_size : {0, 100}) {
      std::u16string wide = u"\uFEFF#";
      wide.append(comment_size, u'\u6F22').append(u"\n").append(text);
      std::string bytes;
      for (const char16_t c : wide) {
        bytes += {static_cast<char>(c & 0xFF), static_cast<char>(c >> 8)};
      }
      ASSERT_FALSE(yaml_scalars(bytes).contains({"m", "n"}));
      EXPECT_THROW(edited(bytes, {{{"m", "n"}, "2"}}), std::runtime_error);
      EXPECT_THROW(edited(bytes, {{{"m", "k"}, "2"}}), std::runtime_error);
    }
  }
}

/// What cannot be edited is refused: the text is right, or there is none.
TEST(YamlEdit, RefusesWhatItCannotEdit) {
  struct Case {
    std::string text;
    YamlScalars values;
    std::vector<std::string> parts;
  };
  const std::vector<Case> table = {
      {"a: &x 1\nb: *x\n",
       {{{"a"}, "2"}},
       {"some.yaml:1: b: would become 2; expected 1; an alias"}},
      {"a: &x 1\nb: *x\n", {{{"a"}, "2"}, {{"b"}, "3"}}, {"would become"}},
      {"c: 0\na: &x {k: 1}\nb: *x\n", {{{"a", "k"}, "2"}}, {"some.yaml:2: b.k: would become 2"}},
      {"a: &x {k: 1}\nb: *x\n",
       {{{"a", "n"}, "2"}},
       {"some.yaml:1: b.n: would become 2; expected no such key; an alias"}},
      {"l:\n  - &x [1, 2]\n  - *x\n", {{{"l", "1", "0"}, "3"}}, {"l[0][0]: would become 3"}},
      {"\na: |\n  1\n",
       {{{"a"}, "2"}},
       {"some.yaml:2: a: is written in a way that cannot be edited; expected a value on one line"}},
      {"a: x\n  y\n", {{{"a"}, "2"}}, {"some.yaml:1: a: is written in a way"}},
      {"a: 1\nb: [2]\n", {{{"b"}, "2"}}, {"some.yaml:2: b: is written in a way"}},
      {"a: [1]\n",
       {{{"a", "1"}, "2"}},
       {"some.yaml:1: a[1]: cannot be added here; expected a map"}},
      {"a: [1]\n", {{{"a", "x"}, "2"}}, {"some.yaml:1: a.x: cannot be added here"}},
      {"b: 2\na: 1\n", {{{"a", "x"}, "2"}}, {"some.yaml:2: a.x: cannot be added here"}},
      {"? a\n: b\n", {{{"c"}, "d"}}, {"some.yaml"}},
  };
  for (const Case& bad : table) {
    SCOPED_TRACE(bad.text);
    expect_parts(error_message([&] { edited(bad.text, bad.values); }), bad.parts);
  }
}

}  // namespace
}  // namespace berth
