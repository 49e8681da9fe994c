#include "renderer/passes/glass_pass.h"

#include <utility>

#include "renderer/draw/shaders.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/shader_program.h"
#include "renderer/gl/texture_filter.h"

namespace carom::renderer {
namespace {

constexpr int kMostCopies = 12;  // Glass beyond sees none of the glass drawn since the last copy.

}  // namespace

GlassPass::GlassPass(const GlFunctions& gl, const Scene& scene, std::string lines)
    : gl_(gl), scene_(scene), lines_(std::move(lines)) {}

void GlassPass::create() {
  program_ = linkProgram(gl_, sourcesOf(Shader::kGlass, lines_));
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, scene_.width, scene_.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
  readSmoothly(gl_);
  gl_.GenFramebuffers(1, &copy_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, copy_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw NoImageMemory("images behind glass", scene_.width, scene_.height);
}

void GlassPass::copyScene() const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, scene_.target);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, copy_);
  gl_.BlitFramebuffer(0, 0, scene_.width, scene_.height, 0, 0, scene_.width, scene_.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, scene_.target);
}

void GlassPass::draw(std::span<const DrawGroup> groups, const SceneGeometry& geometry) {
  if (groups.empty()) return;
  gl_.ActiveTexture(GL_TEXTURE3);
  if (program_ == 0) create();
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_CULL_FACE);
  gl_.UseProgram(program_);
  int copies = 0;
  for (const DrawGroup& group : groups) {
    if (++copies <= kMostCopies) copyScene();
    geometry.draw(gl_, group.range, group.first, group.count);
  }
}

}  // namespace carom::renderer
