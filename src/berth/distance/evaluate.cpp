#include "berth/distance/evaluate.hpp"

#include <stdexcept>

#include "berth/distance/brute_force.hpp"

namespace berth {

std::string_view name_of(Method method) {
  switch (method) {
    case Method::mesh:
      return "mesh";
    case Method::exact:
      return "exact";
    case Method::brute_force:
      return "brute_force";
    case Method::lattice:
      return "lattice";
    case Method::gl_exact:
      return "gl_exact";
    case Method::gl_lattice:
      return "gl_lattice";
    case Method::gl_hybrid:
      return "gl_hybrid";
  }
  return {};
}

bool runs_on_opengl(Method method) { return name_of(method).starts_with("gl_"); }

std::optional<Method> method_from_name(std::string_view name) {
  for (const Method method : kMethods) {
    if (name_of(method) == name) return method;
  }
  return std::nullopt;
}

void evaluate(Method method, const Question& question, EvaluateWorkspace& workspace,
              LinkDistances& out) {
  switch (method) {
    case Method::exact:
      exact(question, workspace.exact, out);
      break;
    case Method::brute_force:
      brute_force(question, out);
      break;
    case Method::lattice:
      lattice(question, workspace.lattice, out);
      break;
    case Method::mesh:
      throw std::invalid_argument("method mesh asks no images; expected one that does");
    case Method::gl_exact:
    case Method::gl_lattice:
    case Method::gl_hybrid:
      throw std::invalid_argument("method " + std::string(name_of(method)) +
                                  " runs on OpenGL; expected one that does not");
  }
  if (question.settings.mean_direction) {
    fill_mean_directions(question, workspace.directions, out);
  }
}

}  // namespace berth
