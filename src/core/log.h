#pragma once

#include <fmt/format.h>

#include <functional>
#include <string_view>
#include <utility>

namespace penumbra {

enum class LogLevel { debug, info, warning, error };

// Receives each message of the library: one line, without a newline. May be called from any thread.
using LogSink = std::function<void(LogLevel, std::string_view)>;

// Replaces the sink; the default writes warnings and errors to stderr. Call before other threads start.
void set_log_sink(LogSink sink);

void log(LogLevel level, std::string_view message);

template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::warning, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::info, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace penumbra
