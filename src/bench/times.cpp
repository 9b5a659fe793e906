#include "bench/times.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace penumbra::bench {

namespace {

bool is_nested(std::string_view name) { return name.find('/') != std::string_view::npos; }

std::vector<double> sum_of(const PassTimes& times, const std::function<bool(std::string_view)>& counted) {
  std::vector<double> sums(times.frames.size(), 0.0);
  for (const gl::Timers::Row& pass : times.passes) {
    if (is_nested(pass.name) || !counted(pass.name)) continue;
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += pass.milliseconds[i];
  }
  return sums;
}

std::vector<double>& times_of(PassTimes& times, const std::string& name) {
  for (gl::Timers::Row& pass : times.passes) {
    if (pass.name == name) return pass.milliseconds;
  }
  times.passes.push_back({name, {}});
  return times.passes.back().milliseconds;
}

double total(const std::vector<double>& times) { return std::accumulate(times.begin(), times.end(), 0.0); }

}  // namespace

void PassTimes::append(const std::vector<gl::Timers::Row>& rows, const std::vector<double>& cpu_times,
                       std::size_t count) {
  const std::size_t before = frames.size();
  for (const gl::Timers::Row& row : rows) {
    const auto tail = row.milliseconds.end() - static_cast<std::ptrdiff_t>(std::min(count, row.milliseconds.size()));
    if (std::all_of(tail, row.milliseconds.end(), [](double ms) { return ms == 0; })) continue;
    std::vector<double>& times = row.name == "frame" ? frames : times_of(*this, row.name);
    times.resize(before);
    times.insert(times.end(), tail, row.milliseconds.end());
  }
  for (gl::Timers::Row& pass : passes) pass.milliseconds.resize(frames.size());
  cpu.insert(cpu.end(), cpu_times.end() - static_cast<std::ptrdiff_t>(std::min(count, cpu_times.size())),
             cpu_times.end());
}

PassTimes PassTimes::of_frames(const std::vector<gl::Timers::Row>& rows, std::span<const std::size_t> indices) {
  PassTimes times;
  for (const gl::Timers::Row& row : rows) {
    std::vector<double>& picked = row.name == "frame" ? times.frames : times_of(times, row.name);
    for (const std::size_t index : indices) picked.push_back(row.milliseconds[index]);
  }
  return times;
}

std::vector<double> PassTimes::of(std::string_view pass) const {
  for (const gl::Timers::Row& row : passes) {
    if (row.name == pass) return row.milliseconds;
  }
  return std::vector<double>(frames.size(), 0.0);
}

std::vector<double> PassTimes::shadow_sums() const { return sum_of(*this, is_shadow_pass); }

std::vector<double> PassTimes::sums() const {
  return sum_of(*this, [](std::string_view) { return true; });
}

bool is_shadow_pass(std::string_view name) {
  constexpr std::array own{"deform", "depth", "gbuffer", "lighting", "sky", "blended", "exposure", "tone map"};
  return std::find(own.begin(), own.end(), name.substr(0, name.find('/'))) == own.end();
}

double Cost::per_frame(const PassCost& pass) const {
  return frame.count > 0 ? pass.ms.median * static_cast<double>(pass.ms.count) / static_cast<double>(frame.count) : 0;
}

Cost cost_of(const PassTimes& times, const PassTimes& first) {
  const std::vector<double> shadow = times.shadow_sums(), sums = times.sums();
  const double all_frames = total(times.frames);
  Cost cost;
  cost.frame = summary_of(times.frames);
  cost.cpu = summary_of(times.cpu);
  cost.passes_sum = summary_of(sums);
  cost.sum_ratio = paired_ratio(sums, times.frames);
  cost.shadow = summary_of(shadow);
  cost.of_first = paired_ratio(shadow, first.shadow_sums());
  for (const gl::Timers::Row& pass : times.passes) {
    std::vector<double> drawn = pass.milliseconds;
    std::erase(drawn, 0.0);
    cost.passes.push_back({.name = pass.name,
                           .ms = summary_of(std::move(drawn)),
                           .share = all_frames > 0 ? total(pass.milliseconds) / all_frames : 0,
                           .shadow = is_shadow_pass(pass.name)});
  }
  if (!cost.has_passes()) cost.of_first = paired_ratio(times.frames, first.frames);
  return cost;
}

}  // namespace penumbra::bench
