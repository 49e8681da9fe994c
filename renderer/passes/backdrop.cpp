#include "renderer/passes/backdrop.h"

#include <algorithm>
#include <cstring>
#include <sstream>

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
  const auto link = [&](const char* name, const char* vertex, const char* common, const char* fragment) {
    const char* lines = request_.variant.c_str();
    return linkProgram(gl_,
                       {name, {kGlslHead, lines, vertex}, {kGlslHead, lines, kGlslLight, common, fragment}});
  };
  sky_program_ = link("sky", kSkyVertex, "", kSkyFragment);
  open_ground_program_ = link("open ground", kGroundVertex, kGroundCommon, kGroundOpenFragment);
  shadowed_ground_program_ =
      link("shadowed ground", kGroundCellVertex, kGroundCommon, kGroundShadowedFragment);
  createTarget();
  gl_.GenVertexArrays(1, &no_attributes_);
  gl_.GenVertexArrays(1, &triangle_array_);
  gl_.GenBuffers(1, &triangle_buffer_);
  gl_.BindVertexArray(triangle_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, triangle_buffer_);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(0);
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
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    std::ostringstream message;
    message << "the GL driver has no room for a background of " << request_.width << "x" << request_.height;
    throw NoRenderer(message.str());
  }
}

void Backdrop::copyTo(GLuint target, const FrameBlock& block, bool with_ground,
                      std::span<const GridBlock> blocks) {
  const Shown wanted{withoutShadows(block), with_ground};
  const bool same = shown_ && shown_->with_ground == with_ground &&
                    std::memcmp(&shown_->block, &wanted.block, sizeof(FrameBlock)) == 0;
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  if (!same || request_.polished) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
    draw(with_ground);
    shown_ = wanted;
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  for (const GridBlock& b : blocks)
    gl_.BlitFramebuffer(b.x_begin, b.y_begin, b.x_end, b.y_end, b.x_begin, b.y_begin, b.x_end, b.y_end,
                        GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target);
}

void Backdrop::draw(bool with_ground) const {
  gl_.Viewport(0, 0, request_.width, request_.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_CULL_FACE);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.BindVertexArray(no_attributes_);
  if (with_ground) {
    gl_.UseProgram(open_ground_program_);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    for (int ring = 0; ring < kGroundRings; ++ring) gl_.DrawArrays(GL_TRIANGLE_STRIP, 4 + 10 * ring, 10);
  }
  gl_.DepthMask(GL_FALSE);
  gl_.UseProgram(sky_program_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

// Drawn a little nearer than the ground, which has its depths already.
void Backdrop::drawShadows(std::span<const GroundTriangle> triangles, std::span<const GridBlock> blocks) {
  if (triangles.empty()) return;
  gl_.BindVertexArray(triangle_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, triangle_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size_bytes()), triangles.data(),
                 GL_STREAM_DRAW);
  gl_.Disable(GL_CULL_FACE);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(0.0f, -8.0f);
  gl_.UseProgram(shadowed_ground_program_);
  gl_.Enable(GL_SCISSOR_TEST);
  for (const GridBlock& block : blocks) {
    setScissor(gl_, block);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles.size()));
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace carom::renderer
