#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "handle.h"

namespace penumbra::gl {

void delete_query(GLuint id);

// Time per pass. On a GPU: timer queries read frames later, so that they never stall. On a software rasteriser, which
// defers work, a finish on both sides of each pass and the CPU's clock. Passes outside of a frame are not recorded.
class Timers {
 public:
  enum class Mode { off, query, finish };
  explicit Timers(Mode mode = Mode::off) : mode_(mode) {}

  Mode mode() const { return mode_; }
  void begin_frame();                 // drops a frame that an exception left open
  void begin(std::string_view name);  // passes may nest; a nested one is named "outer/inner"
  void end();
  void end_frame();

  // begin() and end() in a scope.
  class Scope {
   public:
    Scope(Timers& timers, std::string_view name) : timers_(timers) { timers_.begin(name); }
    ~Scope() { timers_.end(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
  };

  // What a pass hands to OpenGL.
  struct Work {
    std::size_t draws = 0;       // draw commands, those within one call of an indirect draw each counted
    std::size_t triangles = 0;   // of all their instances, before anything is culled
    std::size_t dispatches = 0;  // of compute
  };
  // Adds to the passes that are open, and to the frame.
  void count(const Work& work);
  // Of the last frame that ended, by pass as in rows(); "frame" has all of it. Passes without any are left out.
  const std::map<std::string, Work>& work() const { return work_; }

  struct Row {
    std::string name;
    std::vector<double> milliseconds;  // one a frame, oldest first; a pass drawn twice in a frame is summed
  };
  // Waits for what is outstanding. Rows in the order of their first appearance; the last row is "frame".
  std::vector<Row> rows();

  // The frames whose times are all in, without waiting, for programs that run on and on: rows() knows them no more.
  struct Taken {
    std::size_t first = 0;  // number of the frame that each row begins with
    std::vector<Row> rows;  // all of one length
  };
  Taken take();
  // The number of the next frame to begin, from 0.
  std::size_t next_frame() const { return frame_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Open {
    std::size_t row = 0;
    Clock::time_point started;
    Handle<delete_query> query;
  };
  struct Pending {
    std::size_t row = 0, frame = 0;
    Handle<delete_query> begin, end;
  };

  Open start(std::size_t row);
  void finish(Open open);
  std::size_t row_index(const std::string& name);
  Handle<delete_query> timestamp();
  void record(std::size_t row, std::size_t frame, double milliseconds);
  void collect(bool wait);
  void drop_open_frame();

  static constexpr std::size_t frame_row = 0;

  Mode mode_;
  bool in_frame_ = false;
  std::size_t frame_ = 0;
  std::size_t first_kept_ = 0;  // of the frames in rows_
  Open open_frame_;
  std::vector<Open> stack_;
  std::deque<Pending> pending_;
  std::vector<Handle<delete_query>> free_queries_;
  std::vector<Row> rows_;  // [frame_row] is the frame
  std::map<std::string, std::size_t, std::less<>> row_indices_;
  std::map<std::string, Work> open_work_, work_;  // of the frame that is open, of the one before
};

}  // namespace penumbra::gl
