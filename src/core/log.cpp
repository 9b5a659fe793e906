#include "log.h"

#include <cstdio>
#include <mutex>
#include <utility>

namespace penumbra {
namespace {

void write_to_stderr(LogLevel level, std::string_view message) {
  if (level < LogLevel::warning) return;
  // Not by fmt::print, which throws where stderr is closed.
  std::fputs(fmt::format("{}: {}\n", level == LogLevel::warning ? "warning" : "error", message).c_str(), stderr);
}

struct Sink {
  std::mutex mutex;
  LogSink write = write_to_stderr;
};

Sink& sink() {
  static Sink instance;
  return instance;
}

thread_local const LogSink* thread_sink = nullptr;

}  // namespace

ThreadLogSink::ThreadLogSink(const LogSink& sink) : outer_(std::exchange(thread_sink, &sink)) {}
ThreadLogSink::~ThreadLogSink() { thread_sink = outer_; }

void set_log_sink(LogSink new_sink) {
  const std::lock_guard lock(sink().mutex);
  sink().write = new_sink ? std::move(new_sink) : LogSink(write_to_stderr);
}

void log(LogLevel level, std::string_view message) {
  if (thread_sink != nullptr) {
    (*thread_sink)(level, message);
    return;
  }
  const std::lock_guard lock(sink().mutex);
  sink().write(level, message);
}

}  // namespace penumbra
