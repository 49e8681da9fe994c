#include "renderer/gl/gl_library.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <dlfcn.h>

#include "renderer/view/gl_backend.h"

namespace carom::renderer {

void* openLibrary(const std::string& name) {
  // Lazily: binding all of LLVM's functions takes longer than drawing a frame.
  if (void* library = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL)) return library;
  const char* told = dlerror();
  const std::string why = told == nullptr ? "" : told;
  for (const int refusal : {ENOMEM, EMFILE, ENFILE})
    if (why.find(std::strerror(refusal)) != std::string::npos)
      throw std::system_error(refusal, std::generic_category(), name);
  // glibc gives no reason where a part of the file finds no room.
  if (why.find("failed to map segment") != std::string::npos)
    throw std::system_error(ENOMEM, std::generic_category(), name);
  throw NoRenderer("there is no " + name + " here");
}

}  // namespace carom::renderer
