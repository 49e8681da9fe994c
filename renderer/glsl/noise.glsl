// Values of a lattice of whole numbers, in [0, 1], the same on every machine: multiplications and shifts after Wellons'
// search for integer hashes (2018). Smooth noise between them, and its octaves, each faded out before a pixel shows more
// than it can hold, so that nothing shimmers far away.
const uvec3 kStride = uvec3(0x9E3779B1u, 0x85EBCA77u, 0xC2B2AE3Du);

uint scrambled(uint h) {
  h ^= h >> 16;
  h *= 0x21F0AAADu;
  h ^= h >> 15;
  return h * 0x735A2D97u;
}
float cellValue(ivec3 cell) {
  uvec3 u = uvec3(cell) * kStride;
  return float(scrambled(u.x ^ u.y ^ u.z) >> 8) * (1.0 / 16777216.0);
}
vec4 cornerValues(uvec4 u) {
  u ^= u >> 16;
  u *= 0x21F0AAADu;
  u ^= u >> 15;
  u *= 0x735A2D97u;
  return vec4(u >> 8) * (1.0 / 16777216.0);
}

// Within [-1, 1], features one unit wide.
float noise(vec3 p) {
  vec3 low = floor(p), f = p - low;
  f = f * f * (3.0 - 2.0 * f);
  uvec3 a = uvec3(ivec3(low)) * kStride, b = a + kStride;
  uvec4 xy = uvec4(a.x ^ a.y, b.x ^ a.y, a.x ^ b.y, b.x ^ b.y);
  vec4 z = mix(cornerValues(xy ^ a.z), cornerValues(xy ^ b.z), f.z);
  vec2 y = mix(z.xy, z.zw, f.y);
  return 2.0 * mix(y.x, y.y, f.x) - 1.0;
}

// The same of a plane, whose cells are counted from `first`.
float noise(vec2 p, ivec2 first) {
  vec2 low = floor(p), f = p - low;
  f = f * f * (3.0 - 2.0 * f);
  uvec2 a = uvec2(ivec2(low) + first) * kStride.xy, b = a + kStride.xy;
  vec4 corners = cornerValues(uvec4(a.x ^ a.y, b.x ^ a.y, a.x ^ b.y, b.x ^ b.y));
  vec2 y = mix(corners.xy, corners.zw, f.y);
  return 2.0 * mix(y.x, y.y, f.x) - 1.0;
}

// How much of what varies within one unit is left where a pixel covers `px` units.
float kept(float px) { return clamp(1.7 - 2.6 * px, 0.0, 1.0); }

// Octaves from features of one unit on, each half as wide and strong. The loop ends when none is left in any pixel of those
// that are drawn together. It is counted by the strength, since a compiler that knew the count would lay the octaves out
// one behind the other, and those that no pixel shows would cost as much as the others.
float octaves(vec3 p, float px, int count) {
  float sum = 0.0, strength = 0.5, last = exp2(-float(count));
  do {
    sum += px < 0.65 ? strength * kept(px) * noise(p) : 0.0;
    p = 2.0 * p + vec3(17.3, 5.1, 9.7);
    px *= 2.0;
    strength *= 0.5;
  } while (px < 0.65 && strength >= last);
  return sum;
}

// The share of [x - w/2, x + w/2] that lies within `gap` on either side of a whole number.
float lineShare(float x, float gap, float w) {
  vec2 ends = vec2(x - 0.5 * w, x + 0.5 * w);
  vec2 whole = floor(ends + 0.5);
  vec2 passed = 2.0 * gap * whole + clamp(ends - whole, -gap, gap);
  return (passed.y - passed.x) / w;
}
