#include "scene/animation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace penumbra::scene {
namespace {

glm::quat quaternion(const float* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

void store_unit(std::vector<float>& value) {
  const glm::dvec4 v(value[0], value[1], value[2], value[3]);
  const double length = glm::length(v);
  const glm::dvec4 unit = length > 0 && std::isfinite(length) ? v / length : glm::dvec4(0, 0, 0, 1);
  for (int c = 0; c < 4; ++c) value[static_cast<std::size_t>(c)] = static_cast<float>(unit[c]);
}

// Interpolates between `key` and the next; s from 0 to 1. Equal values stay exact, without rounding, because a still
// object must not count as moving.
std::vector<float> linear(const AnimationChannel& channel, std::size_t key, float s) {
  const auto width = static_cast<std::size_t>(channel.components);
  const float* const a = &channel.values[key * width];
  const float* const b = a + width;
  std::vector<float> value(width);
  if (channel.path == Path::rotation) {
    std::vector<float> from(a, a + 4), to(b, b + 4);
    store_unit(from);
    store_unit(to);
    if (from == to) return from;
    const glm::quat q = glm::slerp(quaternion(from.data()), quaternion(to.data()), s);
    return {q.x, q.y, q.z, q.w};
  }
  for (std::size_t c = 0; c < width; ++c) value[c] = a[c] + (b[c] - a[c]) * s;
  return value;
}

std::vector<float> cubic(const AnimationChannel& channel, std::size_t key, float s) {
  const auto width = static_cast<std::size_t>(channel.components);
  const float duration = channel.times[key + 1] - channel.times[key];
  const float* const a = &channel.values[key * 3 * width];  // in-tangent, value, out-tangent
  const float* const b = a + 3 * width;
  const float s2 = s * s, s3 = s2 * s;
  std::vector<float> value(width);
  for (std::size_t c = 0; c < width; ++c)
    value[c] = a[width + c] + (3 * s2 - 2 * s3) * (b[width + c] - a[width + c]) +
               (s3 - 2 * s2 + s) * duration * a[2 * width + c] + (s3 - s2) * duration * b[c];
  return value;
}

std::vector<float> key_value(const AnimationChannel& channel, std::size_t key) {
  const auto width = static_cast<std::size_t>(channel.components);
  const bool tangents = channel.interpolation == Interpolation::cubic_spline;
  const float* const at = &channel.values[tangents ? (key * 3 + 1) * width : key * width];
  return {at, at + width};
}

}  // namespace

double looped_time(double seconds, double duration) {
  if (!(duration > 0) || !std::isfinite(seconds)) return 0;
  const double time = std::fmod(seconds, duration);
  if (time < 0) return time + duration;
  return time == 0 && seconds > 0 ? duration : time;
}

std::vector<float> sample(const AnimationChannel& channel, double time) {
  const auto& times = channel.times;
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  std::vector<float> value;
  if (next == times.begin()) {
    value = key_value(channel, 0);
  } else if (next == times.end() || channel.interpolation == Interpolation::step) {
    value = key_value(channel, static_cast<std::size_t>(next - times.begin()) - 1);
  } else {
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    const auto s = static_cast<float>((time - times[key]) / (static_cast<double>(times[key + 1]) - times[key]));
    value = channel.interpolation == Interpolation::linear ? linear(channel, key, s) : cubic(channel, key, s);
  }
  if (channel.path == Path::rotation) store_unit(value);
  return value;
}

namespace {

// What the channel comes to at the end of an animation. Of several last keys of one time it comes to the first.
std::vector<float> end_of(const AnimationChannel& channel, double duration) {
  const auto& times = channel.times;
  const auto first = std::lower_bound(times.begin(), times.end(), times.back());
  if (channel.interpolation == Interpolation::step || times.back() < duration) return sample(channel, duration);
  std::vector<float> value = key_value(channel, static_cast<std::size_t>(first - times.begin()));
  if (channel.path == Path::rotation) store_unit(value);
  return value;
}

// Whether the channel ends with the values that it starts with, up to rounding: 0.01 % of its largest value, 0.2
// degrees.
bool closes(const AnimationChannel& channel, double duration) {
  const std::vector<float> a = sample(channel, 0), b = end_of(channel, duration);
  if (channel.path == Path::rotation) return std::abs(glm::dot(quaternion(a.data()), quaternion(b.data()))) > 1 - 1e-6f;
  float largest = 0;
  for (const float v : channel.values) largest = std::max(largest, std::abs(v));
  return std::equal(a.begin(), a.end(), b.begin(),
                    [&](float x, float y) { return std::abs(x - y) <= 1e-4f * largest; });
}

// The number of the loop that an animation is in at `seconds`, counted from 0.
double loop_at(double seconds, double duration) {
  return std::round((seconds - looped_time(seconds, duration)) / duration);
}

}  // namespace

bool jumps_between(const Scene& scene, double first, double second) {
  const std::vector<std::size_t> played = played_animations(scene);
  return std::any_of(played.begin(), played.end(), [&](std::size_t i) {
    const Animation& animation = scene.animations[i];
    if (!(animation.duration > 0)) return false;
    if (loop_at(first, animation.duration) == loop_at(second, animation.duration)) return false;
    return std::any_of(animation.channels.begin(), animation.channels.end(),
                       [&](const AnimationChannel& channel) { return !closes(channel, animation.duration); });
  });
}

std::vector<std::size_t> played_animations(const Scene& scene) {
  std::set<std::pair<int, Path>> driven;
  std::vector<std::size_t> played;
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const auto& channels = scene.animations[i].channels;
    const bool free = std::none_of(channels.begin(), channels.end(), [&](const AnimationChannel& channel) {
      return driven.contains({channel.node, channel.path});
    });
    if (!free) continue;
    for (const AnimationChannel& channel : channels) driven.insert({channel.node, channel.path});
    played.push_back(i);
  }
  return played;
}

}  // namespace penumbra::scene
