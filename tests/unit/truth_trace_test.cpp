// Tracing a picture: sampling, threads, error bounds, progress.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/random.h"
#include "truth/sampling.h"
#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using truth::PacketPoints;
using truth::PicturePoints;
using truth::PixelPoints;
using truth::Receiver;
using truth::Traced;
using truth::TracedSun;
using truth::TraceOptions;

// The first points of one scrambling of a pixel.
std::vector<glm::dvec2> points_of(const PixelPoints& pixel, std::size_t scrambling, std::uint32_t count) {
  std::vector<glm::dvec2> points;
  PacketPoints packet;
  for (std::uint32_t index = 0; index < count; ++index) {
    pixel.square(index, packet);
    points.emplace_back(packet.x[scrambling], packet.y[scrambling]);
  }
  return points;
}

TEST(TruthSampling, EveryElementaryIntervalHasOnePoint) {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    const PixelPoints points(7, pixel);
    for (std::size_t scrambling = 0; scrambling < truth::scrambling_count; ++scrambling) {
      for (int power = 1; power <= 10; ++power) {
        const auto net = points_of(points, scrambling, 1U << power);
        for (int columns = 0; columns <= power; ++columns) {
          std::set<std::pair<int, int>> cells;
          for (const glm::dvec2& p : net) {
            cells.emplace(static_cast<int>(p.x * (1 << columns)), static_cast<int>(p.y * (1 << (power - columns))));
          }
          ASSERT_EQ(cells.size(), net.size()) << pixel << " " << scrambling << " " << power << " " << columns;
        }
      }
    }
  }
}

// So do the points of a single scrambling, which come eight at a time and are those of the first of eight.
TEST(TruthSampling, OneScramblingComesInOrder) {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    const PixelPoints one(7, pixel, truth::Scramblings::one);
    std::vector<glm::dvec2> points;
    PacketPoints packet;
    for (std::uint32_t index = 0; index < 8; ++index) {
      one.square(index, packet);
      for (std::size_t i = 0; i < truth::packet_width; ++i) points.emplace_back(packet.x[i], packet.y[i]);
    }
    EXPECT_EQ(points, points_of(PixelPoints(7, pixel), 0, 64));
  }
}

// Over pixels, scramblings and seeds, each point is uniformly distributed, and any two are independent.
// Of the points of a pixel, of a block of 2 × 2 pixels and of a block of 4 × 4, one is in each of as many equal
// columns, and one in each of as many equal rows.
TEST(TruthTrace, PointsOfBlocksOfPixelsCoverTheLightEvenly) {
  constexpr std::uint32_t count = 16;
  const PicturePoints points(3, count);
  for (const std::uint32_t side : {1u, 2u, 4u}) {
    std::vector<std::uint32_t> columns(side * side * count), rows(columns.size());
    for (std::uint32_t pixel = 0; pixel < side * side; ++pixel) {
      const std::uint32_t first = points.first(8 + pixel % side, 12 + pixel / side);
      for (std::uint32_t i = 0; i < count; i += 8) {
        truth::PacketPoints packet;
        points.square({first + i, first + i + 1, first + i + 2, first + i + 3, first + i + 4, first + i + 5,
                       first + i + 6, first + i + 7},
                      packet);
        for (std::size_t lane = 0; lane < 8; ++lane) {
          ++columns[static_cast<std::size_t>(packet.x[lane] * static_cast<float>(columns.size()))];
          ++rows[static_cast<std::size_t>(packet.y[lane] * static_cast<float>(rows.size()))];
        }
      }
    }
    EXPECT_EQ(columns, std::vector<std::uint32_t>(columns.size(), 1)) << side;
    EXPECT_EQ(rows, std::vector<std::uint32_t>(rows.size(), 1)) << side;
  }
}

// Of sets of 4096 points there are only as many as 1024 × 1024 pixels take.
TEST(TruthTrace, PointsThatAreTakenAgainAreNotThoseOfPixelsAsFarAway) {
  const PicturePoints points(3, 4096), fewer(3, 1024);
  std::set<std::uint32_t> taken;
  for (std::uint32_t y = 0; y < 720; y += 16) {
    for (std::uint32_t x = 0; x < 256; x += 16) {
      const std::uint32_t beyond = points.first(x + 1024, y);
      EXPECT_NE(beyond, points.first(x, y)) << x << ", " << y;
      EXPECT_EQ(points.first(x, y), 4 * fewer.first(x, y)) << "pixels within keep theirs";
      EXPECT_EQ(beyond % (4 * 4096), 0U) << "groups of 2 × 2 pixels stay together";
      EXPECT_TRUE(taken.insert(beyond).second);
      EXPECT_EQ(points.first(x + 1025, y), beyond + 4096);
      EXPECT_EQ(points.first(x + 1024, y + 1), beyond + 2 * 4096);
    }
  }
  EXPECT_NE(points.first(1024, 0), points.first(2048, 0));
  EXPECT_EQ(PicturePoints(3, 24).first(16383, 1), 24U * 0x5555557U) << "a count that is no power of two";
}

TEST(TruthSampling, ScramblingsAreIndependent) {
  const auto correlation = [](auto first, auto second) {
    double sum = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 a = first(static_cast<std::uint32_t>(i)) - glm::dvec2(0.5);
      const glm::dvec2 b = second(static_cast<std::uint32_t>(i)) - glm::dvec2(0.5);
      sum += glm::dot(a, b);
    }
    return 12 * sum / (2 * count);
  };
  const auto point = [](std::uint32_t seed, std::uint32_t pixel, std::size_t scrambling) {
    return points_of(PixelPoints(seed, pixel), scrambling, 1)[0];
  };
  const double limit = 4 / std::sqrt(2 * 20000.0);
  EXPECT_LT(std::abs(correlation([&](auto i) { return point(1, i, 0); }, [&](auto i) { return point(1, i + 1, 0); })),
            limit);
  EXPECT_LT(std::abs(correlation([&](auto i) { return point(1, i, 0); }, [&](auto i) { return point(1, i, 1); })),
            limit);
  EXPECT_LT(std::abs(correlation([&](auto i) { return point(1, i, 3); }, [&](auto i) { return point(2, i, 3); })),
            limit);
}

TEST(TruthSampling, DiscIsFilledEvenly) {
  std::vector<int> counts(64);  // 8 rings of equal area by 8 sectors
  PacketPoints packet;
  for (std::uint32_t pixel = 0; pixel < 400; ++pixel) {
    const PixelPoints points(3, pixel);
    for (std::uint32_t index = 0; index < 16; ++index) {
      points.square(index, packet);
      truth::square_to_disc(packet);
      for (std::size_t lane = 0; lane < truth::packet_width; ++lane) {
        const double x = packet.x[lane], y = packet.y[lane];
        ASSERT_LE(x * x + y * y, 1.0 + 1e-6);
        const int ring = std::min(7, static_cast<int>(8 * (x * x + y * y)));
        const int sector = std::clamp(static_cast<int>((std::atan2(y, x) + pi) / (2 * pi) * 8), 0, 7);
        ++counts[static_cast<std::size_t>(8 * ring + sector)];
      }
    }
  }
  for (const int count : counts) EXPECT_NEAR(count, 800, 60);
}

// A view of the ground under some boxes.
struct GroundView {
  TruthScene scene;
  std::vector<Receiver> receivers;
  int width = 90;
};

GroundView boxes() {
  GroundView picture;
  Random random(5);
  const auto within = [&](double low, double high) { return static_cast<float>(low + (high - low) * random.real()); };
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 low(within(-5, 5), within(0.2, 3), within(-5, 5));
    picture.scene.add_box(low, low + glm::vec3(within(0.1, 1), within(0.1, 1), within(0.1, 1)));
  }
  for (int y = 0; y < 67; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      picture.receivers.push_back(receiver_at({x * 0.1 - 4.5, 0, y * 0.1 - 3.35}, {0, 1, 0}));
      picture.receivers.back().there = (x + y) % 7 != 0;
    }
  }
  return picture;
}

const TracedSun wide_sun{.to_light = {0.3, 1, 0.2}, .angle = 0.15};

TEST(TruthTrace, IsTheSameOnAnyNumberOfThreads) {
  const GroundView picture = boxes();
  const truth::Tracer tracer = picture.scene.tracer();
  for (const double error : {0.0, 0.01}) {
    const auto traced = [&](int threads) {
      return tracer.trace(picture.receivers, picture.width, wide_sun,
                          {.samples = 88, .error = error, .seed = 9, .threads = threads});
    };
    const Traced one = traced(1);
    for (const int threads : {2, 5}) {
      const Traced more = traced(threads);
      EXPECT_EQ(one.visibility, more.visibility);
      EXPECT_EQ(one.standard_error, more.standard_error);
      EXPECT_EQ(one.hard, more.hard);
      EXPECT_EQ(one.rays, more.rays);
    }
    EXPECT_EQ(picture.scene.tracer()
                  .trace(picture.receivers, picture.width, wide_sun, {.samples = 88, .error = error, .seed = 9})
                  .visibility,
              one.visibility);
  }
}

// Every thread runs the callback that decides whether a hit counts.
TEST(TruthTrace, IsTheSameOnAnyNumberOfThreadsWhereOneFaceCasts) {
  TruthScene scene;
  scene.add_quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}).faces = scene::CasterFaces::front;
  scene.add_quad({0, 2, -1}, {0, 0, 2}, {2, 0, 0}).faces = scene::CasterFaces::front;
  const truth::Tracer tracer = scene.tracer();
  const std::vector<Receiver> receivers = ground_row(-2, 3, 400);
  const auto traced = [&](int threads) {
    return tracer.trace(receivers, 20, wide_sun, {.samples = 88, .threads = threads}).visibility;
  };
  const std::vector<float> one = traced(1);
  EXPECT_EQ(one, traced(4));
  EXPECT_GT(std::ranges::count(one, 1.0f), 20);
  EXPECT_GT(std::ranges::count(one, 0.0f), 20) << "one of the squares shows its front";
}

TEST(TruthTrace, SeedsAndPixelsDiffer) {
  const GroundView picture = boxes();
  const truth::Tracer tracer = picture.scene.tracer();
  const Traced one = tracer.trace(picture.receivers, picture.width, wide_sun, {.samples = 16, .seed = 1});
  const Traced two = tracer.trace(picture.receivers, picture.width, wide_sun, {.samples = 16, .seed = 2});
  EXPECT_NE(one.visibility, two.visibility);
  EXPECT_EQ(one.hard, two.hard);
}

TEST(TruthTrace, RoundsSamplesUpAndCountsRays) {
  TruthScene scene;
  scene.add_quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  auto row = ground_row(-3, 3, 20);
  row[3].there = false;
  row[4].normal = {0, -1, 0};
  const truth::Tracer tracer = scene.tracer();
  for (const auto& [asked, given] : {std::pair(1, 8), {8, 8}, {9, 16}, {24, 24}, {250, 256}}) {
    const Traced traced = trace_row(tracer, row, TracedSun{}, {.samples = asked});
    EXPECT_EQ(traced.samples, given);
    EXPECT_EQ(traced.rays, 18 * (given + 1));
    EXPECT_EQ(traced.visibility[3], 1) << "nothing is there";
    EXPECT_EQ(traced.hard[3], 1);
    EXPECT_EQ(traced.visibility[4], 0) << "it faces away";
    EXPECT_EQ(traced.hard[4], 0);
  }
}

TEST(TruthTrace, StopsAtTheErrorThatIsAskedFor) {
  const GroundView picture = boxes();
  const truth::Tracer tracer = picture.scene.tracer();
  const Traced truth = tracer.trace(picture.receivers, picture.width, wide_sun, {.samples = 8192, .seed = 77});
  long long before = 0;
  for (const double error : {0.02, 0.005}) {
    const Traced traced = tracer.trace(picture.receivers, picture.width, wide_sun, {.samples = 8, .error = error});
    double there = 0, over = 0, squares = 0, penumbra = 0;
    for (std::size_t i = 0; i < picture.receivers.size(); ++i) {
      if (!picture.receivers[i].there) continue;
      ++there;
      over += traced.standard_error[i] > error ? 1 : 0;
      if (truth.standard_error[i] == 0) continue;
      squares += std::pow(traced.visibility[i] - truth.visibility[i], 2);
      ++penumbra;
    }
    EXPECT_LE(over, 0.001 * there) << error;
    EXPECT_GE(traced.samples, 128) << error;
    // Adaptive sampling stops where the estimated error happens to be low, so the actual error is larger than
    // requested, but
    // less than twice as large.
    EXPECT_LT(std::sqrt(squares / penumbra), 1.5 * error) << error;
    EXPECT_GT(traced.rays, before);
    EXPECT_LT(traced.rays, 0.8 * static_cast<double>(traced.samples) * there) << "it is not adaptive";
    before = traced.rays;
  }
}

TEST(TruthTrace, WhatAgreesWithItsNeighboursIsDoneAfterTheFirstRound) {
  TruthScene scene;
  scene.add_quad({-9, 5, -9}, {18, 0, 0}, {0, 0, 18});
  const auto row = ground_row(-5, 5, 50);
  const Traced traced = trace_row(scene.tracer(), row, TracedSun{}, {.samples = 8, .error = 0.0001});
  EXPECT_EQ(traced.samples, 64);
  EXPECT_EQ(traced.rays, 50 * 65);
}

// A visible sliver of the sun that the first round's samples miss: the pixel continues because its neighbours are in
// the penumbra.
TEST(TruthTrace, FirstSamplesThatAgreeProveNothingBesideAPenumbra) {
  TruthScene scene;
  scene.add_quad({-60, 5, -60}, {60, 0, 0}, {0, 0, 120});
  const truth::Tracer tracer = scene.tracer();
  const double angle = 0.1;
  const double radius = 5 * std::tan(angle / 2);
  const double error = 0.002;
  std::vector<Receiver> row;
  std::vector<double> exact;
  for (int i = 0; i < 400; ++i) {
    const double t = -1.04 + 0.2 * i / 400;
    row.push_back(receiver_at({t * radius, 0, 0}, {0, 1, 0}));
    exact.push_back(disc_share(t));
  }
  const Traced traced = trace_row(tracer, row, TracedSun{.angle = angle}, {.samples = 64, .error = error});
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (exact[i] < 0.0005 || exact[i] > 0.01) continue;  // pixels in which 64 samples often all miss the sun
    squares += std::pow(traced.visibility[i] - exact[i], 2);
    ++count;
  }
  ASSERT_GT(count, 50);
  // Without the rule for neighbours, the error would be more than twice as large.
  EXPECT_LT(std::sqrt(squares / count), 1.25 * error);
}

TEST(TruthTrace, TellsProgressAndStopsWhenToldTo) {
  const GroundView picture = boxes();
  const truth::Tracer tracer = picture.scene.tracer();
  for (const double error : {0.0, 0.003}) {
    std::vector<double> shares;
    TraceOptions options{.samples = 512, .error = error, .threads = 2};
    options.progress = [&](double share) {
      shares.push_back(share);
      return true;
    };
    tracer.trace(picture.receivers, picture.width, wide_sun, options);
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GE(shares.front(), 0);
    EXPECT_EQ(shares.back(), 1);
  }
  const std::vector<Receiver> many(6400, receiver_at({0, 0, 0}, {0, 1, 0}));
  TraceOptions endless{.samples = 1 << 16, .threads = 2};
  int calls = 0;
  endless.progress = [&](double) { return ++calls < 2; };
  EXPECT_THROW(tracer.trace(many, 80, wide_sun, endless), truth::Interrupted);
  EXPECT_EQ(calls, 2);
  endless.progress = [&](double) -> bool { throw std::runtime_error("from outside"); };
  EXPECT_THROW(tracer.trace(many, 80, wide_sun, endless), std::runtime_error);
}

// Fills the stack with values such as a program leaves there.
[[gnu::noinline]] void soil_stack(unsigned char value) {
  volatile unsigned char litter[1 << 18];  // NOLINT(cppcoreguidelines-avoid-c-arrays): volatile
  for (volatile unsigned char& byte : litter) byte = value;
}

// Some builds of Embree read more of the stack than they have written, and then never end where instances share
// triangles.
TEST(TruthTrace, EndsWhateverTheStackHolds) {
  TruthScene scene;
  scene::Primitive& quad = scene.add_primitive();
  quad.positions = {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.indices.resize(3 * 64, 0);  // enough to be shared
  scene.place(quad);
  scene.place(quad, glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1));
  const auto row = ground_row(-3, 5, 200);
  const TraceOptions options{.samples = 64, .threads = 1};
  for (const std::size_t flat_triangles : {0, 1000}) {
    const truth::Tracer tracer = scene.tracer({.flat_triangles = flat_triangles});
    const Traced clean = trace_row(tracer, row, wide_sun, options);
    for (const unsigned char value : {0x00, 0x01, 0x3f, 0x80, 0xff}) {
      soil_stack(value);
      EXPECT_EQ(trace_row(tracer, row, wide_sun, options).visibility, clean.visibility);
    }
  }
}

TEST(TruthTrace, NothingToTraceIsNoFault) {
  const TruthScene scene;
  const truth::Tracer tracer = scene.tracer();
  const Traced empty = tracer.trace({}, 0, TracedSun{});
  EXPECT_TRUE(empty.visibility.empty());
  EXPECT_EQ(empty.samples, 0);
  for (const float v : trace_row(tracer, ground_row(0, 1, 4), TracedSun{}).visibility) EXPECT_EQ(v, 1);
}

}  // namespace
}  // namespace penumbra::test
