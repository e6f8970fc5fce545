// berth as a Python module: its types with numpy arrays. The package `berth` around it gives them
// their names.
#include <stdexcept>

#include "berth/files/file_bytes.hpp"
#include "bindings.hpp"

namespace {

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const berth::MissingFile& error) {
    PyErr_SetString(PyExc_FileNotFoundError, error.what());
  } catch (const pybind11::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    // A bad file: what is bad is its content.
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_berth, m) {
  m.doc() = "Exact distances between a robot and what depth cameras see.";
  m.attr("__version__") = BERTH_VERSION;
  pybind11::register_exception_translator(translate);
  berth::python::bind_statuses(m);
  berth::python::bind_all_settings(m);
  berth::python::bind_robot(m);
  berth::python::bind_view(m);
  berth::python::bind_separation(m);
  berth::python::bind_separation_result(m);
  berth::python::bind_result(m);
  berth::python::bind_control(m);
  berth::python::bind_configurations(m);
  berth::python::bind_record(m);
  berth::python::bind_query(m);
  berth::python::bind_images(m);
  berth::python::bind_scene(m);
  berth::python::bind_calibration(m);
  berth::python::bind_page(m);
}
