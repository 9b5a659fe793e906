#include "truth/picture_trace.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numeric>
#include <system_error>
#include <thread>

#include "truth/parallel.h"

namespace penumbra::truth {

namespace {

constexpr std::size_t tile_size = 8;  // pixels: small enough that all threads finish at nearly the same time
constexpr double allowed_over = 0.001;
constexpr double agreeing_samples = 2;  // divided by the error: samples that must agree in a pixel beside a penumbra
constexpr double fall_of_error = 0.75;  // the error across an edge falls as samples^-0.75
constexpr std::chrono::milliseconds report_interval(100);

std::uint32_t points_for(int samples) { return static_cast<std::uint32_t>(samples / scrambling_count); }

std::size_t tiles_across(std::size_t pixels) { return (pixels + tile_size - 1) / tile_size; }

struct Estimate {
  float mean = 0, standard_error = 0;
};

Estimate estimate_of(const LitCounts& lit, std::uint32_t points) {
  const double mean = std::accumulate(lit.begin(), lit.end(), 0.0) / (static_cast<double>(points) * scrambling_count);
  double squares = 0;
  for (const std::uint32_t count : lit) squares += std::pow(static_cast<double>(count) / points - mean, 2);
  const double variance = squares / (scrambling_count - 1);
  return {static_cast<float>(mean), static_cast<float>(std::sqrt(variance / scrambling_count))};
}

}  // namespace

PictureTrace::PictureTrace(const EmbreeScene& scene, std::span<const Receiver> receivers, int width,
                           const TracedLight& light, const TraceOptions& options)
    : scene_(scene),
      receivers_(receivers),
      width_(static_cast<std::size_t>(width)),
      height_(width > 0 ? receivers.size() / static_cast<std::size_t>(width) : 0),
      light_(light),
      options_(options),
      threads_(thread_count(options.threads)) {
  assert(width_ * height_ == receivers.size());
  out_.visibility.assign(receivers.size(), 1.0f);
  out_.standard_error.assign(receivers.size(), 0.0f);
  out_.hard.assign(receivers.size(), 1.0f);
  const std::uint32_t first = points_for(first_samples(options));
  for (const Receiver& receiver : receivers) wanted_.push_back(receiver.there ? first : 0);
  points_.resize(receivers.size());
  if (options.error > 0) lit_.resize(receivers.size());
}

void PictureTrace::trace_pixel(std::size_t pixel, PixelRays& rays) {
  const PixelPoints points(options_.seed, static_cast<std::uint32_t>(pixel), options_.scramblings);
  rays.start_at(receivers_[pixel]);
  LitCounts lit{};
  if (!lit_.empty()) lit = lit_[pixel];
  rays.trace(points, points_[pixel], wanted_[pixel], lit);
  const bool estimates = options_.scramblings == Scramblings::eight;
  if (points_[pixel] == 0 && estimates) out_.hard[pixel] = rays.center_lit() ? 1.0f : 0.0f;
  if (!lit_.empty()) lit_[pixel] = lit;
  points_[pixel] = wanted_[pixel];
  const Estimate estimate = estimate_of(lit, points_[pixel]);
  out_.visibility[pixel] = estimate.mean;
  if (estimates) out_.standard_error[pixel] = estimate.standard_error;
}

void PictureTrace::trace_tile(std::size_t tile, PixelRays& rays) {
  const std::size_t left = tile % tiles_across(width_) * tile_size;
  const std::size_t low = tile / tiles_across(width_) * tile_size;
  for (std::size_t y = low; y < std::min(low + tile_size, height_); ++y) {
    for (std::size_t x = left; x < std::min(left + tile_size, width_); ++x) {
      const std::size_t pixel = y * width_ + x;
      if (points_[pixel] < wanted_[pixel]) trace_pixel(pixel, rays);
    }
  }
}

// The estimate of the remaining work may grow; the reported share must not fall.
bool PictureTrace::report(double share) {
  reported_ = std::max(reported_, share);
  return options_.progress(reported_);
}

// The work of one thread in a round.
void PictureTrace::work(const Shares& shares, bool reports) {
  const std::size_t tiles = tiles_across(width_) * tiles_across(height_);
  PixelRays rays(scene_, light_);
  auto reported = std::chrono::steady_clock::now();
  while (!stopped_) {
    const std::size_t tile = next_tile_++;
    if (tile >= tiles) break;
    trace_tile(tile, rays);
    const auto now = std::chrono::steady_clock::now();
    if (!reports || now - reported < report_interval) continue;
    reported = now;
    const double share = static_cast<double>(tile) / static_cast<double>(tiles);
    if (!report(std::lerp(shares.begin, shares.end, share))) stopped_ = true;
  }
  rays_ += rays.traced();
}

void PictureTrace::run_round(const Shares& shares) {
  next_tile_ = 0;
  std::vector<std::jthread> helpers;  // joined at the end
  try {
    for (int i = 1; i < threads_; ++i) helpers.emplace_back([&] { work(shares, false); });
  } catch (const std::system_error&) {
    // The system refuses another thread: the existing ones do the work.
  }
  try {
    work(shares, static_cast<bool>(options_.progress));
  } catch (...) {
    stopped_ = true;
    throw;
  }
}

bool PictureTrace::differs_from_neighbour(std::size_t pixel) const {
  const std::size_t x = pixel % width_;
  const std::size_t y = pixel / width_;
  for (std::size_t ny = y > 0 ? y - 1 : 0; ny < std::min(y + 2, height_); ++ny) {
    for (std::size_t nx = x > 0 ? x - 1 : 0; nx < std::min(x + 2, width_); ++nx) {
      const std::size_t neighbour = ny * width_ + nx;
      if (receivers_[neighbour].there && out_.visibility[neighbour] != out_.visibility[pixel]) return true;
    }
  }
  return false;
}

bool PictureTrace::resolved(std::size_t pixel) const {
  const auto samples = static_cast<double>(points_[pixel]) * scrambling_count;
  if (samples >= max_samples) return true;
  if (out_.standard_error[pixel] > options_.error) return false;
  const bool all_agree = out_.visibility[pixel] == 0 || out_.visibility[pixel] == 1;
  return !all_agree || samples * options_.error >= agreeing_samples || !differs_from_neighbour(pixel);
}

// Marks the pixels that need another round; false if few enough are left to stop.
bool PictureTrace::choose_next() {
  std::size_t there = 0;
  std::size_t open = 0;
  for (std::size_t pixel = 0; pixel < receivers_.size(); ++pixel) {
    if (!receivers_[pixel].there) continue;
    ++there;
    if (resolved(pixel)) continue;
    wanted_[pixel] = std::min(2 * points_[pixel], points_for(max_samples));
    ++open;
  }
  return static_cast<double>(open) > allowed_over * static_cast<double>(there);
}

// Estimates the shares of the next round from the number of samples that each pixel will probably need.
PictureTrace::Shares PictureTrace::shares_of_next() const {
  double done = 0;
  double next = 0;
  double needed = 0;
  for (std::size_t pixel = 0; pixel < receivers_.size(); ++pixel) {
    const double points = points_[pixel];
    const double excess = out_.standard_error[pixel] / options_.error;
    done += points;
    next += wanted_[pixel];
    const double in_the_end = points * std::pow(std::max(excess, 1.0), 1 / fall_of_error);
    needed += std::max<double>(wanted_[pixel], std::min(in_the_end, 1.0 * max_samples / scrambling_count));
  }
  return {done / needed, next / needed};
}

Traced PictureTrace::trace() {
  const auto start = std::chrono::steady_clock::now();
  const bool bounded = options_.error > 0;
  run_round({0, bounded ? 0.25 : 1.0});
  while (bounded && !stopped_ && choose_next()) run_round(shares_of_next());
  if (stopped_ || (options_.progress && !report(1))) throw Interrupted();
  out_.rays = rays_;
  out_.samples = receivers_.empty() ? 0 : static_cast<int>(std::ranges::max(points_)) * scrambling_count;
  out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(out_);
}

}  // namespace penumbra::truth
