#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "berth/distance/exact/exact.hpp"
#include "berth/distance/lattice/lattice.hpp"
#include "berth/distance/mean_direction/mean_direction.hpp"

namespace berth {

/// The ways to find the closest pairs. Each has the name of its enumerator; those with gl_ run on
/// OpenGL (GlEvaluator).
enum class Method { mesh, exact, brute_force, lattice, gl_exact, gl_lattice, gl_hybrid };

inline constexpr std::array kMethods = {Method::mesh,        Method::exact,    Method::brute_force,
                                        Method::lattice,     Method::gl_exact, Method::gl_lattice,
                                        Method::gl_hybrid};
/// Those that compare one image of the robot with one of the obstacles.
inline constexpr std::array kImageMethods = {Method::exact,    Method::brute_force,
                                             Method::lattice,  Method::gl_exact,
                                             Method::gl_lattice, Method::gl_hybrid};
inline constexpr std::array kCpuMethods = {Method::exact, Method::brute_force, Method::lattice};

constexpr const auto& all_of(Method) { return kMethods; }

bool runs_on_opengl(Method method);
inline bool asks_images(Method method) { return method != Method::mesh; }

std::string_view name_of(Method method);
/// Nothing if no method has this name.
std::optional<Method> method_from_name(std::string_view name);

/// The memory of evaluate(), made once and used for every question; one for each thread. It carries
/// nothing from one answer to the next.
struct EvaluateWorkspace {
  ExactWorkspace exact;
  LatticeWorkspace lattice;
  DirectionWorkspace directions;
};

/// For each link the closest pair by one method and, if the settings ask for it, the mean
/// direction.
///
/// Throws std::invalid_argument for bad settings, and for a method that runs on OpenGL.
void evaluate(Method method, const Question& question, EvaluateWorkspace& workspace,
              LinkDistances& out);

}  // namespace berth
