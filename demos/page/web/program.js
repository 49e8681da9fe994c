// Shader programs from the texts that the page holds: the renderer's own, and those that only a page needs.

const shaderText = name => document.getElementById("glsl-" + name).textContent;
const SHADING = ["light", "noise", "ground_pattern", "surface"];

/** A linked program of two shaders; `lines` give values and choose a variant, `shades`: the second one lights things. */
export function linked(gl, vertex, fragment, { lines = "", shades = true } = {}) {
  const head = "#version 300 es\n" + shaderText("prologue") + shaderText("head") + lines + shaderText("common");
  const program = gl.createProgram();
  const shading = shades ? SHADING.map(shaderText).join("") : "";
  for (const [kind, text] of [[gl.VERTEX_SHADER, shaderText(vertex)],
                              [gl.FRAGMENT_SHADER, shading + [fragment].flat().map(shaderText).join("")]]) {
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
  for (const [name, unit] of [["shadow_map", 0], ["scene_copy", 1], ["scene_color", 1], ["scene_depth", 2],
                              ["pictures", 3]]) {
    const place = gl.getUniformLocation(program, name);
    if (place) gl.uniform1i(place, unit);
  }
  return program;
}
