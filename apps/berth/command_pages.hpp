// Manual pages and a shell's completions, made of the command's options.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace berth::app {

/// What stands behind the option's name, such as "FILE" or "table|json"; empty for a flag.
std::string value_of(const CLI::Option& option);

/// By file name: berth.1, and one for each command, such as berth-run.1.
std::map<std::string, std::string> manual_pages(CLI::App& program);

/// A script for bash: commands, their options, and the words that an option takes; else files.
std::string bash_completion(CLI::App& program);

/// Writes man/man1/ and bash-completion/completions/ into the folder, as systems have them in
/// share/. Throws std::runtime_error where that cannot be done.
void write_command_pages(CLI::App& program, const std::filesystem::path& folder);

}  // namespace berth::app
