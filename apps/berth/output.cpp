#include "apps/berth/output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "apps/support/interrupt.hpp"
#include "berth/files/error.hpp"
#include "berth/results/result_json.hpp"
#include "berth/results/result_text.hpp"
#include "thesis/image_output.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// Such as "moved" or "moved: 31 % of the robot seen through, off by 0.054 m".
std::string trouble_text(const CameraState& state) {
  std::string text(name_of(state.status));
  if (state.status == CameraStatus::implausible && !std::isnan(state.watch.at_robot)) {
    return text + fmt::format(": {:.0f} % at the robot's surface", 100 * state.watch.at_robot);
  }
  if (state.status != CameraStatus::moved) return text;
  const char* before = ": ";
  if (!std::isnan(state.watch.seen_through)) {
    text +=
        fmt::format("{}{:.0f} % of the robot seen through", before, 100 * state.watch.seen_through);
    before = ", ";
  }
  if (!std::isnan(state.watch.displacement_m)) {
    text += fmt::format("{}off by {:.3f} m", before, state.watch.displacement_m);
  }
  return text;
}

/// Such as "camera left" or "cameras left, right (too_old)".
std::string cameras_text(const Result& result) {
  std::string text = result.cameras.size() == 1 ? "camera" : "cameras";
  const char* before = " ";
  for (const CameraResult& camera : result.cameras) {
    text += before + camera.camera;
    before = ", ";
    if (camera.status != CameraStatus::ok) text += fmt::format(" ({})", trouble_text(camera));
  }
  return text;
}

std::string table_of(const Result& result, std::string_view method, const std::string& table) {
  const bool timely = result.time.status == TimeStatus::ok;
  const std::string trouble =
      timely ? "" : fmt::format(", no answer: {}", name_of(result.time.status));
  const std::string separation =
      result.separation ? fmt::format("speed: {}\n", separation_text(result)) : "";
  return fmt::format("frame {}, {:.3f} s, {}, method {}, range {} m{}\n{}{}\n", result.frame,
                     result.stamp_s, cameras_text(result), method, result.range_m, trouble,
                     separation, table);
}

void require_folder_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder)) {
    throw_bad_file({file}, fmt::format("there is no folder {}", folder.string()),
                   "a file in an existing folder");
  }
}

}  // namespace

Output::Output(const CommonArguments& arguments) : format_(arguments.format) {
  // An empty path is standard output.
  if (arguments.out.empty()) return;
  require_folder_of(arguments.out);
  out_.emplace(arguments.out);
}

void Output::write(const Result& result) {
  put(format_ == OutputFormat::table ? table_of(result, kMethodName, result_table(result))
                                     : result_json(result) + "\n");
  ++count_;
}

void Output::write(const ImageResult& result) {
  put(format_ == OutputFormat::table
          ? table_of(result, name_of(result.method), image_result_table(result))
          : image_result_json(result) + "\n");
  ++count_;
}

void Output::close(const std::string& sentence) {
  if (format_ == OutputFormat::table) put(sentence + "\n");
}

void Output::put(const std::string& text) {
  if (out_) {
    out_->write(text);
  } else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
             std::fflush(stdout) != 0) {
    throw std::runtime_error(
        fmt::format("standard output: cannot be written to: {}", std::strerror(errno)));
  }
}

void Output::finish() {
  if (out_) out_->keep();
}

void keep_what_is_done(const CommonArguments& arguments, Output& output,
                       const std::function<void()>& work) {
  const auto keep = [&] {
    if (arguments.out.empty() || output.count() == 0) return std::string();
    output.finish();
    return fmt::format("; {} holds {} results", arguments.out.string(), output.count());
  };
  try {
    work();
  } catch (const Interrupted& interrupted) {
    throw Interrupted{interrupted.done + keep()};
  } catch (const std::exception& error) {
    throw std::runtime_error(error.what() + keep());
  }
}

}  // namespace berth::app
