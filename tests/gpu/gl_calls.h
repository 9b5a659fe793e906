#pragma once

#include <map>
#include <string>

namespace penumbra::test {

// Counts calls of OpenGL while it lives: Penumbra's entry points of a kind are replaced by ones that count and go on to
// the real ones. One at a time; the context of its beginning stays current.
class GlCalls {
 public:
  enum class Kind {
    queries,    // what asks OpenGL for something: glGet…, glIs…, glCheck…
    creations,  // what makes an object: glCreate…, glGen… (each call is one, however many objects it makes)
  };
  explicit GlCalls(Kind kind);
  ~GlCalls();
  GlCalls(const GlCalls&) = delete;
  GlCalls& operator=(const GlCalls&) = delete;

  // Calls so far, by function; those without any are left out.
  std::map<std::string, int> counts() const;
  void reset();

 private:
  Kind kind_;
};

}  // namespace penumbra::test
