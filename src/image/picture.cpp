#include "image/picture.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/names.h"
#include "core/read_file.h"
#include "image/bytes.h"
#include "image/image_library.h"
#include "image/png.h"
#include "image/precheck.h"
#include "io/output_file.h"

namespace penumbra::image {

namespace {

using Names = std::vector<std::string>;

// Bounds of a file's size: 16 float values a pixel, as many as an EXR may have, and everything else.
constexpr std::size_t bytes_per_pixel = 64, other_bytes = std::size_t{1} << 20;

// The layer of a channel: "a.b.R" is channel R of layer a.b.
std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

std::string without_layer(const std::string& channel) { return channel.substr(channel.rfind('.') + 1); }

Names layers_of(const Names& channels) {
  Names layers;
  for (const std::string& channel : channels) {
    const std::string layer = layer_of(channel);
    if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
  return layers;
}

std::string chosen_layer(const Names& layers, const std::string& wanted) {
  const bool found = std::find(layers.begin(), layers.end(), wanted) != layers.end();
  if (found) return wanted;
  if (wanted.empty() && layers.size() == 1) return layers[0];
  if (wanted.empty()) fail("name one of its layers: {}", fmt::join(layers, ", "));
  Names named = layers;
  std::erase(named, "");
  if (named.empty()) fail("it has no layers, so no '{}'", wanted);
  fail_unknown("layer", wanted, named);
}

// The file's indices of the channels to read; colours in the order red, green, blue.
std::vector<int> chosen_channels(const Names& channels, const std::string& layer) {
  std::vector<int> all;
  std::array<int, 3> color{-1, -1, -1};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (layer_of(channels[i]) != layer) continue;
    const std::string name = without_layer(channels[i]);
    if (name == "A") continue;
    all.push_back(static_cast<int>(i));
    const std::size_t at = std::string_view("RGB").find(name);
    if (name.size() == 1 && at != std::string_view::npos) color[at] = static_cast<int>(i);
  }
  if (std::find(color.begin(), color.end(), -1) == color.end()) return {color.begin(), color.end()};
  if (all.empty() || all.size() > 4) fail("{} channels make no picture; name a layer", all.size());
  return all;
}

std::vector<float> read_channel(ImageInput& input, int channel) {
  std::vector<float> values(input.pixels());
  input.read(channel, channel + 1, values.data());
  return values;
}

// The values of the chosen channels, interleaved. Channels that are adjacent in the file, as they nearly always are,
// are read at once, because each read decodes the whole file.
std::vector<float> read_channels(ImageInput& input, const std::vector<int>& chosen) {
  std::vector<float> pixels(input.pixels() * chosen.size());
  const auto jump = [](int a, int b) { return b != a + 1; };
  if (std::adjacent_find(chosen.begin(), chosen.end(), jump) == chosen.end()) {
    input.read(chosen.front(), chosen.back() + 1, pixels.data());
    return pixels;
  }
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const std::vector<float> values = read_channel(input, chosen[c]);
    for (std::size_t i = 0; i < values.size(); ++i) pixels[i * chosen.size() + c] = values[i];
  }
  return pixels;
}

[[noreturn]] void fail_not_opaque() { fail("it is not opaque: alpha is not 1 everywhere"); }

void check_alpha(ImageInput& input, const Names& channels, const std::string& layer) {
  const std::string name = layer.empty() ? "A" : layer + ".A";
  const auto found = std::find(channels.begin(), channels.end(), name);
  if (found == channels.end()) return;
  const std::vector<float> alpha = read_channel(input, static_cast<int>(found - channels.begin()));
  if (std::any_of(alpha.begin(), alpha.end(), [](float a) { return a != 1.0f; })) fail_not_opaque();
}

Picture read_png(std::span<const std::byte> bytes, std::size_t max_pixels) {
  const PngPixels png = decode_png(bytes, max_pixels);
  const auto stored = static_cast<std::size_t>(png.channels), colors = stored - (stored % 2 == 0 ? 1 : 0);
  Picture picture{png.width, png.height, /* display= */ true, {}, {}, {}};
  picture.channels = colors == 1 ? Names{"Y"} : Names{"R", "G", "B"};
  picture.pixels.reserve(png.count() / stored * colors);
  for (std::size_t i = 0; i < png.count(); ++i) {
    if (i % stored < colors)
      picture.pixels.push_back(png.value(i));
    else if (png.value(i) != 1.0f)
      fail_not_opaque();
  }
  return picture;
}

Picture read_exr(std::span<const std::byte> bytes, const std::string& name, const std::string& layer,
                 std::size_t max_pixels) {
  check_exr_header(bytes, max_pixels);
  const std::unique_ptr<ImageInput> input = image_library().open("openexr", bytes, name, max_pixels);
  const Names& channels = input->channels;
  Picture picture{input->width,
                  input->height,
                  /* display= */ false,
                  chosen_layer(layers_of(channels), layer),
                  {},
                  {}};
  const std::vector<int> chosen = chosen_channels(channels, picture.layer);
  check_alpha(*input, channels, picture.layer);
  picture.pixels = read_channels(*input, chosen);
  for (const int channel : chosen)
    picture.channels.push_back(without_layer(channels[static_cast<std::size_t>(channel)]));
  return picture;
}

Picture read(std::span<const std::byte> bytes, const std::string& name, const std::string& layer,
             std::size_t max_pixels) {
  if (bytes.empty()) fail("the file is empty");
  if (starts_with(bytes, exr_signature)) return read_exr(bytes, name, layer, max_pixels);
  if (!starts_with(bytes, png_signature)) fail("neither PNG nor EXR");
  if (!layer.empty()) fail("a PNG has no layers, so no '{}'", layer);
  return read_png(bytes, max_pixels);
}

}  // namespace

Picture read_picture(const std::filesystem::path& path, const std::string& layer, std::size_t max_pixels) {
  try {
    return read(read_file(path, bytes_per_pixel * max_pixels + other_bytes), path.string(), layer, max_pixels);
  } catch (const Error& error) {
    fail("cannot read {}: {}", io::quoted(path), error.what());
  } catch (const std::bad_alloc&) {
    fail("cannot read {}: not enough memory for its pixels", io::quoted(path));
  }
}

}  // namespace penumbra::image
