// Takes the place of libEGL.so.1 for tests/demos/program/gl_choice_program_test.cpp: the machine's own EGL,
// which knows no surfaceless display. A driver of a graphics card does not, and stands first where it is
// installed.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

namespace {

template <typename Function>
Function* own(const char* name) {
  static void* const library = dlopen(CAROM_OWN_EGL, RTLD_LAZY | RTLD_LOCAL);
  return reinterpret_cast<Function*>(dlsym(library, name));
}

}  // namespace

extern "C" {

EGLDisplay eglGetPlatformDisplay(EGLenum platform, void* native, const EGLAttrib* attributes) {
  if (platform == EGL_PLATFORM_SURFACELESS_MESA) return EGL_NO_DISPLAY;
  return own<EGLDisplay(EGLenum, void*, const EGLAttrib*)>("eglGetPlatformDisplay")(platform, native,
                                                                                    attributes);
}

#define CAROM_FORWARD(result, name, parameters, arguments) \
  result name parameters {                                 \
    return own<result parameters>(#name) arguments;        \
  }
CAROM_FORWARD(__eglMustCastToProperFunctionPointerType, eglGetProcAddress, (const char* name), (name))
CAROM_FORWARD(EGLBoolean, eglInitialize, (EGLDisplay display, EGLint* major, EGLint* minor),
              (display, major, minor))
CAROM_FORWARD(const char*, eglQueryString, (EGLDisplay display, EGLint name), (display, name))
CAROM_FORWARD(EGLBoolean, eglBindAPI, (EGLenum api), (api))
CAROM_FORWARD(EGLBoolean, eglChooseConfig,
              (EGLDisplay display, const EGLint* wanted, EGLConfig* configs, EGLint size, EGLint* count),
              (display, wanted, configs, size, count))
CAROM_FORWARD(EGLContext, eglCreateContext,
              (EGLDisplay display, EGLConfig config, EGLContext shared, const EGLint* wanted),
              (display, config, shared, wanted))
CAROM_FORWARD(EGLBoolean, eglDestroyContext, (EGLDisplay display, EGLContext context), (display, context))
CAROM_FORWARD(EGLContext, eglGetCurrentContext, (), ())
CAROM_FORWARD(EGLBoolean, eglMakeCurrent,
              (EGLDisplay display, EGLSurface drawn, EGLSurface read, EGLContext context),
              (display, drawn, read, context))
#undef CAROM_FORWARD

}  // extern "C"
