#include "gl_calls.h"

#include <algorithm>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

#include "gl/api.h"
#include "gl/api_table.h"

namespace penumbra::test {
namespace {

// A function that counts a call and then calls the entry point that the table's member `slot` held.
template <auto slot>
struct Counting;

template <class Result, class... Args, Result (APIENTRYP gl::Api::*slot)(Args...)>
struct Counting<slot> {
  static inline Result(APIENTRY* real)(Args...) = nullptr;
  static inline int calls = 0;

  static Result APIENTRY call(Args... args) {
    ++calls;
    return real(args...);
  }
  static void install() {
    real = gl::current_api->*slot;
    gl::current_api->*slot = call;
    calls = 0;
  }
  static void remove() { gl::current_api->*slot = real; }
};

struct Entry {
  const char* name;
  void (*install)();
  void (*remove)();
  int* calls;
};

template <auto slot>
constexpr Entry entry(const char* name) {
  return {name, Counting<slot>::install, Counting<slot>::remove, &Counting<slot>::calls};
}

#define COUNTED(function) entry<&gl::Api::function>(#function)

constexpr Entry queries[] = {
    COUNTED(glGetBooleanv),
    COUNTED(glGetDoublev),
    COUNTED(glGetError),
    COUNTED(glGetFloatv),
    COUNTED(glGetIntegerv),
    COUNTED(glGetString),
    COUNTED(glGetTexImage),
    COUNTED(glGetTexParameterfv),
    COUNTED(glGetTexParameteriv),
    COUNTED(glGetTexLevelParameterfv),
    COUNTED(glGetTexLevelParameteriv),
    COUNTED(glIsEnabled),
    COUNTED(glGetPointerv),
    COUNTED(glIsTexture),
    COUNTED(glGetCompressedTexImage),
    COUNTED(glIsQuery),
    COUNTED(glGetQueryiv),
    COUNTED(glGetQueryObjectiv),
    COUNTED(glGetQueryObjectuiv),
    COUNTED(glIsBuffer),
    COUNTED(glGetBufferSubData),
    COUNTED(glGetBufferParameteriv),
    COUNTED(glGetBufferPointerv),
    COUNTED(glGetActiveAttrib),
    COUNTED(glGetActiveUniform),
    COUNTED(glGetAttachedShaders),
    COUNTED(glGetAttribLocation),
    COUNTED(glGetProgramiv),
    COUNTED(glGetProgramInfoLog),
    COUNTED(glGetShaderiv),
    COUNTED(glGetShaderInfoLog),
    COUNTED(glGetShaderSource),
    COUNTED(glGetUniformLocation),
    COUNTED(glGetUniformfv),
    COUNTED(glGetUniformiv),
    COUNTED(glGetVertexAttribdv),
    COUNTED(glGetVertexAttribfv),
    COUNTED(glGetVertexAttribiv),
    COUNTED(glGetVertexAttribPointerv),
    COUNTED(glIsProgram),
    COUNTED(glIsShader),
    COUNTED(glGetBooleani_v),
    COUNTED(glGetIntegeri_v),
    COUNTED(glIsEnabledi),
    COUNTED(glGetTransformFeedbackVarying),
    COUNTED(glGetVertexAttribIiv),
    COUNTED(glGetVertexAttribIuiv),
    COUNTED(glGetUniformuiv),
    COUNTED(glGetFragDataLocation),
    COUNTED(glGetTexParameterIiv),
    COUNTED(glGetTexParameterIuiv),
    COUNTED(glGetStringi),
    COUNTED(glIsRenderbuffer),
    COUNTED(glGetRenderbufferParameteriv),
    COUNTED(glIsFramebuffer),
    COUNTED(glCheckFramebufferStatus),
    COUNTED(glGetFramebufferAttachmentParameteriv),
    COUNTED(glIsVertexArray),
    COUNTED(glGetUniformIndices),
    COUNTED(glGetActiveUniformsiv),
    COUNTED(glGetActiveUniformName),
    COUNTED(glGetUniformBlockIndex),
    COUNTED(glGetActiveUniformBlockiv),
    COUNTED(glGetActiveUniformBlockName),
    COUNTED(glIsSync),
    COUNTED(glGetInteger64v),
    COUNTED(glGetSynciv),
    COUNTED(glGetInteger64i_v),
    COUNTED(glGetBufferParameteri64v),
    COUNTED(glGetMultisamplefv),
    COUNTED(glGetFragDataIndex),
    COUNTED(glIsSampler),
    COUNTED(glGetSamplerParameteriv),
    COUNTED(glGetSamplerParameterIiv),
    COUNTED(glGetSamplerParameterfv),
    COUNTED(glGetSamplerParameterIuiv),
    COUNTED(glGetQueryObjecti64v),
    COUNTED(glGetQueryObjectui64v),
    COUNTED(glGetUniformdv),
    COUNTED(glGetSubroutineUniformLocation),
    COUNTED(glGetSubroutineIndex),
    COUNTED(glGetActiveSubroutineUniformiv),
    COUNTED(glGetActiveSubroutineUniformName),
    COUNTED(glGetActiveSubroutineName),
    COUNTED(glGetUniformSubroutineuiv),
    COUNTED(glGetProgramStageiv),
    COUNTED(glIsTransformFeedback),
    COUNTED(glGetQueryIndexediv),
    COUNTED(glGetShaderPrecisionFormat),
    COUNTED(glGetProgramBinary),
    COUNTED(glIsProgramPipeline),
    COUNTED(glGetProgramPipelineiv),
    COUNTED(glGetProgramPipelineInfoLog),
    COUNTED(glGetVertexAttribLdv),
    COUNTED(glGetFloati_v),
    COUNTED(glGetDoublei_v),
    COUNTED(glGetInternalformativ),
    COUNTED(glGetActiveAtomicCounterBufferiv),
    COUNTED(glGetFramebufferParameteriv),
    COUNTED(glGetInternalformati64v),
    COUNTED(glGetProgramInterfaceiv),
    COUNTED(glGetProgramResourceIndex),
    COUNTED(glGetProgramResourceName),
    COUNTED(glGetProgramResourceiv),
    COUNTED(glGetProgramResourceLocation),
    COUNTED(glGetProgramResourceLocationIndex),
    COUNTED(glGetDebugMessageLog),
    COUNTED(glGetObjectLabel),
    COUNTED(glGetObjectPtrLabel),
    COUNTED(glGetTransformFeedbackiv),
    COUNTED(glGetTransformFeedbacki_v),
    COUNTED(glGetTransformFeedbacki64_v),
    COUNTED(glGetNamedBufferParameteriv),
    COUNTED(glGetNamedBufferParameteri64v),
    COUNTED(glGetNamedBufferPointerv),
    COUNTED(glGetNamedBufferSubData),
    COUNTED(glCheckNamedFramebufferStatus),
    COUNTED(glGetNamedFramebufferParameteriv),
    COUNTED(glGetNamedFramebufferAttachmentParameteriv),
    COUNTED(glGetNamedRenderbufferParameteriv),
    COUNTED(glGetTextureImage),
    COUNTED(glGetCompressedTextureImage),
    COUNTED(glGetTextureLevelParameterfv),
    COUNTED(glGetTextureLevelParameteriv),
    COUNTED(glGetTextureParameterfv),
    COUNTED(glGetTextureParameterIiv),
    COUNTED(glGetTextureParameterIuiv),
    COUNTED(glGetTextureParameteriv),
    COUNTED(glGetVertexArrayiv),
    COUNTED(glGetVertexArrayIndexediv),
    COUNTED(glGetVertexArrayIndexed64iv),
    COUNTED(glGetQueryBufferObjecti64v),
    COUNTED(glGetQueryBufferObjectiv),
    COUNTED(glGetQueryBufferObjectui64v),
    COUNTED(glGetQueryBufferObjectuiv),
    COUNTED(glGetTextureSubImage),
    COUNTED(glGetCompressedTextureSubImage),
    COUNTED(glGetGraphicsResetStatus),
    COUNTED(glGetnCompressedTexImage),
    COUNTED(glGetnTexImage),
    COUNTED(glGetnUniformdv),
    COUNTED(glGetnUniformfv),
    COUNTED(glGetnUniformiv),
    COUNTED(glGetnUniformuiv),
};

constexpr Entry creations[] = {
    COUNTED(glGenTextures),
    COUNTED(glGenQueries),
    COUNTED(glGenBuffers),
    COUNTED(glCreateProgram),
    COUNTED(glCreateShader),
    COUNTED(glGenRenderbuffers),
    COUNTED(glGenFramebuffers),
    COUNTED(glGenVertexArrays),
    COUNTED(glGenSamplers),
    COUNTED(glGenTransformFeedbacks),
    COUNTED(glCreateShaderProgramv),
    COUNTED(glGenProgramPipelines),
    COUNTED(glCreateTransformFeedbacks),
    COUNTED(glCreateBuffers),
    COUNTED(glCreateFramebuffers),
    COUNTED(glCreateRenderbuffers),
    COUNTED(glCreateTextures),
    COUNTED(glCreateVertexArrays),
    COUNTED(glCreateSamplers),
    COUNTED(glCreateProgramPipelines),
    COUNTED(glCreateQueries),
};

constexpr Entry writes[] = {
    COUNTED(glBufferSubData),           COUNTED(glNamedBufferSubData), COUNTED(glCopyBufferSubData),
    COUNTED(glCopyNamedBufferSubData),  COUNTED(glClearBufferSubData), COUNTED(glClearNamedBufferSubData),
    COUNTED(glInvalidateBufferSubData),
};

#undef COUNTED

bool is_of(GlCalls::Kind kind, std::string_view name) {
  if (kind == GlCalls::Kind::queries) {
    return name.starts_with("glGet") || name.starts_with("glIs") || name.starts_with("glCheck");
  }
  if (kind == GlCalls::Kind::writes) return name.ends_with("BufferSubData") && !name.starts_with("glGet");
  return name.starts_with("glCreate") || (name.starts_with("glGen") && !name.starts_with("glGenerate"));
}

std::span<const Entry> entries_of(GlCalls::Kind kind) {
  switch (kind) {
    case GlCalls::Kind::queries:
      return queries;
    case GlCalls::Kind::creations:
      return creations;
    case GlCalls::Kind::writes:
      return writes;
  }
  return {};
}

// Every loaded entry point of the kind is counted, so functions that Penumbra starts to use later are counted too.
void check_list(GlCalls::Kind kind) {
  std::set<std::string_view> counted;
  for (const Entry& entry : entries_of(kind)) counted.insert(entry.name);
  for (const gl::ApiEntry& entry : gl::api_table()) {
    if (is_of(kind, entry.name) && !counted.contains(entry.name)) throw std::logic_error(entry.name);
  }
}

}  // namespace

GlCalls::GlCalls(Kind kind) : kind_(kind) {
  check_list(kind);
  for (const Entry& entry : entries_of(kind)) entry.install();
}

GlCalls::~GlCalls() {
  for (const Entry& entry : entries_of(kind_)) entry.remove();
}

std::map<std::string, int> GlCalls::counts() const {
  std::map<std::string, int> counts;
  for (const Entry& entry : entries_of(kind_)) {
    if (*entry.calls > 0) counts[entry.name] = *entry.calls;
  }
  return counts;
}

void GlCalls::reset() {
  for (const Entry& entry : entries_of(kind_)) *entry.calls = 0;
}

}  // namespace penumbra::test
