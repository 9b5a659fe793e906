#include "app/render/frame_files.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/light_layers.h"
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

std::size_t pictures_of(const render::Aov& aov, std::size_t lights) { return aov.of_light ? lights : 1; }

// How many lights cast shadows.
std::size_t lights_of(const session::RenderSession& session) { return render::shadowed_lights(session.setup()).size(); }

// An AOV at the picture's size.
std::vector<float> read_layer(const render::Renderer& renderer, const RenderOptions& options, const render::Aov& aov,
                              std::size_t light) {
  const int channels = static_cast<int>(aov.channels.size());
  std::vector<float> layer = render::reduced(renderer.read_aov(aov.name, static_cast<int>(light)), options.size.width,
                                             options.size.height, channels, options.supersample, aov.reduction);
  if (aov.in_pixels) {
    for (float& v : layer) v /= static_cast<float>(options.supersample);
  }
  return layer;
}

std::vector<cli::EncodedFile> pngs(const session::RenderSession& session, const RenderOptions& options,
                                   const cli::OutputNames& names, int frame) {
  const auto [width, height] = options.size;
  const render::Renderer& renderer = session.renderer();
  const image::Metadata metadata{{"Software", cli::version()}};
  const render::ByteImage display = render::display_bytes(renderer.read_display(), width, height, options.supersample);
  std::vector<cli::EncodedFile> files{
      {names.picture(frame), image::encode_png(width, height, display.channels, display.pixels, metadata)}};
  for (const std::string& name : options.aovs) {
    if (name == color_name) continue;
    const render::Aov& aov = find_aov(name);
    for (std::size_t light = 0; light < pictures_of(aov, lights_of(session)); ++light) {
      const render::ByteImage bytes =
          render::aov_bytes(name, static_cast<int>(aov.channels.size()), read_layer(renderer, options, aov, light));
      files.push_back({names.aov(frame, layer_name(name, light)),
                       image::encode_png(width, height, bytes.channels, bytes.pixels, metadata)});
    }
  }
  return files;
}

cli::EncodedFile exr(const session::RenderSession& session, const RenderOptions& options,
                     const image::Metadata& metadata, const cli::OutputNames& names, int frame) {
  std::vector<std::string> wanted{std::string(color_name)};
  std::remove_copy(options.aovs.begin(), options.aovs.end(), std::back_inserter(wanted), color_name);
  std::vector<image::Layer> layers;
  for (const std::string& name : wanted) {
    const render::Aov& aov = find_aov(name);
    for (std::size_t light = 0; light < pictures_of(aov, lights_of(session)); ++light)
      layers.push_back({name == color_name ? "" : layer_name(name, light), aov.channels,
                        read_layer(session.renderer(), options, aov, light)});
  }
  return {names.picture(frame), image::encode_exr(options.size.width, options.size.height, layers, metadata)};
}

}  // namespace

std::vector<std::filesystem::path> frame_files(const RenderOptions& options, const cli::OutputNames& names, int frame,
                                               std::size_t lights) {
  std::vector<std::filesystem::path> files{names.picture(frame)};
  if (names.is_exr()) return files;
  for (const std::string& name : options.aovs) {
    if (name == color_name) continue;
    for (std::size_t light = 0; light < pictures_of(find_aov(name), lights); ++light)
      files.push_back(names.aov(frame, layer_name(name, light)));
  }
  return files;
}

std::vector<cli::EncodedFile> encoded_frame(const session::RenderSession& session, const RenderOptions& options,
                                            const ParamSet& params, const cli::OutputNames& names, int frame) {
  try {
    if (!names.is_exr()) return pngs(session, options, names, frame);
    image::Metadata metadata = metadata_of(options, session.setup(), params, frame);
    metadata.emplace_back("penumbra:samples", std::to_string(options.samples));
    metadata.emplace_back("penumbra:sample_shadows", options.own_shadows ? "true" : "false");
    metadata.emplace_back("penumbra:aov_samples", options.average_aovs ? "all" : "first");
    return {exr(session, options, metadata, names, frame)};
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
