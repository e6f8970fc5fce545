// The parts of the module, in the order in which their types need each other.
#pragma once

#include <pybind11/pybind11.h>

namespace berth::python {

void bind_statuses(pybind11::module_& m);
void bind_all_settings(pybind11::module_& m);
void bind_robot(pybind11::module_& m);
void bind_view(pybind11::module_& m);
void bind_separation(pybind11::module_& m);
void bind_separation_result(pybind11::module_& m);
void bind_result(pybind11::module_& m);
void bind_control(pybind11::module_& m);
void bind_configurations(pybind11::module_& m);
void bind_record(pybind11::module_& m);
void bind_query(pybind11::module_& m);
void bind_images(pybind11::module_& m);
void bind_scene(pybind11::module_& m);
void bind_calibration(pybind11::module_& m);
void bind_page(pybind11::module_& m);

}  // namespace berth::python
