#include "metrics/sequence.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace penumbra::metrics {

namespace {

constexpr float in_shadow = 0.5f, lit = 0.98f;
constexpr float least_change = 1.0f / 255;
constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

double mean(double sum, std::size_t count) { return count == 0 ? not_told : sum / static_cast<double>(count); }

// `errors` starts at the event's frame.
Recovery recovery_of(std::size_t frame, Event event, std::span<const double> errors) {
  Recovery recovery{frame, event, {}, not_told};
  constexpr std::size_t at_rest = SequenceMetrics::memory_frames;
  if (errors.size() < 2 * at_rest) return recovery;
  const auto last = errors.last(at_rest);
  recovery.static_error = std::accumulate(last.begin(), last.end(), 0.0) / static_cast<double>(at_rest);
  recovery.frames = recovery_frames(errors, recovery.static_error);
  return recovery;
}

}  // namespace

std::optional<std::size_t> recovery_frames(std::span<const double> errors, double static_error, double tolerance) {
  std::size_t frames = errors.size();
  while (frames > 0 && errors[frames - 1] <= static_error + tolerance) --frames;
  if (frames == errors.size()) return {};
  return frames;
}

void SequenceMetrics::check_frame(const ImageView& test, const ImageView& reference, Receivers receivers) {
  check(test, reference, receivers);
  if (reference.channels != 1) fail("a sequence is measured in 1 channel, not {}", reference.channels);
  if (sums_.frames > 0 && (reference.width != width_ || reference.height != height_))
    fail("the sequence changes its size from {} x {} to {} x {} pixels", width_, height_, reference.width,
         reference.height);
  width_ = reference.width;
  height_ = reference.height;
  pixels_.resize(reference.pixel_count());
}

void SequenceMetrics::end_segment() {
  if (segment_.event == Event::cut || segment_.event == Event::stop)
    sums_.recoveries.push_back(recovery_of(segment_.frame, segment_.event, segment_.errors));
  segment_ = {};
}

void SequenceMetrics::begin(Event event) {
  region_sum_ = 0;
  region_count_ = 0;
  if (event == Event::none) return;
  end_segment();
  segment_ = {sums_.frames, event, {}};
  if (event != Event::cut) return;
  has_last_ = false;
  for (Pixel& pixel : pixels_) pixel.since_shadow = pixel.since_change = never;
}

// `pixel` holds the present frame already, except its error, which this sets.
void SequenceMetrics::add_receiver(const Pixel& last, Pixel& pixel, float test) {
  pixel.error = signed_error(test, pixel.reference);
  const double error = std::abs(pixel.error);
  if (!std::isfinite(test)) ++sums_.not_finite;
  if (has_last_ && last.receiver) {
    sums_.flicker += std::abs(static_cast<double>(pixel.error) - last.error);
    ++sums_.flicker_pixels;
  }
  if (pixel.reference > lit && pixel.since_shadow <= memory_frames) {
    sums_.ghost += error;
    ++sums_.ghost_pixels;
  }
  if (pixel.region) {
    region_sum_ += error;
    ++region_count_;
  }
}

void SequenceMetrics::add(const ImageView& test, const ImageView& reference, Receivers receivers, Event event) {
  check_frame(test, reference, receivers);
  begin(event);
  const auto older = [](std::uint8_t age) { return age == never ? never : static_cast<std::uint8_t>(age + 1); };
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel last = pixels_[i];
    Pixel& pixel = pixels_[i];
    pixel.receiver = is_receiver(receivers, i);
    pixel.reference = pixel.receiver ? reference.pixels[i] : 0.0f;
    const bool changed = pixel.receiver != last.receiver || std::abs(pixel.reference - last.reference) > least_change;
    pixel.since_change = has_last_ && changed ? 0 : older(last.since_change);
    pixel.since_shadow = pixel.receiver && pixel.reference < in_shadow ? 0 : older(last.since_shadow);
    if (event == Event::cut) pixel.region = true;
    if (event == Event::stop) pixel.region = pixel.since_change < memory_frames;
    if (pixel.receiver) add_receiver(last, pixel, test.pixels[i]);
  }
  if (segment_.event == Event::cut || segment_.event == Event::stop)
    segment_.errors.push_back(mean(region_sum_, region_count_));
  has_last_ = true;
  ++sums_.frames;
}

SequenceFigures SequenceMetrics::figures() const {
  SequenceFigures figures = sums_;
  figures.flicker = mean(sums_.flicker, sums_.flicker_pixels);
  figures.ghost = mean(sums_.ghost, sums_.ghost_pixels);
  if (segment_.event == Event::cut || segment_.event == Event::stop)
    figures.recoveries.push_back(recovery_of(segment_.frame, segment_.event, segment_.errors));
  return figures;
}

}  // namespace penumbra::metrics
