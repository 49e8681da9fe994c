// Where a scene is drawn whose picture is needed before it is finished, by water and glass: several samples a pixel, and
// the textures that they become, colour and depth.

const SAMPLES = 4;

export class Offscreen {
  constructor(gl) {
    this.gl = gl;
    this.width = this.height = 0;
  }

  resize(width, height) {
    const { gl } = this;
    for (const old of [this.color, this.depth]) if (old) gl.deleteTexture(old);
    Object.assign(this, { width, height, color: gl.createTexture(), depth: gl.createTexture() });
    this.many ??= { target: gl.createFramebuffer(), color: gl.createRenderbuffer(), depth: gl.createRenderbuffer() };
    this.single ??= gl.createFramebuffer();
    for (const [unit, texture, format, filter] of [[gl.TEXTURE1, this.color, gl.SRGB8_ALPHA8, gl.LINEAR],
                                                   [gl.TEXTURE2, this.depth, gl.DEPTH_COMPONENT24, gl.NEAREST]]) {
      gl.activeTexture(unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, filter], [gl.TEXTURE_MAG_FILTER, filter],
                                   [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
        gl.texParameteri(gl.TEXTURE_2D, name, value);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.single);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.depth, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.many.target);
    for (const [buffer, format, place] of [[this.many.color, gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
                                           [this.many.depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, SAMPLES, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    }
  }

  /** From here on the scene is drawn into it. */
  begin(view) {
    if (view.width !== this.width || view.height !== this.height) this.resize(view.width, view.height);
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.many.target);
  }

  /** The textures hold what has been drawn so far; drawing goes on. */
  copy(parts) {
    const { gl, width, height } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.many.target);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.single);
    for (const part of parts) gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, part, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.many.target);
  }
}
