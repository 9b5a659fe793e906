#include "context_base.h"

#include <utility>

#include "debug.h"

namespace penumbra::gl {
namespace {

// Each backend library remembers only its own current context and would still take it for current after another library
// has replaced it. So the current context is unbound through its own library before the next one is bound.
thread_local ContextBase* current = nullptr;

}  // namespace

void ContextBase::make_current() {
  if (current != nullptr && current != this) std::exchange(current, nullptr)->unbind();
  bind();
  current = this;
  load_api(get_proc_address());
  if (debug_) enable_debug_output();
}

void ContextBase::release() {
  if (current != this) return;
  current = nullptr;
  unbind();
}

}  // namespace penumbra::gl
