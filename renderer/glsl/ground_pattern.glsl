// What level grounds show, over the world's xy in squares: of 1 m, or of the power of ten metres that suits the camera's
// distance. Each pixel is the mean over its footprint, or as near to it as noise allows. `tint` is the pattern's mean
// colour; a checker board has its own. GROUND_GRID and its like choose.
float checker(vec2 uv) {
  vec2 w = 1.2 * max(abs(dFdx(uv)), abs(dFdy(uv))) + 1e-5;
  vec2 a = abs(fract(0.5 * (uv - 0.5 * w)) - 0.5);
  vec2 b = abs(fract(0.5 * (uv + 0.5 * w)) - 0.5);
  vec2 mean = 2.0 * (a - b) / w;
  return 0.5 - 0.5 * mean.x * mean.y;
}
#ifdef PRINT
const vec3 kLightSquare = vec3(0.80);
const vec3 kDarkSquare = vec3(0.70);
#else
const vec3 kLightSquare = vec3(0.52, 0.515, 0.50);
const vec3 kDarkSquare = vec3(0.305, 0.315, 0.34);
#endif

#ifdef GROUND_NOISE
// The squares are counted from the eye's own 64th, so that they have their full precision however far the eye is.
float groundOctaves(vec2 squares, float px, int first, int count) {
  float sum = 0.0, strength = 0.5, last = exp2(-float(count));
  int size = 1 << first;
  px *= float(size);
  do {  // As in `octaves`.
    float octave = noise(float(size) * squares, ivec2(origin.zw) * (64 * size) + 911 * size);
    sum += px < 0.65 ? strength * kept(px) * octave : 0.0;
    size *= 2;
    px *= 2.0;
    strength *= 0.5;
  } while (px < 0.65 && strength >= last);
  return sum;
}
float groundCell(ivec2 cell, int kind) { return cellValue(ivec3(cell, kind)); }
#endif

vec3 groundBase(vec2 p_E, vec3 tint) {
#if defined(GROUND_GRID) || defined(GROUND_NOISE)
  vec2 squares = p_E * ground.y + origin.xy;
  vec2 across = p_E * ground.y;
  vec2 dx = dFdx(across), dy = dFdy(across);
  vec2 w = abs(dx) + abs(dy) + 1e-5;
  // Between the longer and the shorter way across the pixel: what is squeezed along one of them still shows on the other.
  float along = sqrt(max(dot(dx, dx), dot(dy, dy))), px = mix(along, sqrt(abs(dx.x * dy.y - dx.y * dy.x)), 0.6);
#endif
#if defined(GROUND_GRID)
  vec2 fine = vec2(lineShare(squares.x, 0.012, w.x), lineShare(squares.y, 0.012, w.y));
  vec2 bold = vec2(lineShare(0.2 * squares.x, 0.0045, 0.2 * w.x), lineShare(0.2 * squares.y, 0.0045, 0.2 * w.y));
  float line = 1.0 - (1.0 - fine.x) * (1.0 - fine.y) * (1.0 - bold.x) * (1.0 - bold.y);
  return tint * mix(1.03, 0.52, line);
#elif defined(GROUND_CONCRETE)
  vec2 slab = 0.5 * squares;
  vec2 gap = vec2(lineShare(slab.x, 0.0045, 0.5 * w.x), lineShare(slab.y, 0.0045, 0.5 * w.y));
  float joint = 1.0 - (1.0 - gap.x) * (1.0 - gap.y);
  float tone = groundCell(ivec2(floor(slab)) + ivec2(origin.zw) * 32, 1) - 0.5;
  float clouds = groundOctaves(squares, px, 0, 5), sand = groundOctaves(squares, px, 6, 1);
  return tint * (1.0 + 0.16 * tone * kept(px) + 0.26 * clouds + 0.16 * sand) * (1.0 - 0.62 * joint);
#elif defined(GROUND_PLANKS)
  const vec2 kPlank = vec2(2.0, 0.2);  // A row of 64 squares holds whole planks.
  float row = floor(squares.y / kPlank.y);
  int number = int(row) + int(origin.w) * 320;
  float start = 16.0 * floor(8.0 * groundCell(ivec2(number, 5), 2)) / 64.0;
  float along_plank = (squares.x + start) / kPlank.x;
  vec2 gap = vec2(lineShare(along_plank, 0.0018, w.x / kPlank.x), lineShare(squares.y / kPlank.y, 0.020, w.y / kPlank.y));
  float joint = 1.0 - (1.0 - gap.x) * (1.0 - gap.y);
  ivec2 plank = ivec2(int(floor(along_plank)) + int(origin.z) * 32, number);
  float plain = kept(3.0 * px);
  float tone = groundCell(plank, 3) - 0.5, hue = groundCell(plank, 4) - 0.5;
  vec2 cut = vec2(squares.x, squares.y) + 37.0 * vec2(groundCell(plank, 6), groundCell(plank, 7));
  float bow = noise(vec3(0.9 * cut.x, 2.2 * cut.y, tone * 9.0));
  float rings = sin(46.0 * (cut.y + 0.05 * bow)) * kept(9.0 * w.y) * 0.5 + 0.5 * (noise(vec3(1.1 * cut.x, 30.0 * cut.y, 3.0)) * kept(30.0 * w.y));
  float fibre = noise(vec3(4.0 * cut.x, 110.0 * cut.y, 7.0)) * kept(110.0 * w.y);
  vec3 wood = tint * (1.0 + 0.36 * tone * plain + 0.10 * rings + 0.10 * fibre) * (1.0 + 0.10 * plain * hue * vec3(0.6, -0.2, -1.0));
  return wood * (1.0 - 0.68 * joint);
#elif defined(GROUND_SAND)
  float dunes = groundOctaves(squares, px, 0, 3);
  float sway = noise(0.7 * squares, ivec2(origin.zw) * 64);
  float ripple = sin(15.0 * (squares.y + 0.35 * squares.x + 0.32 * sway + 0.30 * dunes)) * kept(4.0 * px);
  float grain = groundOctaves(squares, px, 5, 2);
  return tint * (1.0 + 0.14 * dunes + 0.065 * ripple + 0.22 * grain);
#elif defined(GROUND_PLAIN)
  return tint;
#else
  return mix(kDarkSquare, kLightSquare, checker(p_E * ground.y + ground.zw));
#endif
}
