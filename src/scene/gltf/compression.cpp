#include "scene/gltf/compression.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#define MESHOPTIMIZER_NO_WRAPPERS
#include <meshoptimizer.h>

#include <cstring>
#include <exception>

#include "core/error.h"
#include "gl/shared_library.h"

namespace penumbra::scene::gltf {
namespace {

// The functions of libmeshoptimizer, which is loaded when the first file needs it: a program without the library can
// still read all other files.
struct Meshopt {
  decltype(&meshopt_decodeVertexBuffer) decode_vertices = nullptr;
  decltype(&meshopt_decodeIndexBuffer) decode_triangles = nullptr;
  decltype(&meshopt_decodeIndexSequence) decode_indices = nullptr;
  decltype(&meshopt_decodeFilterOct) filter_octahedral = nullptr;
  decltype(&meshopt_decodeFilterQuat) filter_quaternion = nullptr;
  decltype(&meshopt_decodeFilterExp) filter_exponential = nullptr;

  Meshopt() {
    const gl::SharedLibrary library("EXT_meshopt_compression", {"libmeshoptimizer.so.2d", "libmeshoptimizer.so"});
    library.require(decode_vertices, "meshopt_decodeVertexBuffer");
    library.require(decode_triangles, "meshopt_decodeIndexBuffer");
    library.require(decode_indices, "meshopt_decodeIndexSequence");
    library.require(filter_octahedral, "meshopt_decodeFilterOct");
    library.require(filter_quaternion, "meshopt_decodeFilterQuat");
    library.require(filter_exponential, "meshopt_decodeFilterExp");
  }
};

const Meshopt& meshopt() {
  static const Meshopt functions;
  return functions;
}

// meshoptimizer asserts on sizes that it does not support, so these are refused first.
void check_meshopt_sizes(const MeshoptStream& s) {
  const bool attributes = s.mode == "ATTRIBUTES";
  if (s.bytes.empty()) fail("EXT_meshopt_compression without data");
  if (attributes ? s.stride % 4 != 0 || s.stride > 256 : s.stride != 2 && s.stride != 4)
    fail("EXT_meshopt_compression with byteStride {} for {}", s.stride, s.mode);
  if (s.mode == "TRIANGLES" && s.count % 3 != 0) fail("EXT_meshopt_compression: {} is not whole triangles", s.count);
  if (!attributes && s.filter != "NONE") fail("EXT_meshopt_compression: {} can't be filtered", s.mode);
  const bool fits =
      s.filter == "OCTAHEDRAL" ? s.stride == 4 || s.stride == 8 : s.filter != "QUATERNION" || s.stride == 8;
  if (!fits) fail("EXT_meshopt_compression with byteStride {} for {}", s.stride, s.filter);
}

constexpr std::size_t densest = 256;  // faces per byte: far more than real meshes reach
// Bytes that the decoder takes for a face, of its indices and of the corner table, and for a point, besides attributes.
constexpr std::size_t draco_face = 36, draco_point = 12;
// The same of each corner table of attributes with seams. A stream declares up to 255 of them.
constexpr std::size_t draco_seam_face = 12, draco_seam_point = 16;

// Draco allocates what its header declares before it notices that the data are missing, so the header is checked here
// first. Returns the encoder method.
uint8_t check_draco_header(const char* data, std::size_t size, Budget& budget) {
  draco::DecoderBuffer buffer;
  buffer.Init(data, size);
  draco::DracoHeader header{};
  if (!buffer.Decode(&header.draco_string, 5) || std::memcmp(&header.draco_string, "DRACO", 5) != 0 ||
      !buffer.Decode(&header.version_major) || !buffer.Decode(&header.version_minor) ||
      !buffer.Decode(&header.encoder_type) || !buffer.Decode(&header.encoder_method) || !buffer.Decode(&header.flags))
    fail("Draco data without a header");
  if (header.version_major != 2 || header.version_minor != 2)
    fail("Draco bitstream {}.{}, not 2.2", header.version_major, header.version_minor);
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
  draco::GeometryMetadata metadata;
  if ((header.flags & METADATA_FLAG_MASK) != 0 && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    fail("Draco metadata is damaged");
  uint32_t faces = 0, points = 0;
  uint8_t traversal = 0, seam_tables = 0;
  const bool ok = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING
                      ? draco::DecodeVarint(&faces, &buffer) && draco::DecodeVarint(&points, &buffer)
                      : buffer.Decode(&traversal) && draco::DecodeVarint(&points, &buffer) &&
                            draco::DecodeVarint(&faces, &buffer) && buffer.Decode(&seam_tables);
  if (!ok) fail("Draco header is damaged");
  if (faces > size * densest || points > size * densest)
    fail("Draco data of {} bytes declares {} faces and {} vertices", size, faces, points);
  budget.spend(faces, draco_face + seam_tables * draco_seam_face);
  budget.spend(points, draco_point + seam_tables * draco_seam_point);
  return header.encoder_method;
}

// For each point an attribute takes its value, a whole number for each component while it is decoded, and an index.
void spend_attributes(const draco::PointCloud& cloud, Budget& budget) {
  for (int32_t i = 0; i < cloud.num_attributes(); ++i) {
    const draco::PointAttribute& attribute = *cloud.attribute(i);
    const std::size_t components = attribute.num_components();
    budget.spend(cloud.num_points(),
                 static_cast<std::size_t>(attribute.byte_stride()) + components * sizeof(int32_t) + sizeof(uint32_t));
  }
}

// Draco zero-fills every attribute that the stream declares before it reads the values, so they are counted first. An
// error must not pass through Draco's functions: it is kept until they have returned.
template <class Decoder>
class CountingDecoder final : public Decoder {
 public:
  explicit CountingDecoder(Budget& budget) : budget_(budget) {}

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 protected:
  bool DecodeAllAttributes() override {
    try {
      spend_attributes(*this->point_cloud(), budget_);
    } catch (const Error&) {
      error_ = std::current_exception();
      return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 private:
  Budget& budget_;
  std::exception_ptr error_;
};

template <class Decoder>
void decode_draco_mesh(draco::DecoderBuffer& buffer, draco::Mesh& mesh, Budget& budget) {
  const draco::DecoderOptions options;
  CountingDecoder<Decoder> decoder(budget);
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  decoder.rethrow();
  if (!status.ok()) fail("Draco data is damaged: {}", status.error_msg_string());
}

void decode_draco_mesh(const Bytes& bytes, draco::Mesh& mesh, Budget& budget) {
  const char* data = reinterpret_cast<const char*>(bytes.data());
  const Budget before = budget;
  const uint8_t method = check_draco_header(data, bytes.size(), budget);
  draco::DecoderBuffer buffer;
  buffer.Init(data, bytes.size());
  if (method == draco::MESH_SEQUENTIAL_ENCODING)
    decode_draco_mesh<draco::MeshSequentialDecoder>(buffer, mesh, budget);
  else if (method == draco::MESH_EDGEBREAKER_ENCODING)
    decode_draco_mesh<draco::MeshEdgebreakerDecoder>(buffer, mesh, budget);
  else
    fail("Draco data has the unknown encoder method {}", method);
  budget = before;  // the caller counts what it keeps; what a damaged stream took stays counted
}

template <class T>
std::vector<std::byte> draco_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components) {
  std::vector<std::byte> bytes(mesh.num_points() * static_cast<std::size_t>(components) * sizeof(T));
  std::vector<T> element(static_cast<std::size_t>(components));
  std::byte* out = bytes.data();
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue<T>(value, static_cast<int8_t>(components), element.data()))
      fail("Draco attribute can't be converted");
    std::memcpy(out, element.data(), element.size() * sizeof(T));
    out += element.size() * sizeof(T);
  }
  return bytes;
}

std::vector<std::byte> draco_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int component_type,
                                    int components) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return draco_values<int8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return draco_values<uint8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return draco_values<int16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return draco_values<uint16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return draco_values<uint32_t>(mesh, attribute, components);
    default:
      return draco_values<float>(mesh, attribute, components);
  }
}

AccessorView draco_view(Document& document, DracoMesh& out, const draco::Mesh& mesh, int accessor, int unique_id) {
  AccessorView view = view_accessor(document, accessor);
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<uint32_t>(unique_id));
  if (attribute == nullptr) fail("Draco data has no attribute {}", unique_id);
  if (attribute->num_components() != view.components)
    fail("Draco attribute {} has {} components, {} has {}", unique_id, attribute->num_components(), view.name,
         view.components);
  if (!attribute->is_mapping_identity() && attribute->indices_map_size() < mesh.num_points())
    fail("Draco attribute {} does not cover all vertices", unique_id);
  document.budget.spend(mesh.num_points(), view.element_size());
  out.storage.push_back(draco_values(mesh, *attribute, view.component_type, view.components));
  view.count = mesh.num_points();
  view.stride = view.element_size();
  view.bytes = out.storage.back();
  view.sparse.clear();
  return view;
}

}  // namespace

std::vector<std::byte> decode_meshopt(const MeshoptStream& s) {
  check_meshopt_sizes(s);
  std::vector<std::byte> decoded(s.count * s.stride);
  const auto* data = reinterpret_cast<const unsigned char*>(s.bytes.data());
  int error = 0;
  if (s.mode == "ATTRIBUTES")
    error = meshopt().decode_vertices(decoded.data(), s.count, s.stride, data, s.bytes.size());
  else if (s.mode == "TRIANGLES")
    error = meshopt().decode_triangles(decoded.data(), s.count, s.stride, data, s.bytes.size());
  else
    error = meshopt().decode_indices(decoded.data(), s.count, s.stride, data, s.bytes.size());
  if (error != 0) fail("EXT_meshopt_compression: the data is damaged");
  if (s.filter == "OCTAHEDRAL") meshopt().filter_octahedral(decoded.data(), s.count, s.stride);
  if (s.filter == "QUATERNION") meshopt().filter_quaternion(decoded.data(), s.count, s.stride);
  if (s.filter == "EXPONENTIAL") meshopt().filter_exponential(decoded.data(), s.count, s.stride);
  return decoded;
}

DracoMesh decode_draco(Document& document, const tinygltf::Primitive& primitive, const tinygltf::Value& extension) {
  const Bytes bytes = document.views[static_cast<std::size_t>(index_or(extension, "bufferView", 0))];
  if (bytes.empty()) fail("KHR_draco_mesh_compression without data");
  draco::Mesh mesh;
  decode_draco_mesh(bytes, mesh, document.budget);

  DracoMesh out;
  document.budget.spend(mesh.num_faces(), 3 * sizeof(uint32_t));
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
    for (const draco::PointIndex& corner : mesh.face(face)) out.indices.push_back(corner.value());
  const tinygltf::Value& attributes = extension.Get("attributes");
  for (const std::string& semantic : attributes.Keys()) {
    const auto accessor = primitive.attributes.find(semantic);
    if (accessor == primitive.attributes.end()) fail("Draco attribute {} has no accessor", semantic);
    out.attributes[semantic] =
        draco_view(document, out, mesh, accessor->second, index_or(attributes, semantic.c_str(), 0));
  }
  return out;
}

}  // namespace penumbra::scene::gltf
