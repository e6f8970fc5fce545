#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace berth {

/// The ways to compare one image of the robot with one of the obstacles. Those with gl_ run on
/// OpenGL.
enum class Method : std::uint8_t { exact, brute_force, lattice, gl_exact, gl_lattice, gl_hybrid };

/// By enumerator.
inline constexpr std::array<std::string_view, 6> kMethodNames = {
    "exact", "brute_force", "lattice", "gl_exact", "gl_lattice", "gl_hybrid"};
inline constexpr std::array kMethods = {Method::exact,    Method::brute_force, Method::lattice,
                                        Method::gl_exact, Method::gl_lattice,  Method::gl_hybrid};
inline constexpr std::array kCpuMethods = {Method::exact, Method::brute_force, Method::lattice};

constexpr const auto& all_of(Method) { return kMethods; }

constexpr std::string_view name_of(Method method) {
  return kMethodNames[static_cast<std::size_t>(method)];
}
/// Nothing if no method has this name.
std::optional<Method> method_from_name(std::string_view name);

/// Throws std::invalid_argument unless it runs on the processor.
void require_on_processor(Method method);

constexpr bool runs_on_opengl(Method method) { return name_of(method).starts_with("gl_"); }

}  // namespace berth
