#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "app/commands.h"
#include "app/names.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "image/write.h"
#include "io/output_file.h"
#include "io/report.h"
#include "shadow/noise.h"
#include "shadow/sample_keys.h"
#include "shadow/sampling.h"

namespace penumbra::app {

namespace {

struct Common {
  std::string output;
  std::string seed = "1";
  bool quiet = false;
};

void add_common(CLI::App& app, Common& common, const char* files) {
  app.add_option("-o,--output", common.output, files)->required()->type_name("FILE");
  app.add_option("--seed", common.seed, "Seed of the random numbers")->type_name("N")->capture_default_str();
  app.add_flag("--quiet,-q", common.quiet, "Print errors only")->disable_flag_override();
}

// The file's extension, which is one of those that can be written.
std::string format_of(const std::string& output, const std::vector<std::string>& formats) {
  std::string extension = std::filesystem::path(output).extension().string();
  if (std::ranges::find(formats, extension) == formats.end()) {
    cli::fail_usage("-o {}: the name ends in none of {}", io::quoted(output), fmt::join(formats, ", "));
  }
  return extension;
}

std::uint64_t parse_seed(const std::string& text) {
  return static_cast<std::uint64_t>(cli::parse_count("--seed", text, 0, 1 << 30));
}

// 8-bit, unused channels 0; frames from top to bottom.
void write_noise_png(const std::string& path, const shadow::NoiseTile& tile) {
  const int channels = tile.channels == 1 ? 1 : 3;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(tile.count() * channels));
  for (int pixel = 0; pixel < tile.count(); ++pixel) {
    for (int c = 0; c < tile.channels; ++c) {
      pixels[static_cast<std::size_t>(pixel * channels + c)] =
          static_cast<std::uint8_t>(tile.rank(pixel, c) * 256 / tile.count());
    }
  }
  image::write_png(path, tile.size, tile.size * tile.frames, channels, pixels);
}

void write_noise_exr(const std::string& path, const shadow::NoiseTile& tile) {
  image::Layer layer{.name = "", .channels = {"R", "G", "B"}, .pixels = {}};
  if (tile.channels == 1) layer.channels = {"Y"};
  layer.channels.resize(static_cast<std::size_t>(tile.channels));
  for (int pixel = 0; pixel < tile.count(); ++pixel) {
    for (int c = 0; c < tile.channels; ++c) layer.pixels.push_back(tile.value(pixel, c));
  }
  image::write_exr(path, tile.size, tile.size * tile.frames, std::span(&layer, 1));
}

// Little-endian 16-bit numbers, as the library embeds them.
void write_numbers(const std::string& path, const std::vector<std::uint16_t>& numbers) {
  std::string bytes;
  for (const std::uint16_t number : numbers) {
    bytes += static_cast<char>(number & 0xffU);
    bytes += static_cast<char>(number >> 8U);
  }
  io::write_text(path, bytes);
}

void write_noise_ranks(const std::string& path, const shadow::NoiseTile& tile) { write_numbers(path, tile.ranks); }

int parse_noise_size(const std::string& text, int largest) {
  const int size = cli::parse_count("--size", text, shadow::least_noise_size, largest);
  if (size % shadow::least_noise_size != 0) {
    cli::fail_usage("--size can't be '{}': it takes a multiple of {}", text, shadow::least_noise_size);
  }
  return size;
}

int bake_noise(const Arguments& arguments) {
  CLI::App app("Make a tile of noise that decorrelates the sample points of neighbouring pixels",
               "penumbra bake noise");
  Common common;
  std::string kind = "blue";
  std::string size = "64";
  std::string channels = "2";
  std::string threads = "0";
  add_common(app, common, ".exr (float), .png (8 bits) or .u16 (ranks, 16 bits, little endian)");
  app.add_option("--kind", kind, fmt::format("{}", fmt::join(shadow::noise_kinds(), ", ")))
      ->type_name("KIND")
      ->capture_default_str();
  app.add_option("--size", size, "Side in pixels, a multiple of 16 (spatiotemporal: at most 64)")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--channels", channels, "Values per pixel, 1 to 3")->type_name("N")->capture_default_str();
  app.add_option("--threads", threads, "Threads that compute; 0: one per core. The result is the same")
      ->type_name("N")
      ->capture_default_str();
  if (!cli::parse(app, arguments)) return 0;
  const std::string format = format_of(common.output, {".exr", ".png", ".u16"});
  cli::one_of("noise", kind, shadow::noise_kinds());
  const int side = parse_noise_size(
      size, kind == "spatiotemporal" ? shadow::largest_spatiotemporal_size : shadow::largest_noise_size);
  const int values = cli::parse_count("--channels", channels, 1, shadow::most_noise_channels);
  const std::uint64_t seed = parse_seed(common.seed);
  const int most_threads = cli::parse_count("--threads", threads, 0, 1024);
  io::check_writable(common.output);
  cli::Progress progress(/* part= */ "", 100, !common.quiet);
  const shadow::NoiseTile tile = shadow::make_noise(
      kind, side, values, seed, most_threads, [&](double done) { progress.set_done(static_cast<int>(100 * done)); });
  const auto write = format == ".png" ? write_noise_png : format == ".exr" ? write_noise_exr : write_noise_ranks;
  write(common.output, tile);
  if (common.quiet) return 0;
  fmt::print("wrote {} ({} noise, {} × {}, power of low over high frequencies", cli::printable(common.output), kind,
             tile.size, tile.size);
  for (int c = 0; c < tile.channels; ++c) fmt::print(" {:.2g}", shadow::low_to_high_power(tile, c));
  fmt::print(")\n");
  return 0;
}

int bake_keys(const Arguments& arguments) {
  CLI::App app(
      "Make a tile of keys by which the sample points of neighbouring pixels differ: blue noise of their errors",
      "penumbra bake keys");
  Common common;
  std::string size = "64";
  add_common(app, common, ".u16: x, y and order of each pixel's key, 16 bits each, little endian, row by row");
  app.add_option("--size", size, "Side in pixels, a multiple of 16")->type_name("N")->capture_default_str();
  if (!cli::parse(app, arguments)) return 0;
  format_of(common.output, {".u16"});
  const int side = parse_noise_size(size, shadow::largest_noise_size);
  const std::uint64_t seed = parse_seed(common.seed);
  io::check_writable(common.output);
  cli::Progress progress(/* part= */ "", 100, !common.quiet);
  const shadow::KeyTile tile =
      shadow::make_sample_keys(side, seed, [&](double done) { progress.set_done(static_cast<int>(100 * done)); });
  std::vector<std::uint16_t> numbers;
  for (const shadow::SampleKey& key : tile.keys) numbers.insert(numbers.end(), {key.x, key.y, key.order});
  write_numbers(common.output, numbers);
  if (common.quiet) return 0;
  fmt::print("wrote {} (keys, {} × {}, power of the error's low over high frequencies", cli::printable(common.output),
             side, side);
  for (const int count : {1, 4, 16}) {
    fmt::print("{} {:.2g} with {} samples", count == 1 ? "" : ",",
               shadow::low_to_high_power(shadow::key_errors(tile, count, {0.6f, 0.8f}, 0.1f), side), count);
  }
  fmt::print(")\n");
  return 0;
}

std::string points_json(const std::vector<glm::vec2>& points, const std::string& pattern, std::uint64_t seed,
                        bool disc) {
  io::Json list = io::Json::array();
  for (const glm::vec2& p : points) list.push_back({p.x, p.y});
  return io::text_of(io::document(
      "points", 1, {{"pattern", pattern}, {"seed", seed}, {"shape", disc ? "disc" : "square"}, {"points", list}}));
}

std::string points_csv(const std::vector<glm::vec2>& points) {
  std::string text = "x,y\n";
  for (const glm::vec2& p : points) text += fmt::format("{},{}\n", p.x, p.y);
  return text;
}

int bake_points(const Arguments& arguments) {
  CLI::App app("Make a set of sample points", "penumbra bake points");
  Common common;
  std::string pattern = "poisson_hierarchical";
  std::string count = "64";
  bool disc = false;
  add_common(app, common, ".csv or .json");
  app.add_option("--pattern", pattern, fmt::format("{}", fmt::join(shadow::pattern_names(), ", ")))
      ->type_name("PATTERN")
      ->capture_default_str();
  app.add_option("--count", count, "Points, 1 to 1024")->type_name("N")->capture_default_str();
  app.add_flag("--disc", disc, "On the unit disc; else in the unit square")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  const std::string format = format_of(common.output, {".csv", ".json"});
  cli::one_of("pattern", pattern, shadow::pattern_names());
  const int wanted = cli::parse_count("--count", count, 1, 1024);
  const std::uint64_t seed = parse_seed(common.seed);
  const std::vector<glm::vec2> square = shadow::square_points(pattern, wanted, seed);
  const std::vector<glm::vec2> points = disc ? shadow::disc_points(pattern, wanted, seed) : square;
  io::write_text(common.output, format == ".json" ? points_json(points, pattern, seed, disc) : points_csv(points));
  if (common.quiet) return 0;
  fmt::print("wrote {} ({} points, {}; in the square: star discrepancy {:.4f}, least distance on the torus {:.4f})\n",
             cli::printable(common.output), wanted, pattern, shadow::star_discrepancy(square),
             shadow::least_toroidal_distance(square));
  return 0;
}

}  // namespace

const std::vector<std::string>& bake_kinds() {
  static const std::vector<std::string> kinds{"noise", "keys", "points"};
  return kinds;
}

int run_bake(const Arguments& arguments) {
  if (arguments.empty()) cli::fail_usage("what to bake is missing: {}", fmt::join(bake_kinds(), ", "));
  const Arguments rest(arguments.begin() + 1, arguments.end());
  cli::clean_up_on_signals();
  if (arguments.front() == "noise") return bake_noise(rest);
  if (arguments.front() == "keys") return bake_keys(rest);
  if (arguments.front() == "points") return bake_points(rest);
  if (arguments.front() == "--help" || arguments.front() == "-h") {
    fmt::print(
        "usage: penumbra bake noise|keys|points [OPTIONS] -o FILE\n\n"
        "The options: penumbra bake noise --help, penumbra bake keys --help, penumbra bake points --help\n");
    return 0;
  }
  cli::fail_unknown_usage("thing to bake", arguments.front(), bake_kinds());
}

}  // namespace penumbra::app
