#include "berth/robot/srdf.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "berth/files/file_bytes.hpp"
#include "berth/files/xml.hpp"

namespace berth {

std::vector<AllowedContact> read_disabled_collisions(const std::filesystem::path& srdf) {
  const std::string text = read_file_bytes(srdf);
  pugi::xml_document document;
  parse_xml(srdf, text, "not a valid SRDF", document);
  const pugi::xml_node robot = document.document_element();
  const auto fail = [&](const pugi::xml_node& place, const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}", srdf.string(), line_of(text, place.offset_debug()), what));
  };
  if (std::string_view(robot.name()) != "robot") {
    fail(robot, fmt::format("the root is <{}>; expected <robot>", robot.name()));
  }
  std::vector<AllowedContact> disabled;
  for (const pugi::xml_node& pair : robot.children("disable_collisions")) {
    const pugi::xml_attribute a = pair.attribute("link1"), b = pair.attribute("link2");
    if (!a || !b) fail(pair, "<disable_collisions> lacks a link; expected link1 and link2");
    disabled.push_back({a.value(), b.value(), true});
  }
  return disabled;
}

}  // namespace berth
