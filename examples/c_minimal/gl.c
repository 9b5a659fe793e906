#include "gl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#define X(type, name) type name = NULL;
GL_FUNCTIONS(X)
#undef X

penumbra_proc get_proc(void* user, const char* name) {
  (void)user;
  return eglGetProcAddress(name);
}

int make_context(void) {
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLContext context;
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API)) return 0;
  context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return 0;
#define X(type, name) name = (type)eglGetProcAddress(#name);
  GL_FUNCTIONS(X)
#undef X
  return 1;
}
