#pragma once
// Opens a library that makes GL contexts. It stays open: Mesa's threads and exit handlers live in it. Tested
// in tests/demos/program/gl_choice_program_test.cpp and limits_program_test.cpp.

#include <string>

namespace carom::renderer {

/// The library of that name, e.g. "libEGL.so.1". Throws NoRenderer where there is none, std::system_error
/// where the system refuses the memory or the descriptor that opening it takes.
void* openLibrary(const std::string& name);

}  // namespace carom::renderer
