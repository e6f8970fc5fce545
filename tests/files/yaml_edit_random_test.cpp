// Documents in every style that people write by hand, drawn at random, and edited.
#include <gtest/gtest.h>

#include <regex>

#include "berth/files/yaml_edit.hpp"
#include "sim/random.hpp"

namespace berth {
namespace {

using sim::Random;

/// Draws a map of maps, lists and scalars as text, with a comment of its own number wherever one
/// may stand, and notes where its scalars and its maps are.
class DrawnYaml {
 public:
  explicit DrawnYaml(Random& random) : random_(random) {
    if (random_.chance(0.3)) text_ += comment() + "\n";
    block_map(0, 0);
    if (random_.chance(0.2) && text_.ends_with('\n')) text_.pop_back();
    if (random_.chance(0.3)) text_ = std::regex_replace(text_, std::regex("\n"), "\r\n");
  }

  const std::string& text() const { return text_; }
  const std::vector<YamlPath>& scalars() const { return scalars_; }
  const std::vector<YamlPath>& maps() const { return maps_; }

 private:
  std::string comment() { return "# c" + std::to_string(comments_++) + " {[\"'\t: ü"; }
  std::string blanks() { return std::string(static_cast<std::size_t>(random_.whole(1, 3)), ' '); }
  std::string word() {
    const std::vector<std::string> words = {"x",    "-1.5",  "a b",    "it's", "../d/f.png",
                                            "a: b", "# no",  "[x], {", "ü€",   "say \"yes\"",
                                            "x#y",  "http:", "it''s"};
    return words[static_cast<std::size_t>(random_.whole(0, static_cast<int>(words.size()) - 1))];
  }

  void scalar() {
    scalars_.push_back(path_);
    const std::string value = word();
    const bool is_plain = std::regex_match(value, std::regex("[-./\\wü€' ]+"));
    const double style = random_(0, 1);
    if (is_plain && style < 0.6) {
      text_ += value;
    } else if (style < 0.8) {
      text_ += "'" + std::regex_replace(value, std::regex("'"), "''") + "'";
    } else {
      text_ += "\"" + std::regex_replace(value, std::regex("\""), "\\\"") + "\"";
    }
  }

  void end_line(int column) {
    if (random_.chance(0.3)) text_ += blanks() + comment();
    text_ += "\n";
    if (random_.chance(0.1)) text_ += "\n";
    if (random_.chance(0.2))
      text_ += std::string(static_cast<std::size_t>(column), ' ') + comment() + "\n";
  }

  template <typename Item>
  void in_path(const std::string& step, const Item& item) {
    path_.push_back(step);
    item();
    path_.pop_back();
  }

  void block_map(int column, int depth) {
    maps_.push_back(path_);
    const int count = random_.whole(1, 4);
    for (int i = 0; i < count; ++i) {
      if (i > 0) text_ += std::string(static_cast<std::size_t>(column), ' ');
      const std::string key = "k" + std::to_string(i);
      text_ += (random_.chance(0.1) ? "\"" + key + "\"" : key) + ":";
      in_path(key, [&] { block_value(column, depth + 1); });
    }
  }

  void block_list(int column, int depth) {
    const int count = random_.whole(1, 3);
    for (int i = 0; i < count; ++i) {
      text_ += std::string(static_cast<std::size_t>(column), ' ') + "- ";
      in_path(std::to_string(i), [&] {
        if (depth < 3 && random_.chance(0.5)) return block_map(column + 2, depth + 1);
        flow_value(depth + 1);
        end_line(column);
      });
    }
  }

  void block_value(int column, int depth) {
    if (depth < 3 && random_.chance(0.4)) {
      const bool is_map = random_.chance(0.5);
      const int inner = column + random_.whole(is_map ? 1 : 0, 4);
      end_line(inner);
      if (!is_map) return block_list(inner, depth);
      text_ += std::string(static_cast<std::size_t>(inner), ' ');
      return block_map(inner, depth);
    }
    text_ += blanks();
    flow_value(depth);
    end_line(column);
  }

  void flow_gap() {
    if (random_.chance(0.3)) text_ += blanks();
    if (random_.chance(0.1)) text_ += " " + comment() + "\n" + std::string(20, ' ');
  }

  void flow_value(int depth) {
    const double kind = depth < 4 ? random_(0, 1) : 0;
    if (kind < 0.5) return scalar();
    const bool is_map = kind < 0.75;
    if (is_map) maps_.push_back(path_);
    text_ += is_map ? "{" : "[";
    const int count = random_.whole(0, 3);
    for (int i = 0; i < count; ++i) {
      flow_gap();
      if (is_map) text_ += "k" + std::to_string(i) + ": ";
      in_path((is_map ? "k" : "") + std::to_string(i), [&] { flow_value(depth + 1); });
      flow_gap();
      if (i + 1 < count) text_ += ", ";
    }
    flow_gap();
    text_ += is_map ? "}" : "]";
  }

  Random& random_;
  std::string text_;
  YamlPath path_;
  std::vector<YamlPath> scalars_;
  std::vector<YamlPath> maps_;
  int comments_ = 0;
};

/// The numbers of the comments, in the text's order.
std::vector<std::string> comments_of(const std::string& text) {
  const std::regex comment("# c(\\d+) \\{\\[\"'\t: ü");
  std::vector<std::string> numbers;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), comment);
       at != std::sregex_iterator(); ++at) {
    numbers.push_back((*at)[1]);
  }
  return numbers;
}

TEST(YamlEdit, EditsDrawnDocumentsAndKeepsTheirComments) {
  Random random(1);
  std::size_t replaced = 0;
  std::size_t added = 0;
  std::size_t comments = 0;
  for (int i = 0; i < 300; ++i) {
    const DrawnYaml drawn(random);
    SCOPED_TRACE(drawn.text());
    YamlScalars expected = yaml_scalars(drawn.text());
    ASSERT_EQ(expected.size(), drawn.scalars().size());
    YamlScalars values;
    for (const YamlPath& path : drawn.scalars()) {
      if (random.chance(0.3)) values[path] = random.chance(0.5) ? "-0.25" : "n, 'e: w' # ü";
    }
    replaced += values.size();
    for (YamlPath path : drawn.maps()) {
      if (random.chance(0.3)) continue;
      path.push_back("new");
      if (random.chance(0.3)) path.push_back("inner key");
      values[path] = "0.5";
      ++added;
    }
    for (const auto& [path, value] : values) expected[path] = value;
    const std::string text = edited_yaml("drawn.yaml", drawn.text(), values);
    ASSERT_EQ(yaml_scalars(text), expected) << text;
    ASSERT_EQ(comments_of(text), comments_of(drawn.text())) << text;
    ASSERT_EQ(edited_yaml("drawn.yaml", drawn.text(), {}), drawn.text());
    comments += comments_of(text).size();
  }
  EXPECT_GT(replaced, 500U);
  EXPECT_GT(added, 500U);
  EXPECT_GT(comments, 500U);
}

}  // namespace
}  // namespace berth
