#pragma once

#include <array>
#include <functional>

#include "context.h"

namespace penumbra::gl {

struct Api;

// Legacy state: what the compatibility profile keeps of older versions of OpenGL beside the core profile. Most of it
// has no effect on programs of shaders. The rest is here, by the specification of the profile (Segal and Akeley,
// OpenGL 4.5, 2017).

// For load_api(): loads what sets the legacy state of the current context, which is of the compatibility profile.
void find_legacy_state(Api& api, const std::function<void*(const char*)>& get_proc_address);

// Whether the context has legacy state whose entry points the calling thread uses.
bool has_legacy_state();

// Gives legacy state that could change what is drawn or how texels are transferred its initial values. Does nothing in
// contexts of the core profile. For each pass, since the caller's functions that draw may set such state.
void set_initial_legacy_state();

// In this scope legacy state that could change what is drawn or how texels are transferred has its initial values;
// afterwards it is as before. Does nothing in contexts of the core profile.
class InitialLegacyState {
 public:
  InitialLegacyState();
  ~InitialLegacyState();
  InitialLegacyState(const InitialLegacyState&) = delete;
  InitialLegacyState& operator=(const InitialLegacyState&) = delete;

  static constexpr std::size_t tests = 4, switches = 2, scales = 10;

 private:
  std::array<bool, tests> tests_{};       // capabilities
  int fragment_clamp_ = 0;                // of what fragment shaders write
  std::array<float, 2> point_sizes_{};    // the least and the greatest, pixels
  std::array<int, switches> switches_{};  // of pixel transfer: maps of colours and stencil
  std::array<float, scales> scales_{};    // and the factors and offsets of its channels
};

// Throws ContextError, beginning with `subject`, where no OpenGL call could have an effect: entry points are not loaded
// or no context is current.
void check_context_is_current(const char* subject);
// The same where passes can't be drawn: the compatibility profile records calls for a display list, or transform
// feedback of the caller's is active and not paused.
void check_context_is_ready(const char* subject);

}  // namespace penumbra::gl
