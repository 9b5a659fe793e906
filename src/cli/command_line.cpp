#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "cli/help_groups.h"
#include "cli/help_reader.h"
#include "cli/progress.h"
#include "cli/resources.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "core/log.h"
#include "core/names.h"
#include "io/output_file.h"

namespace penumbra::cli {

namespace {

// Log levels by name. "quiet" is above the level of every message; the error that ends a command is none of them.
const std::map<std::string, int>& log_levels() {
  static const std::map<std::string, int> levels{{"debug", static_cast<int>(LogLevel::debug)},
                                                 {"info", static_cast<int>(LogLevel::info)},
                                                 {"warning", static_cast<int>(LogLevel::warning)},
                                                 {"error", static_cast<int>(LogLevel::error)},
                                                 {"quiet", static_cast<int>(LogLevel::error) + 1}};
  return levels;
}

// CLI11 puts two empty lines between headings.
std::string without_double_gaps(std::string text) {
  for (std::size_t at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n", at)) text.erase(at, 1);
  return text;
}

std::function<void(const CLI::App&)>& help_reader() {
  static std::function<void(const CLI::App&)> reader = [](const CLI::App& options) {
    fmt::print("{}", wrapped(without_double_gaps(options.help())));
  };
  return reader;
}

void log_from(const std::string& name) {
  const auto found = log_levels().find(name);
  if (found == log_levels().end()) {
    std::vector<std::string> names;
    for (const auto& [level, value] : log_levels()) names.push_back(level);
    fail_unknown_usage("log level", name, names);
  }
  set_log_sink([least = found->second](LogLevel level, std::string_view message) {
    if (static_cast<int>(level) < least) return;
    static constexpr const char* labels[] = {"debug", "info", "warning", "error"};
    // Not by fmt::print, which throws where stderr is closed or full.
    std::fputs(fmt::format("{}{}: {}\n", line_start(), labels[static_cast<int>(level)], printable(std::string(message)))
                   .c_str(),
               stderr);
  });
}

[[noreturn]] void fail_extra(const CLI::App& options, const std::string& extra) {
  if (!extra.starts_with('-')) fail_usage("unexpected argument '{}'", extra);
  std::vector<std::string> names;
  for (const CLI::Option* option : options.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string name = extra.substr(0, extra.find('='));
  const std::vector<std::string> near = near_names(name, names);
  if (near.empty()) fail_usage("unknown option '{}'; see {} --help", name, options.get_name());
  fail_unknown_usage("option", name, names);
}

// Arguments that are neither options nor expected by the command. CLI11 leaves the separator "--" among them; arguments
// after it are never options.
void refuse_extras(const CLI::App& options) {
  bool only_positional = false;
  for (const std::string& extra : options.remaining()) {
    if (extra == "--" && !only_positional) {
      only_positional = true;
    } else if (only_positional) {
      fail_usage("unexpected argument '{}'", extra);
    } else {
      fail_extra(options, extra);
    }
  }
}

// Explains the error if an argument that the parser took for an option is the name of a file.
void hint_at_file(const Arguments& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    std::error_code ignored;
    if (argument.size() > 1 && argument.starts_with('-') && std::filesystem::exists(argument, ignored))
      fail_usage("'{}' is taken for an option; the file of that name is './{}'", argument, argument);
  }
}

// CLI11 would take "-o=x.png" as the value "=x.png".
void refuse_equals_after_short_name(const CLI::App& options, const Arguments& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (argument.size() < 3 || argument[0] != '-' || argument[2] != '=') continue;
    const CLI::Option* option = options.get_option_no_throw(argument.substr(0, 2));
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    fail_usage("'{}': the value of {} follows after a space, or after '--{}='", argument, argument.substr(0, 2),
               option->get_lnames().front());
  }
}

// CLI11 takes "--size" in "-o --size 16x16" as the value of -o, and "--" in "-o -- scene.glb". In "--output=--size" it
// is one.
void refuse_options_as_values(const CLI::App& options, const Arguments& arguments) {
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
    const std::string& value = arguments[i + 1];
    if (arguments[i] == "--") return;
    if (!arguments[i].starts_with('-') || !value.starts_with("--")) continue;
    const CLI::Option* option = options.get_option_no_throw(arguments[i]);
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    if (value == "--") fail_usage("{} lacks its value: '--' ends the options", option->get_name());
    if (options.get_option_no_throw(value.substr(0, value.find('='))) != nullptr)
      fail_usage("{} lacks its value: '{}' is an option", option->get_name(), value);
  }
}

// CLI11 says "--size: 1 required WIDTHxHEIGHT missing" and "--size: At Most 1 required but received 2".
std::string one_line(const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string option = text.substr(0, text.find(':'));
  if (text.find(" missing") != std::string::npos) return option + " lacks its value";
  if (const std::size_t end = text.find(" was given a disallowed flag"); end != std::string::npos)
    return "--" + text.substr(0, end) + " takes no value";
  if (text.find("At Most 1") != std::string::npos) return option + " is given twice";
  return text;
}

constexpr const char no_output[] = "cannot write to standard output";

// Exceptions of the system and the standard library. Any other exception is a bug in Penumbra.
std::string sentence_of(const std::exception& error) {
  const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  // A container that was asked to be larger than any can be.
  if (no_memory || dynamic_cast<const std::length_error*>(&error) != nullptr) return memory_refused();
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return fmt::format("{}: {}", io::quoted(file->path1()), file->code().message());
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    if (system->code() == std::errc::not_enough_memory) return memory_refused();
    if (system->code() == std::errc::resource_unavailable_try_again) return threads_refused();
  }
  return std::string("internal error: ") + error.what();
}

// Always one line, so that scripts can read it: names from files may hold line breaks.
int report(const std::string& message, int code) {
  // fmt::print would throw where stderr is closed.
  std::fputs(fmt::format("error: {}\n", printable(message)).c_str(), stderr);
  return code;
}

}  // namespace

std::string version() { return "Penumbra " PENUMBRA_VERSION; }

int run_guarded(const std::function<int()>& program) {
  fail_writes_past_the_limit();
  try {
    const int code = program();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail(no_output);
    return code;
  } catch (const UsageError& error) {
    return report(error.what(), 2);
  } catch (const Error& error) {
    return report(error.what(), 1);
  } catch (const std::exception& error) {
    // Here fmt::print threw a system_error, which does not hold the cause.
    if (std::ferror(stdout) != 0) return report(no_output, 1);
    return report(sentence_of(error), 1);
  }
}

void read_help_with(std::function<void(const CLI::App&)> reader) { help_reader() = std::move(reader); }

bool parse(CLI::App& options, const Arguments& arguments) {
  std::string level = "warning";
  options
      .add_option("--log-level", level,
                  "Least severe message to show; quiet: only the error that ends the command (warning)")
      ->type_name("debug|info|warning|error|quiet");
  options.allow_extras();
  group_options(options);
  refuse_equals_after_short_name(options, arguments);
  refuse_options_as_values(options, arguments);
  try {
    options.parse(Arguments(arguments.rbegin(), arguments.rend()));  // CLI11 takes them last first
  } catch (const CLI::CallForHelp&) {
    help_reader()(options);
    return false;
  } catch (const CLI::RequiredError& error) {
    hint_at_file(arguments);
    refuse_extras(options);  // reported first, since a mistyped option often is why the scene seems to be missing
    throw UsageError(one_line(error));
  } catch (const CLI::ParseError& error) {
    hint_at_file(arguments);
    throw UsageError(one_line(error));
  }
  if (options.remaining_size() > 0) hint_at_file(arguments);
  refuse_extras(options);
  log_from(level);
  return true;
}

}  // namespace penumbra::cli
