#include "timer.h"

#include <algorithm>
#include <cassert>
#include <ctime>
#include <utility>

namespace penumbra::gl {

void delete_query(GLuint id) { glDeleteQueries(1, &id); }

namespace {

// Processor time of the calling thread.
double cpu_now() {
  constexpr double milliseconds_per_second = 1e3, milliseconds_per_nanosecond = 1e-6;
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * milliseconds_per_second +
         static_cast<double>(now.tv_nsec) * milliseconds_per_nanosecond;
}

}  // namespace

void Timers::begin_frame() {
  if (mode_ == Mode::off) return;
  if (in_frame_) drop_open_frame();
  if (rows_.empty()) rows_.push_back({"frame", {}});
  in_frame_ = true;
  open_work_.clear();
  open_frame_ = start(frame_row);
  cpu_waited_ = 0;
  cpu_started_ = cpu_now();
}

void Timers::begin(std::string_view name) {
  if (!in_frame_ || mode_ == Mode::finish_frames) return;
  const std::string full = stack_.empty() ? std::string(name) : rows_[stack_.back().row].name + "/" + std::string(name);
  stack_.push_back(start(row_index(full)));
}

void Timers::end() {
  if (!in_frame_ || stack_.empty()) return;
  Open open = std::move(stack_.back());
  stack_.pop_back();
  finish(std::move(open));
}

void Timers::end_frame() {
  if (!in_frame_) return;
  assert(stack_.empty());
  cpu_.push_back(cpu_now() - cpu_started_ - cpu_waited_);
  finish(std::move(open_frame_));
  in_frame_ = false;
  work_ = std::exchange(open_work_, {});
  ++frame_;
  collect(/*wait=*/false);
}

Timers::Break::Break(Timers& timers) : timers_(timers), in_frame_(std::exchange(timers.in_frame_, false)) {
  if (!in_frame_) return;
  if (timers_.mode_ != Mode::query) timers_.wait_for_gpu();
  cpu_began_ = cpu_now();
  began_ = Clock::now();
}

Timers::Break::~Break() {
  if (!in_frame_) return;
  timers_.in_frame_ = true;
  if (timers_.mode_ != Mode::query) glFinish();
  const Clock::duration lasted = Clock::now() - began_;
  timers_.open_frame_.started += lasted;
  for (Open& open : timers_.stack_) open.started += lasted;
  timers_.cpu_started_ += cpu_now() - cpu_began_;
}

void Timers::count(const Work& work) {
  if (!in_frame_) return;
  const auto add = [&](std::size_t row) {
    Work& sum = open_work_[rows_[row].name];
    sum.draws += work.draws;
    sum.triangles += work.triangles;
    sum.dispatches += work.dispatches;
  };
  add(frame_row);
  for (const Open& open : stack_) add(open.row);
}

std::vector<Timers::Row> Timers::rows() {
  collect(/*wait=*/true);
  if (rows_.empty()) return {};
  std::vector<Row> result(rows_.begin() + 1, rows_.end());
  result.push_back(rows_[frame_row]);
  for (Row& row : result) row.milliseconds.resize(frame_ - first_kept_, 0.0);
  return result;
}

Timers::Taken Timers::take() {
  collect(/*wait=*/false);
  const std::size_t end = pending_.empty() ? frame_ : pending_.front().frame;
  const auto count = static_cast<std::ptrdiff_t>(end - first_kept_);
  Taken taken{.first = first_kept_, .rows = {}};
  if (count == 0) return taken;
  taken.cpu.assign(cpu_.begin(), cpu_.begin() + count);
  cpu_.erase(cpu_.begin(), cpu_.begin() + count);
  for (Row& row : rows_) {
    if (row.milliseconds.size() < end - first_kept_) row.milliseconds.resize(end - first_kept_, 0.0);
    const auto begin = row.milliseconds.begin();
    taken.rows.push_back({row.name, {begin, begin + count}});
    row.milliseconds.erase(begin, begin + count);
  }
  std::rotate(taken.rows.begin(), taken.rows.begin() + 1, taken.rows.end());
  first_kept_ = end;
  return taken;
}

Timers::Open Timers::start(std::size_t row) {
  Open open;
  open.row = row;
  if (mode_ == Mode::query) {
    open.query = timestamp();
  } else {
    wait_for_gpu();
    open.started = Clock::now();
  }
  return open;
}

void Timers::finish(Open open) {
  if (mode_ == Mode::query) {
    pending_.push_back({open.row, frame_, std::move(open.query), timestamp()});
  } else {
    wait_for_gpu();
    record(open.row, frame_, std::chrono::duration<double, std::milli>(Clock::now() - open.started).count());
  }
}

void Timers::wait_for_gpu() {
  const double before = cpu_now();
  glFinish();
  cpu_waited_ += cpu_now() - before;
}

std::size_t Timers::row_index(const std::string& name) {
  const auto [entry, is_new] = row_indices_.try_emplace(name, rows_.size());
  if (is_new) rows_.push_back({name, {}});
  return entry->second;
}

Handle<delete_query> Timers::timestamp() {
  Handle<delete_query> query;
  if (free_queries_.empty()) {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    query = Handle<delete_query>(id);
  } else {
    query = std::move(free_queries_.back());
    free_queries_.pop_back();
  }
  glQueryCounter(query.id(), GL_TIMESTAMP);
  return query;
}

void Timers::record(std::size_t row, std::size_t frame, double milliseconds) {
  std::vector<double>& times = rows_[row].milliseconds;
  const std::size_t index = frame - first_kept_;
  if (times.size() <= index) times.resize(index + 1, 0.0);
  times[index] += milliseconds;
}

void Timers::drop_open_frame() {
  stack_.clear();
  std::erase_if(pending_, [&](const Pending& pending) { return pending.frame == frame_; });
  for (Row& row : rows_) row.milliseconds.resize(std::min(row.milliseconds.size(), frame_ - first_kept_));
}

void Timers::collect(bool wait) {
  while (!pending_.empty()) {
    Pending& oldest = pending_.front();
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(oldest.end.id(), GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE && !wait) return;
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(oldest.begin.id(), GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(oldest.end.id(), GL_QUERY_RESULT, &end);
    constexpr double milliseconds_per_nanosecond = 1e-6;
    record(oldest.row, oldest.frame, static_cast<double>(end - begin) * milliseconds_per_nanosecond);
    free_queries_.push_back(std::move(oldest.begin));
    free_queries_.push_back(std::move(oldest.end));
    pending_.pop_front();
  }
}

}  // namespace penumbra::gl
