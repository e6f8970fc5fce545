#include "apps/berth/command_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

#include "berth/files/file_bytes.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// Those that --help shows.
std::vector<CLI::App*> shown_commands(CLI::App& program) {
  std::vector<CLI::App*> commands = program.get_subcommands({});
  std::erase_if(commands, [](const CLI::App* command) { return command->get_group().empty(); });
  return commands;
}

std::vector<const CLI::Option*> shown_options(CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) options.push_back(option);
  }
  return options;
}

/// The words that the option takes, where it takes no others: CLI11 reports them as
/// "TEXT:{on,off}".
std::vector<std::string> words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t first = type.find('{'), last = type.rfind('}');
  if (first == std::string::npos || last == std::string::npos) return {};
  std::vector<std::string> words;
  std::istringstream text(type.substr(first + 1, last - first - 1));
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

std::string value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::vector<std::string> words = words_of(option);
  if (!words.empty()) return fmt::format("{}", fmt::join(words, "|"));
  const std::string type = option.get_type_name();
  return type.substr(0, type.find_first_of(": "));
}

namespace {

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// As roff takes it: nothing in it is a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) escaped += "\\&";
    if (text[i] == '\\') {
      escaped += "\\e";
    } else {
      escaped += text[i] == '-' ? "\\-" : std::string(1, text[i]);
    }
  }
  return escaped;
}

std::string option_entry(const CLI::Option& option) {
  std::string head = option.get_positional() ? value_of(option)
                                             : fmt::format("{}", fmt::join(names_of(option), ", "));
  if (!option.get_positional() && !value_of(option).empty()) head += " " + value_of(option);
  return fmt::format(".TP\n.B {}\n{}\n", roff(head), roff(option.get_description()));
}

std::string synopsis(const std::string& name, CLI::App& command) {
  std::string text = fmt::format(".B {}\n", roff(name));
  for (const CLI::Option* option : shown_options(command)) {
    if (!option->get_required()) continue;
    const std::string value = value_of(*option);
    text += roff(option->get_positional() ? value
                                          : fmt::format("{} {}", names_of(*option).back(), value)) +
            "\n";
  }
  return text + "[options]\n";
}

/// `text` keeps its lines.
std::string section(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format(".SH {}\n.nf\n{}\n.fi\n", title, roff(text));
}

std::string page_of(const std::string& name, CLI::App& command, const std::string& middle) {
  std::string page = name;
  std::ranges::replace(page, ' ', '-');
  std::string upper = page;
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return std::toupper(c); });
  const std::string what = command.get_description();
  std::string text =
      fmt::format(".TH {} 1 \"\" \"berth {}\" \"User Commands\"\n", roff(upper), BERTH_VERSION);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", roff(page),
                      roff(what.substr(0, what.find('\n'))), synopsis(name, command));
  text += section("DESCRIPTION", what) + middle + ".SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(command)) text += option_entry(*option);
  return text + section("EXAMPLES", command.get_footer()) +
         section(
             "EXIT STATUS",
             "0 done; 1 could not, and standard error says why; 2 wrong usage; 130 interrupted");
}

}  // namespace

std::map<std::string, std::string> manual_pages(CLI::App& program) {
  std::map<std::string, std::string> pages;
  std::string commands = ".SH COMMANDS\n";
  for (CLI::App* command : shown_commands(program)) {
    const std::string name = command->get_name();
    commands += fmt::format(".TP\n.B {}\n{}; see berth\\-{}(1)\n", roff(name),
                            roff(command->get_description()), roff(name));
    pages["berth-" + name + ".1"] = page_of("berth " + name, *command, "");
  }
  pages["berth.1"] = page_of("berth", program, commands);
  return pages;
}

std::string bash_completion(CLI::App& program) {
  std::vector<std::string> first{"--help", "--version"};
  std::string options, words;
  for (CLI::App* command : shown_commands(program)) {
    const std::string name = command->get_name();
    first.push_back(name);
    std::vector<std::string> names;
    for (const CLI::Option* option : shown_options(*command)) {
      for (const std::string& one : names_of(*option)) {
        names.push_back(one);
        if (words_of(*option).empty()) continue;
        words += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", name, one,
                             fmt::join(words_of(*option), " "));
      }
    }
    options += fmt::format("      {}) words=\"{}\" ;;\n", name, fmt::join(names, " "));
  }
  return fmt::format(
      "# What bash completes for berth; made from its options.\n"
      "_berth() {{\n"
      "  local current=\"${{COMP_WORDS[COMP_CWORD]}}\" words=\"\"\n"
      "  case \"${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}\" in\n"
      "{}"
      "  esac\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
      "    words=\"{}\"\n"
      "  elif [[ -z $words && $current == -* ]]; then\n"
      "    case \"${{COMP_WORDS[1]}}\" in\n"
      "{}"
      "    esac\n"
      "  fi\n"
      "  if [[ -n $words ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "  else\n"
      "    compopt -o filenames 2>/dev/null\n"
      "    COMPREPLY=($(compgen -f -- \"$current\"))\n"
      "  fi\n"
      "}}\n"
      "complete -F _berth berth\n",
      words, fmt::join(first, " "), options);
}

void write_command_pages(CLI::App& program, const fs::path& folder) {
  const fs::path manual = folder / "man/man1", completions = folder / "bash-completion/completions";
  fs::create_directories(manual);
  fs::create_directories(completions);
  for (const auto& [name, text] : manual_pages(program)) write_file_bytes(manual / name, text);
  write_file_bytes(completions / "berth", bash_completion(program));
}

}  // namespace berth::app
