#pragma once

#include <map>
#include <string>

namespace penumbra::test {

// Counts OpenGL calls during its lifetime: it replaces entry points of a kind, in the table that the thread uses, by
// functions that count and then call the real ones. Only one may exist at a time, and the context that was current at
// its start must stay current.
class GlCalls {
 public:
  enum class Kind {
    queries,    // functions that query OpenGL: glGet…, glIs…, glCheck…
    creations,  // functions that create objects: glCreate…, glGen… (one per call, however many objects)
    writes,     // functions that write to buffers: gl…BufferSubData
  };
  explicit GlCalls(Kind kind);
  ~GlCalls();
  GlCalls(const GlCalls&) = delete;
  GlCalls& operator=(const GlCalls&) = delete;

  // Calls so far, by function; functions that were not called are left out.
  std::map<std::string, int> counts() const;
  void reset();

 private:
  Kind kind_;
};

}  // namespace penumbra::test
