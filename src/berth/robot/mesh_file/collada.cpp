#include "berth/robot/mesh_file/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "berth/files/number.hpp"
#include "berth/files/xml.hpp"

namespace berth {
namespace {

constexpr std::size_t kMostNodes = 100'000;
constexpr std::size_t kDeepestUnfolding = 200;

class Guard {
 public:
  Guard(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {
    parse_xml(path, text, "the mesh cannot be read", document_);
  }

  std::string checked() {
    find_position_arrays();
    check_numbers(document_);
    for (const pugi::xml_node& accessor : accessors_) check_accessor(accessor);
    for (const auto& scene : document_.select_nodes("//scene/instance_visual_scene"))
      unfolded(named_by(scene.node(), "visual_scene"));
    remove_all_but_geometry();
    std::ostringstream text;
    document_.save(text, "", pugi::format_raw);
    return text.str();
  }

 private:
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: <{}>: {}", path_.string(),
                                         line_of(text_, node.offset_debug()), node.name(), what));
  }

  void find_position_arrays() {
    std::set<std::string> sources;
    for (const auto& input : document_.select_nodes("//input[@semantic='POSITION']"))
      sources.insert(input.node().attribute("source").value());
    for (const auto& found : document_.select_nodes("//source//accessor")) {
      const pugi::xml_node source = found.node().parent().parent();
      if (sources.count(fmt::format("#{}", source.attribute("id").value())) > 0)
        position_arrays_.insert(found.node().attribute("source").value());
    }
  }

  /// Nothing can be there more often than the file has bytes.
  void check_numbers(const pugi::xml_node& node) {
    for (const char* key : {"count", "stride", "offset", "set"}) {
      const pugi::xml_attribute value = node.attribute(key);
      if (!value) continue;
      const std::string_view digits = value.value();
      if (digits.empty() || digits.size() > 9 ||
          digits.find_first_not_of("0123456789") != std::string_view::npos ||
          value.as_uint() > text_.size()) {
        fail(node,
             fmt::format("{} is \"{}\"; expected a whole number of at most the file's {} bytes",
                         key, digits, text_.size()));
      }
    }
    require_whole_numbers(node);
    require_floats(node);
    const std::string_view name = node.name();
    if (node.attribute("count").as_uint() == 0 && *node.child_value("p") != '\0' && name != "ph")
      fail(node, "has no count of what <p> holds; expected one");
    if (name == "accessor") accessors_.push_back(node);
    if (name.ends_with("_array")) {
      const std::size_t count = node.attribute("count").as_uint();
      const auto [array, is_new] = array_count_.emplace(node.attribute("id").value(), count);
      if (!is_new) array->second = std::min(array->second, count);
    }
    if (name == "skew" || name == "instance_controller" || name == "bind_material")
      unwanted_.push_back(node);
    if (const auto id = node.attribute("id"))
      by_id_[fmt::format("{}#{}", name, id.value())].push_back(node);
    for (const pugi::xml_node& child : node.children()) check_numbers(child);
  }

  /// Assimp reads beyond an array that is shorter than what its accessor says.
  void check_accessor(const pugi::xml_node& accessor) const {
    const std::string_view source = accessor.attribute("source").value();
    const auto array = array_count_.find(std::string(source.substr(source.starts_with('#'))));
    const auto params = std::distance(accessor.begin(), accessor.end());
    const std::size_t stride = accessor.attribute("stride").as_uint(1);
    const std::size_t count = accessor.attribute("count").as_uint();
    const std::size_t needed = count == 0
                                   ? 0
                                   : accessor.attribute("offset").as_uint() + (count - 1) * stride +
                                         std::max<std::size_t>(stride, params);
    const std::size_t there = array == array_count_.end() ? 0 : array->second;
    if (needed <= there) return;
    fail(accessor, fmt::format("reaches {} values of \"{}\", which has {}; expected not more than "
                               "that",
                               needed, source, there));
  }

  /// Assimp reads a list of numbers on and on where one does not begin with a digit.
  void require_whole_numbers(const pugi::xml_node& node) const {
    const std::string_view name = node.name();
    if (name != "p" && name != "v" && name != "vcount") return;
    const std::string_view text = node.child_value();
    const std::size_t bad = text.find_first_not_of(" \t\r\n0123456789");
    if (bad == std::string_view::npos) return;
    fail(node, fmt::format("holds \"{}\"; expected numbers", text.substr(bad, 12)));
  }

  /// At a list that is too short, or a word that is no number, Assimp leaks memory. Such a word of
  /// what berth has no use for, as normals, becomes 0.
  void require_floats(pugi::xml_node node) const {
    const std::map<std::string_view, std::size_t> counts{
        {"float_array", node.attribute("count").as_uint()},
        {"matrix", 16},
        {"translate", 3},
        {"rotate", 4},
        {"scale", 3},
        {"lookat", 9}};
    const auto expected = counts.find(node.name());
    if (expected == counts.end()) return;
    const bool is_used = expected->first != "float_array" ||
                         position_arrays_.count(fmt::format("#{}", node.attribute("id").value()));
    constexpr std::string_view kBlanks = " \t\r\n";
    std::string text = node.child_value();
    std::string_view rest = text;
    std::size_t found = 0;
    bool is_changed = false;
    for (std::size_t begin = rest.find_first_not_of(kBlanks); begin != std::string_view::npos;
         begin = rest.find_first_not_of(kBlanks)) {
      rest.remove_prefix(begin);
      const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
      if (!parse_finite(word)) {
        if (is_used) fail(node, fmt::format("holds \"{:.40}\"; expected numbers", word));
        is_changed = true;
        std::fill_n(text.begin() + (word.data() - text.data()), word.size(), '0');
      }
      rest.remove_prefix(word.size());
      ++found;
    }
    if (found < expected->second)
      fail(node, fmt::format("holds {} numbers; expected {}", found, expected->second));
    if (is_changed) node.text().set(text.c_str());
  }

  /// How many nodes stand below this one once each reference is replaced by what it names.
  std::size_t unfolded(const pugi::xml_node& node) {
    const auto known = unfolded_.find(node.hash_value());
    if (known != unfolded_.end()) return known->second;
    if (!open_.insert(node.hash_value()).second) fail(node, "holds itself; expected a tree");
    if (open_.size() > kDeepestUnfolding) {
      fail(node, fmt::format("nodes unfold deeper than {}; expected less", kDeepestUnfolding));
    }
    std::size_t count = 1;
    for (const pugi::xml_node& child : node.children()) {
      const std::string_view name = child.name();
      if (name == "node") count += unfolded(child);
      if (name == "instance_node") count += unfolded(named_by(child, "node"));
      if (name == "instance_geometry") named_by(child, "geometry");
      if (count > kMostNodes) {
        fail(child, fmt::format("nodes unfold to more than {}; expected less", kMostNodes));
      }
    }
    open_.erase(node.hash_value());
    return unfolded_[node.hash_value()] = count;
  }

  /// Assimp leaves out a geometry that is not there in silence.
  pugi::xml_node named_by(const pugi::xml_node& reference, const char* kind) const {
    const std::string_view url = reference.attribute("url").value();
    const auto all = by_id_.find(fmt::format("{}#{}", kind, url.substr(url.starts_with('#'))));
    if (all == by_id_.end()) {
      fail(reference, fmt::format("\"{}\" is not in the file; expected the id of a {}", url, kind));
    }
    if (all->second.size() == 1) return all->second[0];
    fail(all->second[1],
         fmt::format("a second one has the id of \"{}\"; expected ids that differ", url));
  }

  /// Assimp need not look at what berth has no use for. It ends the process at a skew and at some
  /// skins, used or not, and version 5.4 where a binding names a material that there is not.
  void remove_all_but_geometry() {
    // One may stand in another one, which was found before it.
    // No std::views: clang 14, which the fuzzers are built with, cannot compile libstdc++'s.
    for (auto node = unwanted_.rbegin(); node != unwanted_.rend(); ++node) {
      const std::string_view name = node->name();
      if (name != "bind_material" && unfolded_.count(node->parent().hash_value()) > 0) {
        fail(*node, name == "skew" ? "not supported; expected matrix, translate, rotate, scale or "
                                     "lookat"
                                   : "a skin, which bends with its bones; expected a rigid mesh, "
                                     "<instance_geometry>");
      }
      node->parent().remove_child(*node);
    }
    pugi::xml_node root = document_.document_element();
    constexpr std::array<std::string_view, 5> kKept{"asset", "library_geometries", "library_nodes",
                                                    "library_visual_scenes", "scene"};
    for (pugi::xml_node child = root.first_child(); child;) {
      const pugi::xml_node next = child.next_sibling();
      if (std::find(kKept.begin(), kKept.end(), child.name()) == kKept.end()) {
        root.remove_child(child);
      }
      child = next;
    }
  }

  const std::filesystem::path& path_;
  const std::string& text_;
  pugi::xml_document document_;
  std::vector<pugi::xml_node> accessors_;
  std::vector<pugi::xml_node> unwanted_;
  std::set<std::string> position_arrays_;
  std::map<std::string, std::size_t> array_count_;
  /// By such as geometry#shape.
  std::map<std::string, std::vector<pugi::xml_node>> by_id_;
  std::map<std::size_t, std::size_t> unfolded_;
  std::set<std::size_t> open_;
};

}  // namespace

std::string checked_collada(const std::filesystem::path& path, const std::string& text) {
  return Guard(path, text).checked();
}

}  // namespace berth
