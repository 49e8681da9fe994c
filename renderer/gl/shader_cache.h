#pragma once
// Where Mesa may keep the shaders it has compiled, which are most of the time to a first frame. It keys them
// by itself and its LLVM, but neither by processor nor by vector width: a home shared between machines could
// serve code that one of them cannot run. So every kind of processor has a folder of its own. Frames are the
// same with it and without. Tested in tests/renderer/gl/shader_cache_test.cpp and
// tests/demos/program/shader_cache_program_test.cpp.

#include <filesystem>
#include <istream>
#include <optional>
#include <string>

namespace carom::renderer {

/// What /proc/cpuinfo says of the first processor that decides which code it can run; empty when it says
/// nothing of that.
std::string processorKind(std::istream& cpuinfo);

/// $XDG_CACHE_HOME/carom/shaders-..., or else under $HOME/.cache, for this processor and for what the
/// environment tells Mesa about it. None without such a place, or when the processor is not known.
std::optional<std::filesystem::path> shaderCacheFolder();

}  // namespace carom::renderer
