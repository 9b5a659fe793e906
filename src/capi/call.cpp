#include "call.h"

#include <algorithm>
#include <new>

#include "../core/error.h"
#include "../gl/context.h"

namespace penumbra::capi {

namespace {

constexpr const char* no_memory = "no memory is left";

struct LastError {
  std::string text;
  const char* shown = "";
};
thread_local LastError last_error;

void keep(const char* function, const char* message) noexcept {
  try {
    last_error.text = fmt::format("{}{}{}", function, *function == '\0' ? "" : "(): ", message);
    while (last_error.text.ends_with('\n')) last_error.text.pop_back();
    last_error.shown = last_error.text.c_str();
  } catch (...) {
    last_error.shown = no_memory;
  }
}

}  // namespace

penumbra_result keep_failure(const char* function) noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    keep(function, failure.what());
    return failure.result();
  } catch (const gl::ContextError& error) {
    keep("", error.what());
    return PENUMBRA_ERROR_CONTEXT;
  } catch (const Error& error) {
    keep("", error.what());
    return PENUMBRA_ERROR_REFUSED;
  } catch (const std::bad_alloc&) {
    last_error.shown = no_memory;
    return PENUMBRA_ERROR_MEMORY;
  } catch (const std::exception& error) {
    keep(function, error.what());
  } catch (...) {
    keep(function, "an exception of an unknown type");
  }
  return PENUMBRA_ERROR_INTERNAL;
}

void write_text(const std::string& text, char* buffer, std::size_t capacity, std::size_t* length) {
  if (buffer == nullptr && capacity > 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "'text' is null and 'capacity' is not 0");
  const std::size_t needed = text.size() + 1;
  if (length != nullptr) *length = needed;
  if (buffer == nullptr) return;
  if (capacity < needed) {
    if (capacity > 0) *buffer = '\0';
    fail_with(PENUMBRA_ERROR_BUFFER, "the text takes {} bytes and 'capacity' is {}", needed, capacity);
  }
  std::copy_n(text.c_str(), needed, buffer);
}

}  // namespace penumbra::capi

const char* penumbra_last_error(void) { return penumbra::capi::last_error.shown; }

const char* penumbra_result_name(penumbra_result result) {
  switch (result) {
    case PENUMBRA_OK:
      return "PENUMBRA_OK";
    case PENUMBRA_ERROR_ARGUMENT:
      return "PENUMBRA_ERROR_ARGUMENT";
    case PENUMBRA_ERROR_REFUSED:
      return "PENUMBRA_ERROR_REFUSED";
    case PENUMBRA_ERROR_CONTEXT:
      return "PENUMBRA_ERROR_CONTEXT";
    case PENUMBRA_ERROR_CALLBACK:
      return "PENUMBRA_ERROR_CALLBACK";
    case PENUMBRA_ERROR_BUFFER:
      return "PENUMBRA_ERROR_BUFFER";
    case PENUMBRA_ERROR_MEMORY:
      return "PENUMBRA_ERROR_MEMORY";
    case PENUMBRA_ERROR_INTERNAL:
      return "PENUMBRA_ERROR_INTERNAL";
  }
  return "unknown";
}

uint32_t penumbra_version(void) {
  return 1000000u * PENUMBRA_VERSION_MAJOR + 1000u * PENUMBRA_VERSION_MINOR + PENUMBRA_VERSION_PATCH;
}
