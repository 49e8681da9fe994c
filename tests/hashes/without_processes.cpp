// answerOfProcess for WebAssembly, which has no processes: a module cannot reach beyond its own memory, so
// the work is done in it.
#include "demos/system/bounded_process.h"

namespace carom::demos {

ProcessAnswer answerOfProcess(const std::function<std::vector<std::uint8_t>()>& work, const ProcessBounds&) {
  return {work(), ""};
}

}  // namespace carom::demos
