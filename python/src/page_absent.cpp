// In a build without the page.
#include "bindings.hpp"

namespace berth::python {

void bind_page(pybind11::module_& m) {
  m.def("view", [](const pybind11::args&, const pybind11::kwargs&) {
    throw pybind11::import_error(
        "this berth was built without the page, as by a plain `pip install .`; `make view`, then "
        "`make python` in berth's source tree build one that has it (docs/view.md)");
  });
}

}  // namespace berth::python
