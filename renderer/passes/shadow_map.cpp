#include "renderer/passes/shadow_map.h"

#include "renderer/draw/shaders.h"
#include "renderer/gl/scissor.h"
#include "renderer/gl/shader_program.h"
#include "renderer/gl/texture_filter.h"

namespace carom::renderer {

ShadowMap::ShadowMap(const GlFunctions& gl, int texels) : gl_(gl), texels_(texels) {
  program_ = linkProgram(gl_, sourcesOf(Shader::kShadowMap));
  glass_program_ = linkProgram(gl_, sourcesOf(Shader::kShadowMap, "#define GLASS\n"));
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, texels_, texels_, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                 nullptr);
  readSmoothly(gl_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  gl_.DrawBuffer(GL_NONE);
  complete_ = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

// Of all casters the nearest to the sun is kept, in whatever order they are drawn.
void ShadowMap::draw(std::span<const BlockGroups> blocks, const SceneGeometry& geometry) const {
  if (blocks.empty()) return;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.Viewport(0, 0, texels_, texels_);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.Enable(GL_CULL_FACE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1.5f, 4.0f);
  for (const auto& [block, groups] : blocks) {
    setScissor(gl_, block);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    for (const DrawGroup& group : groups) {
      gl_.UseProgram(isGlass(group.look) ? glass_program_ : program_);
      geometry.draw(gl_, group.range, group.first, group.count);
    }
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_SCISSOR_TEST);
}

}  // namespace carom::renderer
