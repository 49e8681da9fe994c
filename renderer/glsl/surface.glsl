// Bodies with a surface: what it is made of at a point of the body. Coordinates are the body's own, in units of the
// surface's scale (metres where that is 1), with the longest side along z; `px` is how many units a pixel covers. `tint` is
// the surface's mean colour. SURFACE_WOOD and its like choose.
struct Finish {
  vec3 base;        // What it scatters of the light.
  vec3 reflected;   // What it mirrors of its surroundings, looked at straight.
  float clear;      // What it mirrors besides at grazing angles.
  float sharpness;  // Of the sun's glint.
  float glint;      // How bright the sun's glint is.
  float matte;      // How blurred its surroundings are in it: 0 a mirror.
};

// Where in the pattern a body lies: no two bodies of a scene look the same.
vec3 patternOffset(float seed) { return vec3(37.0, 71.0, 113.0) * fract(seed * vec3(1.0, 7.0, 53.0)) + 200.0; }

#ifdef SURFACE_WOOD
// A piece of a trunk along z: rings about a pith beside the body, pale early wood that darkens to the late wood's line, and
// fibres along the grain.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed);
  float turn = 6.2831853 * fract(seed * 13.0);
  vec2 pith = (0.25 + 0.55 * fract(seed * 29.0)) * vec2(cos(turn), sin(turn));
  vec2 across = p.xy - pith + 0.05 * p.z * vec2(fract(seed * 3.0) - 0.5, fract(seed * 5.0) - 0.5);
  across += 0.045 * vec2(noise(vec3(2.3 * p.xy, 0.5 * p.z) + o), noise(vec3(2.3 * p.xy, 0.5 * p.z) - o));
  float radius = length(across);
  float ring = 15.0 * radius + 0.9 * noise(vec3(0.0, 0.0, 6.0 * radius) + o) + 0.25 * noise(vec3(5.0 * p.xy, 1.2 * p.z) + o);
  float w = 15.0 * px;
  float s = fract(ring), late = smoothstep(0.25, 0.88, s) * (1.0 - smoothstep(0.93 - 0.5 * min(w, 0.6), 1.0, s));
  late = mix(0.42, late, kept(0.8 * w));
  float year = kept(w) * (cellValue(ivec3(int(floor(ring)), 3, 7)) - 0.5);
  float fibre = octaves(vec3(70.0 * p.xy, 2.5 * p.z) + o, 70.0 * px, 2);
  float pores = smoothstep(0.35, 0.8, noise(vec3(160.0 * p.xy, 5.0 * p.z) - o)) * kept(160.0 * px) * (0.35 + late);
  float tone = 1.13 - 0.40 * late + 0.14 * year + 0.16 * fibre - 0.25 * pores;
  vec3 base = tint * tone * mix(vec3(1.02, 1.0, 0.97), vec3(0.98, 0.94, 0.90), late);
  return Finish(base, vec3(0.04), 0.35, 45.0, 0.22 * (1.1 - 0.5 * late), 0.5);
}
#endif

#ifdef SURFACE_BRICK
// Stretcher bond on the faces of a box, courses level in the body's own frame: bricks of 240 x 71 mm, joints of 10 mm.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 facing = abs(n), wide = abs(dFdx(p)) + abs(dFdy(p)) + 1e-6;
  bool top = facing.z > max(facing.x, facing.y), side = facing.x > facing.y;
  vec2 uv = top ? p.xy : side ? p.yz : p.xz;
  vec2 w = top ? wide.xy : side ? wide.yz : wide.xz;
  const vec2 kPitch = vec2(0.25, 0.081);
  uv.y += top ? half_size.y : half_size.z;  // A whole course lies at the bottom.
  uv /= kPitch, w /= kPitch;
  float course = floor(uv.y);
  uv.x += 0.5 * mod(course, 2.0) + 0.25;
  float joint = lineShare(uv.x, 0.021, w.x), bed = lineShare(uv.y, 0.065, w.y);
  float mortar = 1.0 - (1.0 - joint) * (1.0 - bed);
  ivec3 brick = ivec3(int(floor(uv.x)), int(course), (top ? 1 : side ? 2 : 3) + int(1024.0 * seed));
  float plain = kept(0.7 * max(w.x, w.y));
  float tone = cellValue(brick) - 0.5, hue = cellValue(brick + 77) - 0.5;
  float burnt = smoothstep(0.8, 0.95, cellValue(brick - 31));
  float grain = octaves(28.0 * p + patternOffset(seed), 28.0 * px, 3);
  vec3 clay = tint * (1.0 + plain * (0.42 * tone - 0.35 * burnt) + 0.34 * grain) * (1.0 + plain * hue * vec3(0.10, -0.12, -0.22));
  vec3 lime = vec3(0.47, 0.45, 0.42) * (1.0 + 0.35 * grain);
  return Finish(mix(clay, lime, mortar), vec3(0.02), 0.05, 8.0, 0.03, 1.0);
}
#endif

#ifdef SURFACE_CONCRETE
// Cast in a mould: clouds, fine sand, and pores where air was.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed);
  float clouds = octaves(2.6 * p + o, 2.6 * px, 4);
  float sand = octaves(55.0 * p + o, 55.0 * px, 2);
  float pore = smoothstep(0.56, 0.70, noise(34.0 * p + o)) * kept(34.0 * px);
  float deep = smoothstep(0.66, 0.76, noise(17.0 * p - o)) * kept(17.0 * px);
  vec3 base = tint * (1.0 + 0.30 * clouds + 0.20 * sand) * (1.0 - 0.30 * pore) * (1.0 - 0.36 * deep);
  base *= 1.0 + 0.05 * clouds * vec3(1.0, 0.2, -1.0);
  return Finish(base, vec3(0.02), 0.08, 8.0, 0.035, 1.0);
}
#endif

#ifdef SURFACE_STEEL
// Brushed along z: fine streaks in what it mirrors, and in the glint across them.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed);
  float streaks = octaves(vec3(46.0 * p.xy, 1.1 * p.z) + o, 46.0 * px, 3);
  float smears = octaves(2.2 * p + o, 2.2 * px, 2);
  vec3 mirror = tint * (0.86 + 0.34 * streaks + 0.10 * smears);
  return Finish(0.05 * mirror, mirror, 0.25, 34.0 + 10.0 * streaks, 1.1, 0.16 + 0.06 * smears);
}
#endif

#ifdef SURFACE_RUBBER
// Dull and even, with the fine grain of a mould.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed);
  float grain = octaves(60.0 * p + o, 60.0 * px, 2);
  float dust = octaves(3.0 * p + o, 3.0 * px, 3);
  vec3 base = tint * (1.0 + 0.16 * grain) + vec3(0.012) * (1.0 + dust);
  return Finish(base, vec3(0.025), 0.16, 7.0, 0.10 + 0.05 * grain, 0.9);
}
#endif

#ifdef SURFACE_CARDBOARD
// Kraft paper over flutes that show through a little, scattered fibres, and a strip of tape around the longer way.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed), wide = abs(dFdx(p)) + abs(dFdy(p)) + 1e-6, facing = abs(n);
  float flutes = cos(6.2831853 * 26.0 * p.y) * kept(26.0 * px * 1.6) * (1.0 - facing.y);
  float fibre = octaves(48.0 * p + o, 48.0 * px, 3);
  float clouds = octaves(2.0 * p + o, 2.0 * px, 3);
  vec3 base = tint * (1.0 + 0.02 * flutes + 0.12 * fibre + 0.12 * clouds);
  float away = abs(p.y) - 0.14 * half_size.y;
  float tape = clamp(0.5 - away / wide.y, 0.0, 1.0) * smoothstep(0.6, 0.8, max(facing.x, facing.z));
  base = mix(base, tint * vec3(0.72, 0.66, 0.58) * (1.0 + 0.05 * clouds), 0.85 * tape);
  return Finish(base, vec3(0.02 + 0.03 * tape), 0.06 + 0.4 * tape, 8.0 + 60.0 * tape, 0.02 + 0.3 * tape, 1.0 - 0.7 * tape);
}
#endif

#ifdef SURFACE_MARBLE
// Veins where a warped field changes its sign, in two sizes, under a polish.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  vec3 o = patternOffset(seed);
  vec3 warp = vec3(octaves(1.7 * p + o, 1.7 * px, 3), octaves(1.7 * p - o.yzx, 1.7 * px, 3), octaves(1.7 * p + o.zxy, 1.7 * px, 3));
  vec3 q = p + 0.75 * warp;
  float bold = abs(noise(1.5 * vec3(1.0, 0.6, 1.0) * q + o)), fine = abs(noise(4.1 * q - o));
  float vein = exp2(-22.0 * bold) * kept(4.0 * px) + 0.15 * (1.0 - kept(4.0 * px));
  float thread = exp2(-26.0 * fine) * kept(13.0 * px) * smoothstep(-0.25, 0.5, warp.x + 0.2) + 0.06 * (1.0 - kept(13.0 * px));
  float clouds = warp.y;
  vec3 base = tint * (1.0 + 0.13 * clouds) * mix(vec3(1.0), vec3(0.30, 0.32, 0.36), clamp(0.95 * vein + 0.6 * thread, 0.0, 1.0));
  return Finish(base, vec3(0.05), 0.55, 140.0, 0.6, 0.08);
}
#endif

#ifdef SURFACE_GLASS
// As the ground mirrors it, and wherever nothing behind it is at hand: a pale body under a strong polish.
Finish finishAt(vec3 p, vec3 n, vec3 half_size, float px, vec3 tint, float seed) {
  return Finish(0.6 * tint, vec3(0.05), 0.8, 400.0, 1.0, 0.02);
}
#endif
