layout(std140, binding = 1) uniform Water {
  vec4 low;
  vec4 high;
  vec4 absorption;
  vec4 scattered;
  vec4 depth_range;
  vec4 waves[64];
};
layout(binding = 2) uniform sampler2D scene_depth;
layout(location = 0, index = 0) out vec4 added;
layout(location = 0, index = 1) out vec4 kept;
const float kEndless = 1e9;
const float kSunward = 0.9;  // How much lighter a wave's flank is that faces the sun.
const vec3 kFoam = vec3(0.86, 0.90, 0.92);
const vec3 kEdge = vec3(0.72, 0.80, 0.84);

#ifdef PRINT
const vec3 kAir = vec3(1.0);
vec3 mirroredSky(float elevation) { return vec3(0.93); }
float clearAir(float distance_m) {
  float q = 2.0 * distance_m * ray_corner.w;
  return exp(-q * q);
}
#else
const vec3 kAir = kHorizon;
vec3 mirroredSky(float elevation) { return skyAt(elevation); }
float clearAir(float distance_m) {
#ifdef CUTOUT
  return 1.0;
#endif
  float q = distance_m * ray_corner.w;
  return exp(-q * q);
}
#endif

// A parabola and its square, within 0.0011 of the sine: a fraction of what the built-in one costs here.
float sine(float x) {
  float turns = x * 0.15915494;
  turns -= floor(turns + 0.5);
  float u = 8.0 * turns - 16.0 * turns * abs(turns);
  return u + 0.225 * (u * abs(u) - u);
}

float surfaceHeight(vec2 p) {
  float height = high.z;
  for (int i = 0; i < int(low.w); ++i) height += waves[i].x * sine(dot(waves[i].yz, p) + waves[i].w);
  return height;
}

// Waves much shorter than what a pixel shows of the surface even out.
vec2 surfaceSlope(vec2 p, float footprint_m) {
  vec2 slope = vec2(0.0);
  for (int i = 0; i < int(low.w); ++i) {
    float turn = 0.5 * footprint_m * length(waves[i].yz);
    slope += waves[i].x * exp(-turn * turn) * sine(dot(waves[i].yz, p) + waves[i].w + 1.5707963) * waves[i].yz;
  }
  return slope;
}

float above(vec3 p) { return p.z - surfaceHeight(p.xy); }

// Where the height above the waves changes sign between `from` and `to`, the first that 16 looks find, or
// `to`. A ray steeper than the waves meets them once. The loops' bounds stand for conditions: llvmpipe
// leaves a loop when no pixel of a block wants more of it, but runs through every branch.
float crossing(vec3 ray, float from, float to, float tolerance) {
  float at_from = above(ray * from);
  float a = from, fa = at_from, b = to, fb = above(ray * to);
  bool steep = abs(ray.z) > absorption.w * length(ray.xy);
  float last = from, at_last = at_from;
  bool found = false;
  for (int i = 1; i <= (steep || found ? 0 : 16); ++i) {
    float s = from + (to - from) * (float(i) / 16.0);
    float at_s = above(ray * s);
    found = at_last * at_s <= 0.0;
    if (found) a = last, fa = at_last, b = s, fb = at_s;
    last = s, at_last = at_s;
  }
  if (fa * fb > 0.0) return to;
  // Regula falsi after Illinois: the end that stays counts half.
  for (int i = 0; i < (abs(fb) > tolerance ? 6 : 0); ++i) {
    float s = b - fb * (b - a) / (abs(fb - fa) > 1e-20 ? fb - fa : 1e-20);
    float at_s = above(ray * s);
    if (at_s * fb <= 0.0) a = b, fa = fb; else fa *= 0.5;
    b = s, fb = at_s;
  }
  return b;
}

// The part of a ray that runs through water, and how it gets in.
struct Passage {
  float from;
  float to;
  vec3 normal;  // Of the water where the ray enters; zero where the eye is in it.
};

Passage passageOf(vec3 ray, float pixel_rad) {
  vec3 inverse = 1.0 / (ray + vec3(equal(ray, vec3(0.0))) * 1e-9);
  vec3 top = vec3(high.xy, high.z + high.w);
  vec3 near3 = min(low.xyz * inverse, top * inverse), far3 = max(low.xyz * inverse, top * inverse);
  float side = max(near3.x, near3.y);
  float from = max(max(side, near3.z), 0.0), to = min(min(far3.x, far3.y), far3.z);
  Passage passage = Passage(from, to, vec3(0.0));
  bool from_above = ray.z < 0.0 && near3.z >= side && near3.z > 0.0;
  for (int i = 0; i < (high.w > 0.0 && from < to ? 1 : 0); ++i) {
    bool dry = above(ray * from) > 0.0;
    float lowest = ray.z < 0.0 ? (high.z - high.w) * inverse.z : to;  // Below, no wave reaches.
    float limit = dry ? clamp(lowest, from, to) : to;
    float s = crossing(ray, from, limit, 0.05 * pixel_rad * from);
    from_above = dry;
    if (dry) passage.from = s < limit || limit < to ? s : to; else passage.to = s;
  }
  if (from_above) {
    vec3 p = ray * passage.from;
    float footprint_m = pixel_rad * passage.from / max(-ray.z, 0.05);
    passage.normal = normalize(vec3(-surfaceSlope(p.xy, footprint_m), 1.0));
  } else if (passage.from > 0.0) {
    passage.normal = near3.z > side ? vec3(0.0, 0.0, -1.0)
                     : near3.x > near3.y ? vec3(-sign(ray.x), 0.0, 0.0) : vec3(0.0, -sign(ray.y), 0.0);
  }
  return passage;
}

// A line, some pixels wide, around where a solid's surface passes through the water's. A solid that lies
// level at the surface has none.
float foamLine(vec3 p, float pixel_m) {
  float height = above(p);
  float across = length(vec2(dFdx(height), dFdy(height))) / pixel_m;
  vec2 outside = max(max(low.xy - p.xy, p.xy - high.xy), 0.0);
  bool beside = max(outside.x, outside.y) <= 1.5 * pixel_m && p.z > low.z;
  float width_m = scattered.w * clamp(across, 0.05, 1.0) * pixel_m;
  float line = 1.0 - smoothstep(0.5, 1.5, abs(height) / width_m);
  return beside ? line * smoothstep(0.02, 0.15, across) : 0.0;
}

// The edges of a box of water, where a ray enters it: a line a pixel wide.
float boxEdge(vec3 p, bool on_top, float pixel_m) {
  float under = 0.0;
  for (int i = 0; i < (on_top ? 0 : 1); ++i) under = -above(p);
  vec3 inside = min(p - low.xyz, vec3(high.xy - p.xy, under));
  float lesser = min(inside.x, inside.y), greater = max(inside.x, inside.y);
  return 1.0 - smoothstep(0.4, 1.4, max(lesser, min(greater, inside.z)) / pixel_m);
}

void main() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
  float stretch = length(ray);
  float pixel_rad = length(ray_x.xyz);
  float stored = texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).x;
  float near = depth_range.x, far = depth_range.y;
  float solid = 2.0 * near * far / (far + near - (2.0 * stored - 1.0) * (far - near));
  bool open = stored >= 1.0;
  float foam = foamLine(ray * solid, pixel_rad * solid * stretch);
  if (open) solid = kEndless, foam = 0.0;

  Passage passage = passageOf(ray / stretch, pixel_rad);
  float from_m = passage.from, to_m = min(passage.to, solid * stretch);
  added = vec4(0.0);
  kept = vec4(1.0);
  float shown = 1.0;
  if (to_m > from_m) {
    vec3 v = ray / stretch;
    vec3 through = exp(-absorption.rgb * (to_m - from_m));
    float facing = clamp(-dot(v, passage.normal), 0.0, 1.0);
    float grazing = 1.0 - facing;
    bool outside = dot(passage.normal, passage.normal) > 0.0;
    float mirror = outside ? 0.02 + 0.88 * grazing * grazing * grazing * grazing * grazing : 0.0;
    float nh = outside ? max(dot(passage.normal, normalize(to_light.xyz - v)), 0.0) : 0.0;
    float leaning = dot(passage.normal, to_light.xyz) - to_light.z;
    float sunward = passage.normal.z > 0.0 ? 1.0 + kSunward * leaning : 1.0;
    vec3 image = scattered.rgb * (1.0 - through) * sunward;
    image = mix(image, mirroredSky(v.z + 2.0 * facing * passage.normal.z), mirror);
    vec3 glint = kSun * (1.4 * exp2(-500.0 * (1.0 - nh)));
    image += glint * inversesqrt(1.0 + glint * glint) * (1.0 - image);
    if (outside) image = mix(image, kEdge, 0.4 * boxEdge(v * from_m, passage.normal.z > 0.0, pixel_rad * from_m));
    float clear = clearAir(from_m);
    added.rgb = mix(kAir, image, clear);
    kept.rgb = through * ((1.0 - mirror) * clear);
    shown = dot(kept.rgb, vec3(0.2, 0.6, 0.2));
    if (outside) shown = mix(shown, 1.0, exp(-(to_m - from_m) / (20.0 * pixel_rad * solid * stretch)));
  }
#ifdef CUTOUT
  kept.a = dot(kept.rgb, vec3(1.0 / 3.0));
#endif
  foam *= 0.85 * shown * clearAir(solid * stretch);
  added.rgb = mix(added.rgb, kFoam, foam);
  kept.rgb *= 1.0 - foam;
#ifdef CUTOUT
  kept.a *= 1.0 - foam;
#endif
}
