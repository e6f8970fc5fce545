#include <fmt/format.h>
#include <spng.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "lab/bundled_scene/output_files.hpp"

namespace berth::lab {
namespace {

void write_bytes(const std::filesystem::path& file, const char* bytes, std::size_t size) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes, static_cast<std::streamsize>(size));
  out.close();
  if (!out)
    throw std::runtime_error(fmt::format(
        "{}: cannot write {} bytes, expected a writable folder with room", file.string(), size));
}

template <typename T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void put(std::string& bytes, const Eigen::Vector3f& vector) {
  for (const float c : vector) put(bytes, c);
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: cannot make this folder ({}), expected a writable place", folder.string(),
                    error.message()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  write_bytes(file, text.data(), text.size());
}

void write_png(const std::filesystem::path& file, const Image<std::uint16_t>& image) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                &spng_ctx_free);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width());
  header.height = static_cast<std::uint32_t>(image.height());
  header.bit_depth = 16;
  header.color_type = SPNG_COLOR_TYPE_GRAYSCALE;
  spng_set_ihdr(png.get(), &header);
  spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_option(png.get(), SPNG_IMG_COMPRESSION_LEVEL, 9);
  // Noise in few steps packs a fifth smaller as it is than as differences.
  spng_set_option(png.get(), SPNG_FILTER_CHOICE, SPNG_DISABLE_FILTERING);
  int error = spng_encode_image(png.get(), image.pixels().data(),
                                image.pixels().size() * sizeof(std::uint16_t), SPNG_FMT_PNG,
                                SPNG_ENCODE_FINALIZE);
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      error ? nullptr : spng_get_png_buffer(png.get(), &size, &error), &std::free);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: PNG encoder: {}, expected no error", file.string(), spng_strerror(error)));
  write_bytes(file, static_cast<const char*>(buffer.get()), size);
}

void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh,
               const std::string& title) {
  std::string bytes = title;
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3f &a = mesh.vertices_m[ia], &b = mesh.vertices_m[ib],
                          &c = mesh.vertices_m[ic];
    const Eigen::Vector3f normal = (b - a).cross(c - a).normalized();
    for (const Eigen::Vector3f& v : {normal, a, b, c}) put(bytes, v);
    put(bytes, std::uint16_t{0});
  }
  write_bytes(file, bytes.data(), bytes.size());
}

}  // namespace berth::lab
