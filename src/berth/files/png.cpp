#include "berth/files/png.hpp"

#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "berth/files/depth_units.hpp"
#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"

namespace berth {
namespace {

// Type and CRC of the chunk that ends every PNG.
constexpr std::string_view kLastChunk = "IEND\xAE\x42\x60\x82";

// Signature and header, which every PNG begins with, and the whole of its last chunk.
constexpr std::size_t kHeadBytes = 33;

constexpr std::size_t kMostText = std::size_t{1} << 20;

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

Context make_context(int flags) {
  Context context(spng_ctx_new(flags), &spng_ctx_free);
  if (!context) throw std::bad_alloc();
  return context;
}

void check_read(int code, const std::filesystem::path& file) {
  if (code == 0) return;
  throw_bad_file({file}, spng_strerror(code), "a complete and undamaged PNG file");
}

void check_write(int code, const std::filesystem::path& file) {
  if (code == 0) return;
  throw_bad_file({file}, spng_strerror(code), "an image that PNG can hold");
}

const char* color_type_name(int color_type) {
  switch (color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      return "grayscale";
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return "RGB";
    case SPNG_COLOR_TYPE_INDEXED:
      return "palette";
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return "grayscale with alpha";
    default:
      return "RGB with alpha";
  }
}

void check_header(const spng_ihdr& header, const std::filesystem::path& file,
                  const Camera& expected_size, PngDepths depths) {
  const bool depth_fits =
      header.bit_depth == 16 || (header.bit_depth == 8 && depths == PngDepths::from_8_to_16_bit);
  if (header.color_type != SPNG_COLOR_TYPE_GRAYSCALE || !depth_fits) {
    throw_bad_file(
        {file}, fmt::format("{}-bit {}", header.bit_depth, color_type_name(header.color_type)),
        depths == PngDepths::only_16_bit ? "16-bit grayscale" : "8- or 16-bit grayscale");
  }
  if (header.width != static_cast<std::uint32_t>(expected_size.width_px) ||
      header.height != static_cast<std::uint32_t>(expected_size.height_px)) {
    throw_bad_file({file}, fmt::format("{} x {} pixels", header.width, header.height),
                   fmt::format("{} x {}, as the camera_info says", expected_size.width_px,
                               expected_size.height_px));
  }
}

/// Other images have other signatures: their name says more than that this one is wrong.
void require_png(const std::filesystem::path& file, std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG")) return;
  constexpr std::array kOthers{
      std::pair{"\x93NUMPY"sv, "is a NumPy array"}, std::pair{"\xFF\xD8"sv, "is a JPEG image"},
      std::pair{"II*\0"sv, "is a TIFF image"},      std::pair{"MM\0*"sv, "is a TIFF image"},
      std::pair{"v/1\1"sv, "is an OpenEXR image"},  std::pair{"P5"sv, "is a PGM image"}};
  const auto other =
      std::ranges::find_if(kOthers, [&](const auto& one) { return bytes.starts_with(one.first); });
  throw_bad_file({file}, other == kOthers.end() ? "is no PNG file" : other->second,
                 "a 16-bit PNG file; Python's berth.io.write_depth makes one of an array");
}

/// The bytes have to outlive what is read next.
spng_ihdr read_header(const Context& context, const std::string& bytes,
                      const std::filesystem::path& file) {
  if (!bytes.empty()) require_png(file, bytes);
  check_read(spng_set_crc_action(context.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR), file);
  check_read(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()), file);
  // Text in an image unfolds when it is read; nobody reads it.
  check_read(spng_set_chunk_limits(context.get(), kMostText, kMostText), file);
  spng_ihdr header{};
  check_read(spng_get_ihdr(context.get(), &header), file);
  return header;
}

}  // namespace

Image<std::uint16_t> read_gray_png(const std::filesystem::path& file, const Camera& expected_size,
                                   PngDepths depths) {
  const std::string bytes = read_file_bytes(file);
  const Context context = make_context(0);
  const spng_ihdr header = read_header(context, bytes, file);
  check_header(header, file, expected_size, depths);

  Image<std::uint16_t> image(expected_size.width_px, expected_size.height_px);
  const auto decode = [&](auto& pixels) {
    check_read(spng_decode_image(context.get(), pixels.data(),
                                 std::as_writable_bytes(std::span(pixels)).size(), SPNG_FMT_PNG, 0),
               file);
  };
  if (header.bit_depth == 16) {
    decode(image.pixels());
  } else {
    std::vector<std::uint8_t> narrow(image.pixels().size());
    decode(narrow);
    image.pixels().assign(narrow.begin(), narrow.end());
  }
  // A file that was cut after its pixels is refused, too; the library does not miss a cut last
  // chunk.
  check_read(spng_decode_chunks(context.get()), file);
  check_read(bytes.find(kLastChunk) == std::string::npos ? SPNG_EOF : 0, file);
  return image;
}

void check_gray_png(const std::filesystem::path& file, const Camera& expected_size,
                    PngDepths depths) {
  const FileEnds ends = read_file_ends(file, kHeadBytes);
  const Context context = make_context(0);
  check_header(read_header(context, ends.first, file), file, expected_size, depths);
  // Bytes behind the last chunk are allowed.
  if (!ends.last.ends_with(kLastChunk)) read_gray_png(file, expected_size, depths);
}

void write_gray_png(const std::filesystem::path& file, const Image<std::uint16_t>& image,
                    int bit_depth) {
  const Context context = make_context(SPNG_CTX_ENCODER);
  check_write(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1), file);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width());
  header.height = static_cast<std::uint32_t>(image.height());
  header.bit_depth = static_cast<std::uint8_t>(bit_depth);
  header.color_type = SPNG_COLOR_TYPE_GRAYSCALE;
  check_write(spng_set_ihdr(context.get(), &header), file);
  const auto encode = [&](const auto& pixels) {
    check_write(
        spng_encode_image(context.get(), pixels.data(), std::as_bytes(std::span(pixels)).size(),
                          SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE),
        file);
  };
  if (bit_depth == 8) {
    encode(std::vector<std::uint8_t>(image.pixels().begin(), image.pixels().end()));
  } else {
    encode(image.pixels());
  }
  std::size_t size = 0;
  int code = 0;
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      spng_get_png_buffer(context.get(), &size, &code), &std::free);
  check_write(code, file);
  write_file_bytes(file, {static_cast<const char*>(buffer.get()), size});
}

namespace {

void check_scale(const std::filesystem::path& file, double depth_scale_m) {
  if (is_depth_scale(depth_scale_m)) return;
  throw_bad_file({file, 0, "depth scale"}, fmt::format("{}", depth_scale_m), kDepthScaleExpected);
}

template <typename T, typename ToNumber>
Image<std::uint16_t> numbers_of(ImageView<T> image, ToNumber to_number) {
  Image<std::uint16_t> numbers(image.width, image.height);
  for (int v = 0; v < image.height; ++v) {
    std::transform(image.row(v), image.row(v) + image.width, numbers.row(v), to_number);
  }
  return numbers;
}

}  // namespace

bool is_depth_scale(double depth_scale_m) { return depth_scale_m >= 1e-6 && depth_scale_m <= 0.1; }

DepthImage read_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                          double depth_scale_m, double near_m, double far_m, double offset_m) {
  check_scale(file, depth_scale_m);
  const Image<std::uint16_t> units = read_gray_png(file, expected_size, PngDepths::only_16_bit);
  DepthImage depth_m(units.width(), units.height());
  std::transform(units.pixels().begin(), units.pixels().end(), depth_m.pixels().begin(),
                 [rule = DepthUnits{depth_scale_m, offset_m, near_m, far_m}](std::uint16_t number) {
                   return depth_of(number, rule);
                 });
  return depth_m;
}

void check_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                     double depth_scale_m) {
  check_scale(file, depth_scale_m);
  check_gray_png(file, expected_size, PngDepths::only_16_bit);
}

Image<LinkId> read_link_ids_png(const std::filesystem::path& file, const Camera& expected_size) {
  return read_gray_png(file, expected_size, PngDepths::from_8_to_16_bit);
}

void write_depth_png(const std::filesystem::path& file, DepthView depth_m, double depth_scale_m) {
  check_scale(file, depth_scale_m);
  const auto to_units = [=](float z_m) { return number_of(z_m, depth_scale_m); };
  write_gray_png(file, numbers_of(depth_m, to_units), 16);
}

void write_link_ids_png(const std::filesystem::path& file, ImageView<LinkId> link_id) {
  const Image<std::uint16_t> ids = numbers_of(link_id, [](LinkId id) { return id; });
  const bool narrow =
      std::all_of(ids.pixels().begin(), ids.pixels().end(), [](LinkId id) { return id <= 255; });
  write_gray_png(file, ids, narrow ? 8 : 16);
}

}  // namespace berth
