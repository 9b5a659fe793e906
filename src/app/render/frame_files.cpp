#include "app/render/frame_files.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/metadata.h"
#include "cli/command_line.h"
#include "image/write.h"
#include "io/output_file.h"
#include "render/aov_picture.h"

namespace penumbra::app {

namespace {

constexpr std::string_view color_name = "color";

const render::Aov& find_aov(std::string_view name) {
  const std::vector<render::Aov>& all = render::aovs();
  return *std::find_if(all.begin(), all.end(), [&](const render::Aov& aov) { return aov.name == name; });
}

// An AOV at the picture's size.
std::vector<float> read_layer(const render::Renderer& renderer, const RenderOptions& options, const render::Aov& aov) {
  const int channels = static_cast<int>(aov.channels.size());
  std::vector<float> layer = render::reduced(renderer.read_aov(aov.name), options.size.width, options.size.height,
                                             channels, options.supersample, aov.reduction);
  if (aov.in_pixels) {
    for (float& v : layer) v /= static_cast<float>(options.supersample);
  }
  return layer;
}

std::vector<cli::EncodedFile> pngs(const render::Renderer& renderer, const RenderOptions& options,
                                   const cli::OutputNames& names, int frame) {
  const auto [width, height] = options.size;
  const image::Metadata metadata{{"Software", cli::version()}};
  const render::ByteImage display = render::display_bytes(renderer.read_display(), width, height, options.supersample);
  std::vector<cli::EncodedFile> files{
      {names.picture(frame), image::encode_png(width, height, display.channels, display.pixels, metadata)}};
  for (const std::string& name : options.aovs) {
    if (name == color_name) continue;
    const render::Aov& aov = find_aov(name);
    const render::ByteImage bytes =
        render::aov_bytes(name, static_cast<int>(aov.channels.size()), read_layer(renderer, options, aov));
    files.push_back({names.aov(frame, name), image::encode_png(width, height, bytes.channels, bytes.pixels, metadata)});
  }
  return files;
}

cli::EncodedFile exr(const render::Renderer& renderer, const RenderOptions& options, const image::Metadata& metadata,
                     const cli::OutputNames& names, int frame) {
  std::vector<std::string> wanted{std::string(color_name)};
  std::remove_copy(options.aovs.begin(), options.aovs.end(), std::back_inserter(wanted), color_name);
  std::vector<image::Layer> layers;
  for (const std::string& name : wanted) {
    const render::Aov& aov = find_aov(name);
    layers.push_back({name == color_name ? "" : name, aov.channels, read_layer(renderer, options, aov)});
  }
  return {names.picture(frame), image::encode_exr(options.size.width, options.size.height, layers, metadata)};
}

}  // namespace

std::vector<std::filesystem::path> frame_files(const RenderOptions& options, const cli::OutputNames& names, int frame) {
  std::vector<std::filesystem::path> files{names.picture(frame)};
  if (names.is_exr()) return files;
  for (const std::string& name : options.aovs) {
    if (name != color_name) files.push_back(names.aov(frame, name));
  }
  return files;
}

std::vector<cli::EncodedFile> encoded_frame(const session::RenderSession& session, const RenderOptions& options,
                                            const ParamSet& params, const cli::OutputNames& names, int frame) {
  const render::Renderer& renderer = session.renderer();
  try {
    if (!names.is_exr()) return pngs(renderer, options, names, frame);
    return {exr(renderer, options, metadata_of(options, session.setup(), params, frame), names, frame)};
  } catch (const Error& error) {
    fail("cannot write {}: {}", io::quoted(names.picture(frame)), error.what());
  }
}

void write_frame(const session::RenderSession& session, const RenderOptions& options, const ParamSet& params,
                 const cli::OutputNames& names, int frame) {
  for (const cli::EncodedFile& file : encoded_frame(session, options, params, names, frame))
    io::write_text(file.path, {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
}

}  // namespace penumbra::app
