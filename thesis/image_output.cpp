#include "thesis/image_output.hpp"

#include <fmt/format.h>

#include "berth/files/json_schema.hpp"
#include "berth/results/json_values.hpp"
#include "berth/results/link_table.hpp"
#include "berth/results/result_schema.hpp"

namespace berth {

std::string image_result_json(const ImageResult& result) {
  Json json = result_values(result);
  json["method"] = name_of(result.method);
  if (!result.gl_renderer.empty()) json["gl_renderer"] = result.gl_renderer;
  json["pairs"] = result.pairs;
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    json["links"][i]["robot_pixel"] = json_value(result.pairs_of[i].robot_pixel);
    json["links"][i]["robot_pixels"] = result.pairs_of[i].robot_pixels;
  }
  return json.dump();
}

std::string image_result_table(const ImageResult& result) {
  LinkTable table({"distance [m]", "robot pixel", "obstacle pixel", "robot pixels"});
  for (const std::size_t i : moved_first(result)) {
    const LinkResult& link = result.links[i];
    const ImagePair& pair = result.pairs_of[i];
    const bool is_ok = link.status == LinkStatus::ok;
    table.add(
        link,
        {distance_text(link, result.has_bounds), is_ok ? pixel_text(pair.robot_pixel) : "-",
         is_ok ? pixel_text(link.obstacle_pixel) : "-", fmt::format("{}", pair.robot_pixels)});
  }
  return table.text();
}

std::string schema_of_all_results() {
  MoreOfResults more;
  more.of_line["gl_renderer"] = schema::told("what OpenGL ran on", schema::text());
  more.of_line["pairs"] = schema::told("pair distances that were computed", schema::count());
  more.of_link["robot_pixel"] = schema::told("column and row of the link's closest point",
                                             schema::or_null(schema::list_of(schema::count(), 2)));
  more.of_link["robot_pixels"] = schema::told("how many pixels show the link", schema::count());
  for (const std::string_view name : kMethodNames) more.methods.push_back(name);
  return result_schema(more);
}

}  // namespace berth
