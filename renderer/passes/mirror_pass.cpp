#include "renderer/passes/mirror_pass.h"

#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/texture_filter.h"

namespace carom::renderer {

MirrorPass::MirrorPass(const GlFunctions& gl, BodyPrograms& programs, int width, int height)
    : gl_(gl), programs_(programs), width_((width + 1) / 2), height_((height + 1) / 2) {
  GLuint depth = 0;
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  readSmoothly(gl_);
  gl_.GenRenderbuffers(1, &depth);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, depth);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || gl_.GetError() != GL_NO_ERROR)
    throw NoImageMemory("mirrored images", width, height);
}

// The winding turns over in a mirror.
void MirrorPass::draw(std::span<const DrawGroup> groups, const SceneGeometry& geometry) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_CULL_FACE);
  gl_.FrontFace(GL_CW);
  for (const DrawGroup& group : groups) {
    gl_.UseProgram(programs_.mirrored(group.look));
    geometry.draw(gl_, group.range, group.first, group.count);
  }
  gl_.FrontFace(GL_CCW);
}

}  // namespace carom::renderer
