#include "renderer/passes/backdrop.h"

#include <algorithm>
#include <cstring>

#include "renderer/draw/shader_lines.h"
#include "renderer/draw/shaders.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/gl/scissor.h"
#include "renderer/gl/shader_program.h"

namespace carom::renderer {
namespace {

// The block without what only shadows and mirrored bodies need.
FrameBlock withoutShadows(FrameBlock block) {
  for (auto& row : block.shadow_rows) std::fill(std::begin(row), std::end(row), 0.0f);
  block.to_light[3] = 0.0f;
  return block;
}

}  // namespace

Backdrop::Backdrop(const GlFunctions& gl, const Request& request) : gl_(gl), request_(request) {
  sky_program_ = linkProgram(gl_, sourcesOf(Shader::kOpenSky, request_.variant));
  createTarget();
  gl_.GenVertexArrays(1, &no_attributes_);
  gl_.GenVertexArrays(1, &triangle_array_);
  gl_.GenBuffers(1, &triangle_buffer_);
  gl_.BindVertexArray(triangle_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, triangle_buffer_);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(0);
}

const Backdrop::GroundPrograms& Backdrop::groundPrograms(GroundPattern pattern) {
  GroundPrograms& programs = ground_programs_[static_cast<std::size_t>(pattern)];
  if (programs.open == 0) {
    const std::string lines = request_.variant + shaderLines(pattern);
    programs.open = linkProgram(gl_, sourcesOf(Shader::kOpenGround, lines));
    programs.shadowed = linkProgram(gl_, sourcesOf(Shader::kShadowedGround, lines));
  }
  return programs;
}

void Backdrop::createTarget() {
  GLuint buffers[2];
  gl_.GenRenderbuffers(2, buffers);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, request_.width, request_.height);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, request_.width, request_.height);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw NoImageMemory("backgrounds", request_.width, request_.height);
}

void Backdrop::copyTo(GLuint target, const FrameInputs& inputs, std::span<const GridBlock> blocks) {
  const Shown wanted{withoutShadows(inputs.block), inputs.ground_seen, inputs.ground_pattern};
  const bool same = shown_ && shown_->with_ground == wanted.with_ground &&
                    shown_->pattern == wanted.pattern &&
                    std::memcmp(&shown_->block, &wanted.block, sizeof(FrameBlock)) == 0;
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  if (!same || request_.polished) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
    draw(wanted);
    shown_ = wanted;
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  for (const GridBlock& b : blocks)
    gl_.BlitFramebuffer(b.x_begin, b.y_begin, b.x_end, b.y_end, b.x_begin, b.y_begin, b.x_end, b.y_end,
                        GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target);
}

void Backdrop::draw(const Shown& shown) {
  gl_.Viewport(0, 0, request_.width, request_.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_CULL_FACE);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.BindVertexArray(no_attributes_);
  if (shown.with_ground) {
    gl_.UseProgram(groundPrograms(shown.pattern).open);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    for (int ring = 0; ring < kGroundRings; ++ring) gl_.DrawArrays(GL_TRIANGLE_STRIP, 4 + 10 * ring, 10);
  }
  gl_.DepthMask(GL_FALSE);
  gl_.UseProgram(sky_program_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

// Drawn a little nearer than the ground, which has its depths already.
void Backdrop::drawShadows(const FrameInputs& inputs, std::span<const GridBlock> blocks) {
  const std::span<const GroundTriangle> triangles = inputs.ground_shadows;
  if (triangles.empty()) return;
  gl_.BindVertexArray(triangle_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, triangle_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size_bytes()), triangles.data(),
                 GL_STREAM_DRAW);
  gl_.Disable(GL_CULL_FACE);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(0.0f, -8.0f);
  gl_.UseProgram(groundPrograms(inputs.ground_pattern).shadowed);
  gl_.Enable(GL_SCISSOR_TEST);
  for (const GridBlock& block : blocks) {
    setScissor(gl_, block);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles.size()));
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace carom::renderer
