#include "thesis/evaluate.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "thesis/brute_force.hpp"

namespace berth {
namespace {

struct CpuFunction {
  Method method;
  void (*run)(const ImageRequest& request, EvaluateWorkspace& workspace, LinkDistances& out);
};

constexpr std::array<CpuFunction, 3> kOnCpu = {{
    {Method::exact, [](const ImageRequest& q, EvaluateWorkspace& w,
                       LinkDistances& out) { exact(q, w.exact, out); }},
    {Method::brute_force,
     [](const ImageRequest& q, EvaluateWorkspace&, LinkDistances& out) { brute_force(q, out); }},
    {Method::lattice, [](const ImageRequest& q, EvaluateWorkspace& w,
                         LinkDistances& out) { lattice(q, w.lattice, out); }},
}};

}  // namespace

std::optional<Method> method_from_name(std::string_view name) {
  const auto found = std::ranges::find(kMethodNames, name);
  if (found == kMethodNames.end()) return std::nullopt;
  return static_cast<Method>(found - kMethodNames.begin());
}

void require_on_processor(Method method) {
  if (!runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " runs on OpenGL; expected one that does not");
}

void evaluate(Method method, const ImageRequest& request, EvaluateWorkspace& workspace,
              LinkDistances& out) {
  require_on_processor(method);
  std::ranges::find(kOnCpu, method, &CpuFunction::method)->run(request, workspace, out);
  if (request.settings.mean_direction) {
    fill_mean_directions(request, workspace.directions, out);
  }
}

}  // namespace berth
