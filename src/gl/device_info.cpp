#include <algorithm>
#include <array>

#include "api.h"
#include "context.h"

namespace penumbra::gl {
namespace {

struct LimitName {
  const char* name;
  GLenum query;
};

constexpr std::array limit_names{
    LimitName{"texture size", GL_MAX_TEXTURE_SIZE},
    LimitName{"texture array layers", GL_MAX_ARRAY_TEXTURE_LAYERS},
    LimitName{"3D texture size", GL_MAX_3D_TEXTURE_SIZE},
    LimitName{"texture units (fragment)", GL_MAX_TEXTURE_IMAGE_UNITS},
    LimitName{"texture units (all stages)", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS},
    LimitName{"image units", GL_MAX_IMAGE_UNITS},
    LimitName{"colour attachments", GL_MAX_COLOR_ATTACHMENTS},
    LimitName{"sub-pixel bits of vertex positions", GL_SUBPIXEL_BITS},
    LimitName{"framebuffer width", GL_MAX_FRAMEBUFFER_WIDTH},
    LimitName{"framebuffer height", GL_MAX_FRAMEBUFFER_HEIGHT},
    LimitName{"uniform block bytes", GL_MAX_UNIFORM_BLOCK_SIZE},
    LimitName{"uniform buffer bindings", GL_MAX_UNIFORM_BUFFER_BINDINGS},
    LimitName{"uniform buffer alignment", GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT},
    LimitName{"storage block bytes", GL_MAX_SHADER_STORAGE_BLOCK_SIZE},
    LimitName{"storage buffer bindings", GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS},
    LimitName{"storage buffers (vertex)", GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS},
    LimitName{"storage buffer alignment", GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT},
    LimitName{"vertex attributes", GL_MAX_VERTEX_ATTRIBS},
    LimitName{"compute invocations a group", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS},
    LimitName{"compute shared memory bytes", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE},
};

std::string text(GLenum name) {
  const GLubyte* value = glGetString(name);
  return value == nullptr ? "" : reinterpret_cast<const char*>(value);
}

bool is_software(const std::string& renderer) {
  constexpr std::array<std::string_view, 5> rasterisers{"llvmpipe", "softpipe", "swr", "SWR", "SwiftShader"};
  return std::ranges::any_of(rasterisers,
                             [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

}  // namespace

DeviceInfo device_info() {
  DeviceInfo info{.vendor = text(GL_VENDOR),
                  .renderer = text(GL_RENDERER),
                  .version = text(GL_VERSION),
                  .glsl_version = text(GL_SHADING_LANGUAGE_VERSION)};
  info.software = is_software(info.renderer);
  for (const LimitName& limit : limit_names) {
    GLint64 value = 0;
    glGetInteger64v(limit.query, &value);
    info.limits.push_back({limit.name, value});
  }
  for (GLuint axis = 0; axis < 3; ++axis) {
    GLint value = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &value);
    info.limits.push_back({std::string("compute groups ") + "xyz"[axis], value});
  }
  return info;
}

}  // namespace penumbra::gl
