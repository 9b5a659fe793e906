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

// In this scope, messages that the calling thread logs go to `sink` instead. Scopes may nest; `sink` is not
// empty and outlives its scope.
class ThreadLogSink {
 public:
  explicit ThreadLogSink(const LogSink& sink);
  ~ThreadLogSink();
  ThreadLogSink(const ThreadLogSink&) = delete;
  ThreadLogSink& operator=(const ThreadLogSink&) = delete;

 private:
  const LogSink* outer_;
};

template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::warning, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  log(LogLevel::info, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace penumbra
