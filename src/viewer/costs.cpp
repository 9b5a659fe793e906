#include "viewer/costs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace penumbra::viewer {

namespace {

constexpr double window = 1.0;  // seconds
constexpr const char* frame_name = "frame";

}  // namespace

void Costs::add(double now, std::map<std::string, double> passes) {
  history_.push_back(static_cast<float>(passes[frame_name]));
  if (history_.size() > most_history) history_.erase(history_.begin());
  frames_.push_back({now, std::move(passes)});
  while (frames_.size() > 1 && frames_.front().at < now - window) frames_.pop_front();
}

void Costs::clear() { frames_.clear(); }

gl::Timers::Work Costs::work(const std::string& pass) const {
  const auto found = work_.find(pass);
  return found == work_.end() ? gl::Timers::Work{} : found->second;
}

double Costs::median_of(const std::string& name) const {
  std::vector<double> times;
  for (const Frame& frame : frames_) {
    const auto found = frame.passes.find(name);
    times.push_back(found == frame.passes.end() ? 0.0 : found->second);
  }
  if (times.empty()) return 0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

std::vector<Costs::Pass> Costs::passes() const {
  std::vector<Pass> passes;
  if (frames_.empty()) return passes;
  for (const auto& [name, ms] : frames_.back().passes) {
    if (name != frame_name && name.find('/') == std::string::npos) passes.push_back({name, median_of(name)});
  }
  std::stable_sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) { return a.median > b.median; });
  return passes;
}

double Costs::frame() const { return median_of(frame_name); }

void CostReader::start(const gl::Timers& timers, Costs& costs) { from_[timers.next_frame()] = &costs; }

void CostReader::read(gl::Timers& timers, double now) {
  const gl::Timers::Taken taken = timers.take();
  if (taken.rows.empty()) return;
  const std::size_t count = taken.rows.front().milliseconds.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto after = from_.upper_bound(taken.first + i);
    if (after == from_.begin()) continue;
    std::map<std::string, double> passes;
    for (const gl::Timers::Row& row : taken.rows) {
      if (row.milliseconds[i] > 0) passes[row.name] = row.milliseconds[i];
    }
    std::prev(after)->second->add(now, std::move(passes));
  }
  // Of the starts before the next frame only the last one is still needed.
  const auto last = from_.upper_bound(taken.first + count);
  if (last != from_.begin()) from_.erase(from_.begin(), std::prev(last));
}

}  // namespace penumbra::viewer
