// The commands that draw, in a program that is built with -DCAROM_RENDERER=OFF: they say so and end with 6.
// Built by the preset without-renderer, which .ci/run builds.
#include "demos/command/command.h"
#include "demos/command/renderer_examination.h"
#include "renderer/view/gl_backend.h"

namespace carom::demos {
namespace {

const std::string kNone = "this carom was built without its renderer (-DCAROM_RENDERER=OFF)";

}  // namespace

ExitCode render(const RenderOptions&) {
  throw renderer::NoRenderer(kNone);
}

ExitCode budget(const BudgetOptions&) {
  throw renderer::NoRenderer(kNone);
}

ExitCode figures(const FiguresOptions&) {
  throw renderer::NoRenderer(kNone);
}

ExitCode gallery(const GalleryOptions&) {
  throw renderer::NoRenderer(kNone);
}

void examineRenderer(const std::string& gl) {
  if (renderer::backendOf(gl) != renderer::GlBackend::kAuto) throw renderer::NoRenderer(kNone);
  tellFact("GL context", "none: " + kNone);
}

}  // namespace carom::demos
