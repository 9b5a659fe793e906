#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metrics/image_view.h"

namespace penumbra::metrics {

// What happens at a frame, before it is drawn. Cut: camera or scene differ from the last frame, so the two are not
// compared. Stop: the first frame after which nothing moves any more. Start: something moves again.
enum class Event : std::uint8_t { none, cut, stop, start };

// How a technique converges after a cut or a stop.
struct Recovery {
  std::size_t frame = 0;              // of the event, counted from the first that was added
  Event event = Event::cut;           // cut or stop
  std::optional<std::size_t> frames;  // frames until it has converged: 0 if the event's frame has; absent if unknown
  double static_error = 0;            // mean |e| of the region after convergence; NaN if unknown
};

// Figures over all frames so far; NaN where nothing was measured.
struct SequenceFigures {
  std::size_t frames = 0;
  std::size_t not_finite = 0;      // test values that were NaN or infinite; each counts as |e| = 1
  double flicker = 0;              // mean |e_t − e_(t−1)|
  std::size_t flicker_pixels = 0;  // in that mean, of all pairs of frames
  double ghost = 0;                // mean |e| where there was a shadow and no longer is
  std::size_t ghost_pixels = 0;    // in that mean, of all frames
  std::vector<Recovery> recoveries;
};

// How many frames after the first until the error falls to at most `static_error` + `tolerance` and stays there.
// Nothing if the last error is still larger.
std::optional<std::size_t> recovery_frames(std::span<const double> errors, double static_error,
                                           double tolerance = 1.0 / 255);

// Measures errors over time, frame by frame, of visibility (one channel), with e = test − reference. Pixels are
// compared with the same pixel of the last frames, whatever surface moved there: under a moving camera the figures
// describe what a viewer sees on the screen.
//
// Flicker: mean |e_t − e_(t−1)| over the pixels that are receivers in both frames, except across a cut. Changes that
// the reference shows too don't count, nor do constant errors.
// Ghost: mean |e| over the receivers that are lit now (reference above 0.98) and were receivers in shadow (below 0.5)
// in any of the last 8 frames, those before a cut excluded. It includes the technique's usual error in lit pixels.
// Recovery: the frames after a stop or a cut until the region's mean |e| is, and stays, at most 1/255 above its static
// error. The region of a cut is all receivers; that of a stop is where the reference changed by more than 1/255 in the
// 8 frames before it, the frame of the stop included. The static error is measured over the last 8 frames before the
// next event or the end, so there must be at least 16 frames from the event's own on, and enough for the technique to
// converge.
//
// Memory: 12 bytes per pixel and 8 bytes per frame, whatever the length of the sequence. Results are deterministic.
class SequenceMetrics {
 public:
  static constexpr std::size_t memory_frames = 8;

  // Throws Error as check() does, for more than one channel, and for a size other than the first frame's.
  void add(const ImageView& test, const ImageView& reference, Receivers receivers = {}, Event event = Event::none);

  SequenceFigures figures() const;

 private:
  struct Pixel {
    float error = 0, reference = 0;
    std::uint8_t since_shadow = never, since_change = never;  // frames ago
    bool receiver = false, region = false;
  };
  static constexpr std::uint8_t never = 255;

  struct Segment {
    std::size_t frame = 0;
    Event event = Event::none;
    std::vector<double> errors;  // mean |e| of the region, one value per frame
  };

  void check_frame(const ImageView& test, const ImageView& reference, Receivers receivers);
  void begin(Event event);
  void end_segment();
  void add_receiver(const Pixel& last, Pixel& pixel, float test);

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
  bool has_last_ = false;
  SequenceFigures sums_;  // flicker and ghost are sums here, not means
  Segment segment_;
  double region_sum_ = 0;  // of the present frame
  std::size_t region_count_ = 0;
};

}  // namespace penumbra::metrics
