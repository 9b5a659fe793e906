#include "scene/gltf/document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/log.h"
#include "scene/casting.h"
#include "scene/gltf/compression.h"
#include "scene/gltf/container.h"
#include "scene/gltf/resources.h"
#include "scene/gltf/schema.h"

namespace penumbra::scene::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::array supported_extensions = {
    "KHR_lights_punctual",   "KHR_materials_unlit",     "KHR_materials_emissive_strength", "KHR_texture_transform",
    "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",      "EXT_meshopt_compression",
};

// "2.1" as {2, 1}.
std::pair<int, int> parse_version(const std::string& text) {
  int major = 0, minor = 0;
  const char* const end = text.data() + text.size();
  const auto [after_major, major_error] = std::from_chars(text.data(), end, major);
  if (major_error != std::errc() || after_major == end || *after_major != '.')
    fail("asset version '{}' is not a version", text);
  const auto [after_minor, minor_error] = std::from_chars(after_major + 1, end, minor);
  if (minor_error != std::errc() || after_minor != end) fail("asset version '{}' is not a version", text);
  return {major, minor};
}

void check_asset(const Json& json) {
  const Json& asset = json["asset"];
  const auto version = parse_version(asset["version"].get<std::string>());
  if (version.first != 2) fail("glTF version {}, not 2", asset["version"].get<std::string>());
  if (!asset.contains("minVersion")) return;
  const auto least = parse_version(asset["minVersion"].get<std::string>());
  if (least > std::pair(2, 0)) fail("needs glTF {}, this program reads 2.0", asset["minVersion"].get<std::string>());
}

bool is_supported(std::string_view name) {
  return std::ranges::find(supported_extensions, name) != supported_extensions.end();
}

void check_extensions(const Json& json) {
  if (!json.contains("extensionsRequired")) return;
  for (const Json& element : json["extensionsRequired"]) {
    const auto& name = element.get_ref<const std::string&>();
    if (!is_supported(name)) fail("requires the extension {}, which is not supported", name);
  }
}

bool is_meshopt_fallback(const Json& buffer) {
  return buffer.contains("extensions") && buffer["extensions"].contains("EXT_meshopt_compression");
}

// Where a bufferView's bytes come from: the compressed form if it has one, else the bufferView itself.
const Json& origin_of(const Json& view) {
  if (!view.contains("extensions")) return view;
  const auto meshopt = view["extensions"].find("EXT_meshopt_compression");
  return meshopt == view["extensions"].end() ? view : *meshopt;
}

std::vector<bool> buffers_with_views(const Json& json) {
  std::vector<bool> viewed(json["buffers"].size(), false);
  if (!json.contains("bufferViews")) return viewed;
  for (const Json& view : json["bufferViews"]) {
    const auto number = origin_of(view)["buffer"].get<std::size_t>();
    if (number < viewed.size()) viewed[number] = true;  // else the bufferView was left out
  }
  return viewed;
}

class BufferLoader {
 public:
  BufferLoader(Document& document, const Container& container) : document_(document), container_(container) {}

  std::vector<Bytes> load() {
    std::vector<Bytes> buffers;
    if (!container_.json.contains("buffers")) return buffers;
    const std::vector<bool> viewed = buffers_with_views(container_.json);
    for (const Json& buffer : container_.json["buffers"]) {
      const std::size_t number = buffers.size();
      Bytes& bytes = buffers.emplace_back();
      if (document_.left_out.holds("buffers", number)) continue;
      try {
        bytes = load(buffer, number, viewed[number]);
      } catch (const Error& e) {
        document_.left_out.add("buffers", number, e.what());
      }
    }
    return buffers;
  }

 private:
  // Nothing for a buffer without data, or without a bufferView.
  Bytes load(const Json& buffer, std::size_t number, bool viewed) {
    const auto length = buffer["byteLength"].get<std::size_t>();
    Bytes bytes;
    if (buffer.contains("uri")) {
      const auto& uri = buffer["uri"].get_ref<const std::string&>();
      if (!viewed) {
        open_uri(document_.folder, uri, document_.options);  // for its faults; its length is not looked at
        return {};
      }
      bytes = load(uri);
    } else if (number == 0 && container_.has_binary) {
      bytes = container_.binary;
    } else {
      if (!is_meshopt_fallback(buffer)) warn("buffers[{}] has no data; what uses it reads zeros", number);
      return {};
    }
    if (bytes.size() < length) fail("has {} bytes, not {}", bytes.size(), length);
    return bytes.first(length);
  }

  // Buffers of one file share its bytes.
  Bytes load(const std::string& uri) {
    const auto file = file_of_uri(document_.folder, uri, document_.options);
    if (const auto known = files_.find(file); known != files_.end()) return known->second;
    document_.storage.push_back(load_uri(document_.folder, uri, document_.options));
    const Bytes bytes = document_.storage.back();
    document_.budget.add_file(file, bytes.size());
    if (!file.empty()) files_.emplace(file, bytes);
    return bytes;
  }

  Document& document_;
  const Container& container_;
  std::map<std::filesystem::path, Bytes> files_;
};

// The bytes of a buffer that a bufferView, or its compressed form, refers to.
Bytes cut(const std::vector<Bytes>& buffers, const Json& view) {
  const Bytes buffer = buffers[view["buffer"].get<std::size_t>()];
  const auto offset = view.value("byteOffset", std::size_t{0}), length = view["byteLength"].get<std::size_t>();
  if (buffer.empty()) return {};
  if (offset > buffer.size() || length > buffer.size() - offset)
    fail("bytes {} to {} of a buffer of {}", offset, offset + length, buffer.size());
  return buffer.subspan(offset, length);
}

void cut_views(Document& document, const Json& json, const std::vector<Bytes>& buffers) {
  if (!json.contains("bufferViews")) return;
  for (const Json& view : json["bufferViews"]) {
    if (document.left_out.holds("bufferViews", document.views.size())) {
      document.views.emplace_back();
      continue;
    }
    try {
      const Json& origin = origin_of(view);
      if (&origin == &view) {
        document.views.push_back(cut(buffers, view));
        continue;
      }
      const MeshoptStream stream{.bytes = cut(buffers, origin),
                                 .count = origin["count"].get<std::size_t>(),
                                 .stride = origin["byteStride"].get<std::size_t>(),
                                 .mode = origin["mode"].get<std::string>(),
                                 .filter = origin.value("filter", std::string("NONE"))};
      if (stream.count * stream.stride != view["byteLength"].get<std::size_t>())
        fail("EXT_meshopt_compression's count and byteStride don't give its byteLength");
      document.budget.spend(stream.count, stream.stride);
      document.storage.push_back(decode_meshopt(stream));
      document.views.emplace_back(document.storage.back());
    } catch (const Error& e) {
      document.left_out.add("bufferViews", document.views.size(), e.what());
      document.views.emplace_back();
    }
  }
}

void list_images(Document& document, const Json& json) {
  if (!json.contains("images")) return;
  for (const Json& image : json["images"]) {
    ImageSource source{.name = fmt::format("images[{}]", document.images.size())};
    if (image.contains("uri") == image.contains("bufferView"))
      document.left_out.add("images", document.images.size(), "must have either a uri or a bufferView");
    source.uri = image.value("uri", std::string());
    source.view = image.value("bufferView", -1);
    if (!source.uri.empty() && !is_data_uri(source.uri)) source.name += fmt::format(" '{}'", source.uri.substr(0, 80));
    document.images.push_back(std::move(source));
  }
}

void list_files(Document& document, const Json& json) {
  for (const char* key : {"buffers", "images"}) {
    if (!json.contains(key)) continue;
    for (const Json& owner : json[key]) {
      const auto uri = owner.value("uri", std::string());
      if (auto file = named_file(document.folder, uri, document.options.follow_links))
        document.files.push_back(std::move(*file));
    }
  }
}

template <class T>
void spend_array(Budget& budget, const Json& owner, const char* key) {
  if (owner.contains(key)) budget.spend(owner[key].size(), sizeof(T));
}

// tinygltf's structures are large, even for an empty object of two characters, so they count against the memory limit.
// The JSON's types are not checked yet, but the size of a value that is not an array is harmless.
void spend_model(Document& document, const Json& json) {
  Budget& budget = document.budget;
  if (json.contains("nodes") && json["nodes"].size() > document.options.limits.nodes)
    fail_over_limit(fmt::format("{} nodes", json["nodes"].size()), document.options.limits, &ReadLimits::nodes);
  spend_array<tinygltf::Node>(budget, json, "nodes");
  spend_array<tinygltf::Accessor>(budget, json, "accessors");
  spend_array<tinygltf::BufferView>(budget, json, "bufferViews");
  spend_array<tinygltf::Material>(budget, json, "materials");
  spend_array<tinygltf::Texture>(budget, json, "textures");
  spend_array<tinygltf::Sampler>(budget, json, "samplers");
  spend_array<tinygltf::Skin>(budget, json, "skins");
  spend_array<tinygltf::Camera>(budget, json, "cameras");
  spend_array<tinygltf::Scene>(budget, json, "scenes");
  spend_array<tinygltf::Mesh>(budget, json, "meshes");
  spend_array<tinygltf::Animation>(budget, json, "animations");
  if (json.contains("meshes"))
    for (const Json& mesh : json["meshes"]) spend_array<tinygltf::Primitive>(budget, mesh, "primitives");
  if (!json.contains("animations")) return;
  for (const Json& animation : json["animations"]) {
    spend_array<tinygltf::AnimationChannel>(budget, animation, "channels");
    spend_array<tinygltf::AnimationSampler>(budget, animation, "samplers");
  }
}

// tinygltf would read files itself, and refuses index accessors without a bufferView (Draco's and sparse ones have
// none) and buffers without data. So it gets the document without buffers and images, and with a bufferView in every
// accessor.
tinygltf::Model parse_model(Json json) {
  json.erase("buffers");
  json.erase("images");
  const std::size_t none = json.contains("bufferViews") ? json["bufferViews"].size() : 0;
  json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
  if (json.contains("accessors"))
    for (Json& accessor : json["accessors"])
      if (!accessor.contains("bufferView")) accessor["bufferView"] = none;

  const std::string text = json.dump();
  json = nullptr;
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned int>(text.size()), ""))
    fail("{}", error.empty() ? "tinygltf can't read it" : error);

  model.bufferViews.resize(none);
  for (tinygltf::Accessor& accessor : model.accessors)
    if (static_cast<std::size_t>(accessor.bufferView) == none) accessor.bufferView = -1;
  return model;
}

}  // namespace

Document read_document(const std::filesystem::path& path, const ReadOptions& options) {
  Container container = read_container(path, options.limits);
  if (!container.json.is_object()) fail("the JSON is not an object");
  Document document{.folder = path.parent_path(),
                    .options = options,
                    .budget = Budget(options.limits),
                    .left_out = LeftOut(path.string(), Used(container.json))};
  document.budget.add_file({}, std::filesystem::file_size(path));
  spend_model(document, container.json);
  check_schema(container.json, document.left_out);
  check_asset(container.json);
  check_extensions(container.json);

  list_files(document, container.json);
  if (options.names_files) options.names_files(document.files);
  const std::vector<Bytes> buffers = BufferLoader(document, container).load();
  cut_views(document, container.json, buffers);
  list_images(document, container.json);
  document.model = parse_model(std::move(container.json));
  document.storage.push_back(std::move(container.file));  // moving a vector leaves its bytes where they are
  return document;
}

CastSetting casting_of_extras(const tinygltf::Value& extras, const std::string& place) {
  constexpr const char* key = "penumbra_casts";
  if (!extras.IsObject() || !extras.Has(key)) return CastSetting::automatic;
  const tinygltf::Value& value = extras.Get(key);
  if (value.IsBool()) return value.Get<bool>() ? CastSetting::on : CastSetting::off;
  if (value.IsString())
    if (const auto casting = casting_of(value.Get<std::string>())) return *casting;
  warn("{}: {} of its extras is neither true nor false nor one of {}; not used", place, key,
       fmt::join(casting_words(), ", "));
  return CastSetting::automatic;
}

double number_or(const tinygltf::Value& object, const char* key, double otherwise) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

int index_or(const tinygltf::Value& object, const char* key, int otherwise) {
  return object.Has(key) ? object.Get(key).GetNumberAsInt() : otherwise;
}

std::vector<double> numbers_or(const tinygltf::Value& object, const char* key, std::vector<double> otherwise) {
  if (!object.Has(key)) return otherwise;
  const tinygltf::Value& array = object.Get(key);
  for (std::size_t i = 0; i < otherwise.size(); ++i) otherwise[i] = array.Get(static_cast<int>(i)).GetNumberAsDouble();
  return otherwise;
}

}  // namespace penumbra::scene::gltf

namespace penumbra::scene {

bool reads_extension(std::string_view name) {
  return gltf::is_supported(name) || name == "KHR_materials_pbrSpecularGlossiness";  // the diffuse part of that
}

}  // namespace penumbra::scene
