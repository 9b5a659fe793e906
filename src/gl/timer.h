#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "handle.h"

namespace penumbra::gl {

void delete_query(GLuint id);

// Time per pass. On a GPU: timer queries read frames later, so that they never stall. On a software rasteriser, which
// defers work, a finish on both sides of each pass and the CPU's clock.
class Timers {
 public:
  enum class Mode { off, query, finish };
  explicit Timers(Mode mode = Mode::off) : mode_(mode) {}

  Mode mode() const { return mode_; }
  void begin_frame();
  void begin(std::string_view name);  // passes may nest; a nested one is named "outer/inner"
  void end();
  void end_frame();

  struct Row {
    std::string name;
    std::vector<double> milliseconds;  // one a frame, oldest first; a pass drawn twice in a frame is summed
  };
  // Waits for what is outstanding. Rows in the order of their first appearance; the last row is "frame".
  std::vector<Row> rows();

 private:
  struct Pending {
    std::string name;
    Handle<delete_query> begin, end;
    size_t frame;
  };
  void record(const std::string& name, size_t frame, double milliseconds);
  void collect(bool wait);

  Mode mode_;
  size_t frame_ = 0;
  std::vector<std::string> stack_;
  std::vector<double> started_;
  std::vector<Handle<delete_query>> started_queries_;
  std::deque<Pending> pending_;
  std::vector<Handle<delete_query>> free_queries_;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>, std::less<>> times_;
};

}  // namespace penumbra::gl
