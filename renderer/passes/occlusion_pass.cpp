#include "renderer/passes/occlusion_pass.h"

#include <cstddef>

#include "renderer/draw/shaders.h"
#include "renderer/gl/scissor.h"
#include "renderer/gl/shader_program.h"

namespace carom::renderer {

OcclusionPass::OcclusionPass(const GlFunctions& gl, const std::string& lines) : gl_(gl) {
  program_ = linkProgram(gl_, sourcesOf(Shader::kOcclusion, lines));
  gl_.GenBuffers(1, &vertex_buffer_);
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
  constexpr std::size_t kTriple = 3 * sizeof(float);  // Attributes are three floats each.
  static_assert(sizeof(OcclusionVertex) == 5 * kTriple);
  for (GLuint i = 0; i < 5; ++i) {
    gl_.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(OcclusionVertex),
                            reinterpret_cast<const void*>(kTriple * i));
    gl_.EnableVertexAttribArray(i);
  }
}

void OcclusionPass::draw(std::span<const BlockOcclusion> blocks) const {
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
  gl_.DepthMask(GL_FALSE);
  gl_.Disable(GL_CULL_FACE);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);  // Blending bytes is cheap; the shader accounts for their meaning.
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ZERO, GL_SRC_COLOR);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(-1.0f, -8.0f);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.UseProgram(program_);
  for (const auto& [block, triangles] : blocks) {
    if (triangles.empty()) continue;
    setScissor(gl_, block);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(OcclusionTriangle)),
                   triangles.data(), GL_STREAM_DRAW);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles.size()));
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace carom::renderer
