#include "visible_cascades.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "receiver_region.h"

namespace penumbra::shadow {

namespace {

LightBounds joined(const LightBounds& a, const LightBounds& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

// The receivers up to the end of each slice.
VisibleReceivers accumulated(VisibleReceivers slices) {
  for (size_t i = 1; i < slices.size(); ++i) {
    ReceiverSlice& slice = slices[i];
    const ReceiverSlice& before = slices[i - 1];
    slice.pixels += before.pixels;
    slice.depths = {std::min(slice.depths.x, before.depths.x), std::max(slice.depths.y, before.depths.y)};
    for (size_t k = 0; k < slice.extents.size(); ++k) {
      const glm::dvec2 &a = slice.extents[k], &b = before.extents[k];
      slice.extents[k] = {std::min(a.x, b.x), std::max(a.y, b.y)};
    }
  }
  return slices;
}

// Half the width and height of a cascade about receivers. A texel is at most so many times as long as it is wide: what
// reads maps takes the larger of both where it can't tell them apart.
glm::dvec2 half_width_of(const LightBounds& bounds) {
  constexpr double most = 4;
  const glm::dvec2 half = 0.5 * (glm::dvec2(bounds.high) - glm::dvec2(bounds.low));
  return glm::max(half, std::max(glm::max(half.x, half.y) / most, 1e-9));
}

// The side of each of so many maps that have the texels of `count` maps of `size`: a multiple of 16, but not below
// `size`.
int side_of(const CascadeInputs& in, size_t maps) {
  constexpr int block = 16;
  const double side = in.size * std::sqrt(in.count / static_cast<double>(maps));
  const int whole = static_cast<int>(side + 1e-9) / block * block;
  return std::clamp(whole, in.size, std::max(in.size, max_cascade_size));
}

// The x axis of the cascades' light space, a measured direction, the last slice of each cascade, and their texels along
// a side.
struct VisibleFit {
  double length = 1e30;  // mean over the pixels of the logarithm of their texels' longer sides
  int x_axis = 0;
  std::vector<size_t> ends;
  int side = 0;
};

// Along an axis, so that the longer sides of the texels of the pixels' cascades, in units of the pixels' own sizes,
// have the least geometric mean. `up_to`: see accumulated(). `others`: what the last cascade holds besides, in the
// light space with that axis.
VisibleFit best_splits(const VisibleReceivers& up_to, const LightBounds& others, const CascadeInputs& in, int x_axis) {
  // Of the longer sides of a cascade that ends at each slice: they decide how wide most edges appear.
  std::vector<double> logarithms;
  for (const ReceiverSlice& slice : up_to) {
    const LightBounds bounds = slice.bounds(x_axis);
    const glm::dvec2 half = half_width_of(&slice == &up_to.back() ? joined(bounds, others) : bounds);
    logarithms.push_back(std::log2(glm::max(half.x, half.y)));
  }
  // The sum over the pixels up to a slice of the logarithm of their cascades' sides, with the best cascades of which
  // the last one ends there, and where the one before it ends. Each ends behind the one before it.
  struct Best {
    double sum = 1e30;
    size_t before = 0;
  };
  const size_t most = std::min(static_cast<size_t>(in.count), up_to.size());
  std::vector<std::vector<Best>> best(most, std::vector<Best>(up_to.size()));
  for (size_t last = 0; last < up_to.size(); ++last) best[0][last] = {logarithms[last] * up_to[last].pixels, 0};
  for (size_t cascade = 1; cascade < most; ++cascade) {
    for (size_t last = cascade; last < up_to.size(); ++last) {
      for (size_t before = cascade - 1; before < last; ++before) {
        const double sum =
            best[cascade - 1][before].sum + logarithms[last] * (up_to[last].pixels - up_to[before].pixels);
        if (sum < best[cascade][last].sum) best[cascade][last] = {sum, before};
      }
    }
  }
  // With fewer cascades each has more texels. Where there may be two, a single one is not chosen: nearest surfaces lose
  // by more than the mean.
  const size_t fewest = in.divides_texels ? std::min<size_t>(2, most) : most;
  VisibleFit fit;
  for (size_t maps = fewest; maps <= most; ++maps) {
    const int side = in.divides_texels ? side_of(in, maps) : in.size;
    const double length = best[maps - 1].back().sum / up_to.back().pixels - std::log2(side);
    if (fit.ends.empty() || length < fit.length)
      fit = {length, x_axis, std::vector<size_t>(maps, up_to.size() - 1), side};
  }
  for (size_t cascade = fit.ends.size() - 1; cascade > 0; --cascade) {
    fit.ends[cascade - 1] = best[cascade][fit.ends[cascade]].before;
  }
  return fit;
}

// What cascades hold that end at each slice. Behind the slices that a penumbra may reach, one more adds no pixels, but
// holds all that the view shows: the last cascade ends there.
VisibleReceivers held_up_to(const CascadeInputs& in) {
  VisibleReceivers all = accumulated(*in.visible);
  if (!in.near_penumbrae || in.count < 2) return all;
  VisibleReceivers fine = accumulated(*in.near_penumbrae);
  ReceiverSlice last = all.back();
  last.pixels = fine.back().pixels;
  fine.push_back(last);
  return fine;
}

double turn_of(int x_axis) { return x_axis * (glm::pi<double>() / measured_directions); }

VisibleFit best_fit(const VisibleReceivers& up_to, const glm::dvec3& anchor, const CascadeInputs& in) {
  const auto fit_along = [&](int x_axis) {
    Cascades space;
    space.world_to_light = light_axes(in.to_light, turn_of(x_axis));
    space.anchor = anchor;
    return best_splits(up_to, seen_bounds(in.others, in, space), in, x_axis);
  };
  VisibleFit best = fit_along(0);
  for (int x_axis = 1; in.may_turn && x_axis < measured_directions / 2; ++x_axis) {
    VisibleFit fit = fit_along(x_axis);
    if (fit.length < best.length) best = std::move(fit);
  }
  return best;
}

}  // namespace

std::vector<Region> visible_regions(const CascadeInputs& in, Cascades& cascades) {
  // Receivers are computed from the same depths on the GPU, in floats.
  constexpr double rounding = 1e-4;
  const VisibleReceivers up_to = held_up_to(in);
  const VisibleFit fit = best_fit(up_to, cascades.anchor, in);
  cascades.turn = turn_of(fit.x_axis);
  cascades.world_to_light = light_axes(in.to_light, cascades.turn);
  cascades.size = fit.side;
  std::vector<Region> regions;
  for (const size_t end : fit.ends) {
    LightBounds bounds = up_to[end].bounds(fit.x_axis);
    const bool last = regions.size() + 1 == fit.ends.size();
    if (last) bounds = joined(bounds, seen_bounds(in.others, in, cascades));
    const glm::dvec3 center = 0.5 * (bounds.low + bounds.high), half = 0.5 * (bounds.high - bounds.low);
    const double pad = rounding * (glm::length(center) + glm::length(half));
    regions.push_back({center, half_width_of(bounds) + pad, bounds.low.z - pad, bounds.high.z + pad});
  }
  return regions;
}

LightBounds ReceiverSlice::bounds(int x_axis) const {
  const auto x = static_cast<size_t>(x_axis);
  const glm::dvec2 &along_x = extents.at(x), &along_y = extents.at(x + measured_directions / 2);
  return {{along_x.x, along_y.x, depths.x}, {along_x.y, along_y.y, depths.y}};
}

}  // namespace penumbra::shadow
