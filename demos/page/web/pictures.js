// The pictures that bodies are covered with (demos/page/page_pictures.h): layers of one texture.

/** A byte by those to the left of it, above it and above that on the left. */
function foretold(left, above, corner) {
  const most = Math.max(left, above), least = Math.min(left, above);
  if (corner >= most) return least;
  return corner <= least ? most : left + above - corner;
}

/** Layers one below the other, four bytes a texel; null without any. */
export function readPictures(stream) {
  const layers = stream.whole();
  if (layers === 0) return null;
  const width = stream.whole(), height = stream.whole(), rows = layers * height, row = 4 * width;
  const texels = new Uint8Array(rows * row).fill(255);
  for (let y = 0, at = 0; y < rows; ++y)
    for (let x = 0; x < width; ++x, at += 4)
      for (let i = at; i < at + 3; ++i) {
        const left = x > 0 ? texels[i - 4] : 0, above = y > 0 ? texels[i - row] : 0;
        texels[i] = foretold(left, above, x > 0 && y > 0 ? texels[i - row - 4] : 0) + stream.byte();
      }
  return { layers, width, height, texels };
}

/** To the texture unit of the body shader's `pictures`. */
export function uploadPictures(gl, { layers, width, height, texels }) {
  const kind = gl.TEXTURE_2D_ARRAY, levels = 1 + Math.log2(Math.max(width, height));
  gl.activeTexture(gl.TEXTURE3);
  gl.bindTexture(kind, gl.createTexture());
  gl.texStorage3D(kind, levels, gl.SRGB8_ALPHA8, width, height, layers);
  gl.texSubImage3D(kind, 0, 0, 0, 0, width, height, layers, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  gl.generateMipmap(kind);
  for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                               [gl.TEXTURE_WRAP_S, gl.REPEAT], [gl.TEXTURE_WRAP_T, gl.REPEAT]])
    gl.texParameteri(kind, name, value);
  gl.activeTexture(gl.TEXTURE0);
}
