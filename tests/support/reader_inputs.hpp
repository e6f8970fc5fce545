// Bytes of any kind through each reader of a file: for the fuzzers, and for what they found.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace berth {

/// One reader: takes the bytes as a file's. Throws std::exception where it refuses them.
struct ReaderInput {
  /// Of the fuzzer, and of the folder of inputs below tests/broken_files/.
  std::string_view name;
  void (*read)(std::span<const std::uint8_t> bytes);
};

/// png, camera_info, scene, joints_csv, urdf, stl, obj, dae, recording.
std::span<const ReaderInput> reader_inputs();

}  // namespace berth
