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

// Time per pass. On a GPU: timer queries, read some frames later so that they never stall. On a software rasteriser,
// which defers work: the CPU's clock, with a glFinish before and after each pass, or before and after each frame alone:
// then no pass is recorded, and the driver may work on several at once. Passes outside of a frame are not recorded.
class Timers {
 public:
  enum class Mode { off, query, finish, finish_frames };
  explicit Timers(Mode mode = Mode::off) : mode_(mode) {}

  Mode mode() const { return mode_; }
  void begin_frame();                 // discards a frame that an exception left open
  void begin(std::string_view name);  // passes may nest; a nested one is named "outer/inner"
  void end();
  void end_frame();

  // Calls begin() and end().
  class Scope {
   public:
    Scope(Timers& timers, std::string_view name) : timers_(timers) { timers_.begin(name); }
    ~Scope() { timers_.end(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
  };

  // While it lives, time and work do not count: what is drawn is no part of the open frame. (Of timer queries, which
  // a GPU answers, the frame's total still contains it.)
  class Break {
   public:
    explicit Break(Timers& timers);
    ~Break();
    Break(const Break&) = delete;
    Break& operator=(const Break&) = delete;

   private:
    Timers& timers_;
    bool in_frame_;
    double cpu_began_ = 0;
    std::chrono::steady_clock::time_point began_;
  };

  // What a pass submits to OpenGL.
  struct Work {
    std::size_t draws = 0;       // draw commands; an indirect draw counts as many as it has commands
    std::size_t triangles = 0;   // of all instances, before culling
    std::size_t dispatches = 0;  // of compute
  };
  // Milliseconds of processor time that the drawing thread spent in each frame, between begin_frame() and end_frame(),
  // as many as a row has. Time spent in finishes is left out, so it is what the program and the
  // driver take to submit the frame. What the driver does in threads of its own is not in it; shaders that a software
  // rasteriser runs in the calling thread are.
  const std::vector<double>& cpu_milliseconds() const { return cpu_; }
  // Adds to the open passes and to the frame.
  void count(const Work& work);
  // The work of the last frame that ended, by the names of rows(); "frame" has all of it. Passes without work are left
  // out.
  const std::map<std::string, Work>& work() const { return work_; }

  struct Row {
    std::string name;
    std::vector<double> milliseconds;  // one per frame, oldest first; a pass drawn twice in a frame is summed
  };
  // Waits for what is outstanding. Rows in the order of their first appearance; the last row is "frame".
  std::vector<Row> rows();

  // Removes and returns the frames whose times are complete, without waiting: for programs that run for a long time.
  struct Taken {
    std::size_t first = 0;         // number of the frame that each row begins with
    std::vector<Row> rows;         // all of one length
    std::vector<double> cpu = {};  // see cpu_milliseconds()
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
  void wait_for_gpu();
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
  std::vector<Row> rows_;                    // [frame_row] is the frame
  double cpu_started_ = 0, cpu_waited_ = 0;  // of the open frame, milliseconds
  std::vector<double> cpu_;
  std::map<std::string, std::size_t, std::less<>> row_indices_;
  std::map<std::string, Work> open_work_, work_;  // of the open frame, and of the last one that ended
};

}  // namespace penumbra::gl
