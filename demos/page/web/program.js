// Shader programs from the texts that the page holds.

const shaderText = name => document.getElementById("glsl-" + name).textContent;

/** A linked program of two shaders with lines in front that choose a variant. */
export function linked(gl, vertex, fragment, variants = []) {
  const head = "#version 300 es\n" + variants.map(name => `#define ${name}\n`).join("") + shaderText("common");
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, shaderText(vertex)],
                              [gl.FRAGMENT_SHADER, shaderText("light") + shaderText(fragment)]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, head + text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const block = gl.getUniformBlockIndex(program, "Frame");
  if (block !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, block, 0);
  gl.useProgram(program);
  const map = gl.getUniformLocation(program, "shadow_map");
  if (map) gl.uniform1i(map, 0);
  return program;
}
