#pragma once

#include "context.h"

namespace penumbra::gl {

// What the backends share: which context is current, entry points and debug output.
class ContextBase : public Context {
 public:
  void make_current() final;

 protected:
  explicit ContextBase(bool debug) : debug_(debug) {}

  // For the most derived destructor: unbinds this context if it is current.
  void release();

 private:
  virtual void bind() = 0;  // throws Error
  virtual void unbind() noexcept = 0;

  bool debug_;
};

}  // namespace penumbra::gl
