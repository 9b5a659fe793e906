/* A context without a window, by EGL, and the OpenGL functions that this program calls. Your engine has both. */
#ifndef GL_H
#define GL_H

#include <GL/glcorearb.h>
#include <penumbra/penumbra.h>

#define GL_FUNCTIONS(X)                                          \
  X(PFNGLATTACHSHADERPROC, glAttachShader)                       \
  X(PFNGLBINDBUFFERPROC, glBindBuffer)                           \
  X(PFNGLBINDBUFFERBASEPROC, glBindBufferBase)                   \
  X(PFNGLBINDBUFFERRANGEPROC, glBindBufferRange)                 \
  X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                 \
  X(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)                 \
  X(PFNGLBLENDEQUATIONSEPARATEPROC, glBlendEquationSeparate)     \
  X(PFNGLBLENDFUNCSEPARATEPROC, glBlendFuncSeparate)             \
  X(PFNGLCLEARBUFFERFVPROC, glClearBufferfv)                     \
  X(PFNGLCLIPCONTROLPROC, glClipControl)                         \
  X(PFNGLCOLORMASKPROC, glColorMask)                             \
  X(PFNGLCOMPILESHADERPROC, glCompileShader)                     \
  X(PFNGLCREATEFRAMEBUFFERSPROC, glCreateFramebuffers)           \
  X(PFNGLCREATEPROGRAMPROC, glCreateProgram)                     \
  X(PFNGLCREATESHADERPROC, glCreateShader)                       \
  X(PFNGLCREATETEXTURESPROC, glCreateTextures)                   \
  X(PFNGLCREATEVERTEXARRAYSPROC, glCreateVertexArrays)           \
  X(PFNGLCULLFACEPROC, glCullFace)                               \
  X(PFNGLDELETEFRAMEBUFFERSPROC, glDeleteFramebuffers)           \
  X(PFNGLDELETEPROGRAMPROC, glDeleteProgram)                     \
  X(PFNGLDELETESHADERPROC, glDeleteShader)                       \
  X(PFNGLDELETETEXTURESPROC, glDeleteTextures)                   \
  X(PFNGLDELETEVERTEXARRAYSPROC, glDeleteVertexArrays)           \
  X(PFNGLDEPTHFUNCPROC, glDepthFunc)                             \
  X(PFNGLDEPTHMASKPROC, glDepthMask)                             \
  X(PFNGLDEPTHRANGEFPROC, glDepthRangef)                         \
  X(PFNGLDISABLEPROC, glDisable)                                 \
  X(PFNGLDRAWARRAYSPROC, glDrawArrays)                           \
  X(PFNGLENABLEPROC, glEnable)                                   \
  X(PFNGLFRONTFACEPROC, glFrontFace)                             \
  X(PFNGLGETBOOLEANVPROC, glGetBooleanv)                         \
  X(PFNGLGETFLOATVPROC, glGetFloatv)                             \
  X(PFNGLGETINTEGER64I_VPROC, glGetInteger64i_v)                 \
  X(PFNGLGETINTEGERI_VPROC, glGetIntegeri_v)                     \
  X(PFNGLGETINTEGERVPROC, glGetIntegerv)                         \
  X(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                       \
  X(PFNGLGETTEXTURESUBIMAGEPROC, glGetTextureSubImage)           \
  X(PFNGLISENABLEDPROC, glIsEnabled)                             \
  X(PFNGLLINKPROGRAMPROC, glLinkProgram)                         \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, glNamedFramebufferTexture) \
  X(PFNGLPOINTSIZEPROC, glPointSize)                             \
  X(PFNGLPOLYGONMODEPROC, glPolygonMode)                         \
  X(PFNGLPOLYGONOFFSETPROC, glPolygonOffset)                     \
  X(PFNGLSCISSORINDEXEDPROC, glScissorIndexed)                   \
  X(PFNGLSHADERSOURCEPROC, glShaderSource)                       \
  X(PFNGLSTENCILFUNCSEPARATEPROC, glStencilFuncSeparate)         \
  X(PFNGLSTENCILMASKSEPARATEPROC, glStencilMaskSeparate)         \
  X(PFNGLSTENCILOPSEPARATEPROC, glStencilOpSeparate)             \
  X(PFNGLTEXTURESTORAGE2DPROC, glTextureStorage2D)               \
  X(PFNGLUNIFORM4FPROC, glUniform4f)                             \
  X(PFNGLUNIFORMMATRIX4FVPROC, glUniformMatrix4fv)               \
  X(PFNGLUSEPROGRAMPROC, glUseProgram)                           \
  X(PFNGLVIEWPORTPROC, glViewport)

#define X(type, name) extern type name;
GL_FUNCTIONS(X)
#undef X

/* Makes a core context of OpenGL 4.5 current and loads the functions above. Returns 0 if there is none. */
int make_context(void);

/* For penumbra_device_desc. */
penumbra_proc get_proc(void* user, const char* name);

#endif
