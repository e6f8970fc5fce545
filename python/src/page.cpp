// A page that shows a running robot.
#include <pybind11/stl.h>

#include <filesystem>

#include "apps/view/live_page.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "handles.hpp"

namespace berth::python {
namespace {

/// Beside the installed package, or in the build that the package belongs to.
std::vector<std::filesystem::path> package_page_folders() {
  const auto file = py::module_::import("berth").attr("__file__").cast<std::string>();
  const std::filesystem::path package = std::filesystem::path(file).parent_path();
  return {package / "page", package.parent_path().parent_path() / "page"};
}

std::unique_ptr<app::LivePage> make_page(const std::shared_ptr<Robot>& robot,
                                         const std::vector<std::shared_ptr<MountedCamera>>& given,
                                         int port, const std::string& bind) {
  std::vector<app::PageCamera> cameras;
  for (const auto& mounted : given) cameras.push_back({mounted->mount().name, mounted->camera()});
  return std::make_unique<app::LivePage>(robot, cameras, app::PageAddress{bind, port},
                                         app::read_page_files(package_page_folders()));
}

void show(app::LivePage& page, const Part<Result>& result,
          const std::vector<std::optional<std::shared_ptr<Frame>>>& frames) {
  std::vector<std::shared_ptr<const Frame>> pointers;
  for (const auto& one : frames) pointers.push_back(one.value_or(nullptr));
  const py::gil_scoped_release release;
  page.show(*result, pointers);
}

}  // namespace

void bind_page(py::module_& m) {
  py::class_<app::LivePage>(m, "Page", "A page that shows a running robot, while it lives.")
      .def_property_readonly("url", &app::LivePage::url, "str: where it is")
      .def("show", &show, py::arg("result"), py::arg("frames"),
           "Shows a result and the frames that it is about, one or None for each view. Waits for\n"
           "no browser: one that is slower misses some.");
  m.def("view", &make_page, py::arg("robot"), py::arg("views"), py::arg("port") = 8080,
        py::arg("bind") = "127.0.0.1",
        "Serves a page that shows the robot and what these views see. port 0 takes any that is\n"
        "free; with another address than this computer's own the URL has a token.");
}

}  // namespace berth::python
