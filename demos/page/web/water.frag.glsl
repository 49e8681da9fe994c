// Water: each pixel's ray is followed through the volumes in closed form, or to the root of its height above the
// waves, as far as the depth buffer says it is open (renderer/glsl/water_fragment.glsl). The farthest volume comes first.
const int kVolumes = 4;
const int kWaves = 12;
uniform int volumes;
uniform vec4 low[kVolumes];         // w: number of waves
uniform vec4 high[kVolumes];        // z: the undisturbed level; w: how far waves raise or lower it
uniform vec4 absorption[kVolumes];  // w: the waves' greatest slope
uniform vec4 scattered[kVolumes];   // w: half the width of the foam line, pixels
uniform vec4 waves[kVolumes * kWaves];
uniform vec2 depth_range;
uniform sampler2D scene_color;
uniform highp sampler2D scene_depth;
out vec4 pixel;

const float kEndless = 1e9;
const float kSunward = 0.9;
const vec3 kFoam = vec3(0.86, 0.90, 0.92);
const vec3 kEdge = vec3(0.72, 0.80, 0.84);

float clearAir(float distance_m) {
  float q = distance_m * ray_corner.w;
  return exp(-q * q);
}

float surfaceHeight(int v, vec2 p) {
  float height = high[v].z;
  for (int i = 0; i < int(low[v].w); ++i) {
    vec4 wave = waves[v * kWaves + i];
    height += wave.x * sin(dot(wave.yz, p) + wave.w);
  }
  return height;
}

vec2 surfaceSlope(int v, vec2 p, float footprint_m) {
  vec2 slope = vec2(0.0);
  for (int i = 0; i < int(low[v].w); ++i) {
    vec4 wave = waves[v * kWaves + i];
    float turn = 0.5 * footprint_m * length(wave.yz);
    slope += wave.x * exp(-turn * turn) * cos(dot(wave.yz, p) + wave.w) * wave.yz;
  }
  return slope;
}

float above(int v, vec3 p) { return p.z - surfaceHeight(v, p.xy); }

// Where the height above the waves changes sign between `from` and `to`, the first that 16 looks find, or `to`.
float crossing(int v, vec3 ray, float from, float to) {
  float at_from = above(v, ray * from);
  float a = from, fa = at_from, b = to, fb = above(v, ray * to);
  if (abs(ray.z) <= absorption[v].w * length(ray.xy)) {
    float last = from, at_last = at_from;
    for (int i = 1; i <= 16; ++i) {
      float s = from + (to - from) * (float(i) / 16.0);
      float at_s = above(v, ray * s);
      if (at_last * at_s <= 0.0) {
        a = last, fa = at_last, b = s, fb = at_s;
        break;
      }
      last = s, at_last = at_s;
    }
  }
  if (fa * fb > 0.0) return to;
  for (int i = 0; i < 8; ++i) {  // regula falsi after Illinois
    float s = b - fb * (b - a) / (abs(fb - fa) > 1e-20 ? fb - fa : 1e-20);
    float at_s = above(v, ray * s);
    if (at_s * fb <= 0.0) a = b, fa = fb; else fa *= 0.5;
    b = s, fb = at_s;
  }
  return b;
}

struct Passage {
  float from;
  float to;
  vec3 normal;  // of the water where the ray enters; zero where the eye is in it
};

Passage passageOf(int v, vec3 ray, float pixel_rad) {
  vec3 inverse = 1.0 / (ray + vec3(equal(ray, vec3(0.0))) * 1e-9);
  vec3 top = vec3(high[v].xy, high[v].z + high[v].w);
  vec3 near3 = min(low[v].xyz * inverse, top * inverse), far3 = max(low[v].xyz * inverse, top * inverse);
  float side = max(near3.x, near3.y);
  float from = max(max(side, near3.z), 0.0), to = min(min(far3.x, far3.y), far3.z);
  Passage passage = Passage(from, to, vec3(0.0));
  bool from_above = ray.z < 0.0 && near3.z >= side && near3.z > 0.0;
  if (high[v].w > 0.0 && from < to) {
    bool dry = above(v, ray * from) > 0.0;
    float lowest = ray.z < 0.0 ? (high[v].z - high[v].w) * inverse.z : to;
    float limit = dry ? clamp(lowest, from, to) : to;
    float s = crossing(v, ray, from, limit);
    from_above = dry;
    if (dry) passage.from = s < limit || limit < to ? s : to; else passage.to = s;
  }
  if (from_above) {
    vec3 p = ray * passage.from;
    float footprint_m = pixel_rad * passage.from / max(-ray.z, 0.05);
    passage.normal = normalize(vec3(-surfaceSlope(v, p.xy, footprint_m), 1.0));
  } else if (passage.from > 0.0) {
    passage.normal = near3.z > side ? vec3(0.0, 0.0, -1.0)
                     : near3.x > near3.y ? vec3(-sign(ray.x), 0.0, 0.0) : vec3(0.0, -sign(ray.y), 0.0);
  }
  return passage;
}

float foamLine(int v, vec3 p, float pixel_m) {
  float height = above(v, p);
  float across = length(vec2(dFdx(height), dFdy(height))) / pixel_m;
  vec2 outside = max(max(low[v].xy - p.xy, p.xy - high[v].xy), 0.0);
  bool beside = max(outside.x, outside.y) <= 1.5 * pixel_m && p.z > low[v].z;
  float width_m = scattered[v].w * clamp(across, 0.05, 1.0) * pixel_m;
  float line = 1.0 - smoothstep(0.5, 1.5, abs(height) / width_m);
  return beside ? line * smoothstep(0.02, 0.15, across) : 0.0;
}

float boxEdge(int v, vec3 p, bool on_top, float pixel_m) {
  float under = on_top ? 0.0 : -above(v, p);
  vec3 inside = min(p - low[v].xyz, vec3(high[v].xy - p.xy, under));
  float lesser = min(inside.x, inside.y), greater = max(inside.x, inside.y);
  return 1.0 - smoothstep(0.4, 1.4, max(lesser, min(greater, inside.z)) / pixel_m);
}

vec3 through(int v, vec3 behind, vec3 ray, float solid, bool open) {
  float stretch = length(ray), pixel_rad = length(ray_x.xyz);
  float foam = open ? 0.0 : foamLine(v, ray * solid, pixel_rad * solid * stretch);
  Passage passage = passageOf(v, ray / stretch, pixel_rad);
  float from_m = passage.from, to_m = min(passage.to, solid * stretch), seen = 1.0;
  vec3 image = behind;
  if (to_m > from_m) {
    vec3 view = ray / stretch;
    vec3 passed = exp(-absorption[v].rgb * (to_m - from_m));
    float facing = clamp(-dot(view, passage.normal), 0.0, 1.0);
    float grazing = 1.0 - facing;
    bool outside = dot(passage.normal, passage.normal) > 0.0;
    float mirror = outside ? 0.02 + 0.88 * grazing * grazing * grazing * grazing * grazing : 0.0;
    float nh = outside ? max(dot(passage.normal, normalize(to_light.xyz - view)), 0.0) : 0.0;
    float leaning = dot(passage.normal, to_light.xyz) - to_light.z;
    float sunward = passage.normal.z > 0.0 ? 1.0 + kSunward * leaning : 1.0;
    vec3 water = scattered[v].rgb * (1.0 - passed) * sunward;
    water = mix(water, skyAt(view.z + 2.0 * facing * passage.normal.z), mirror);
    vec3 glint = kExposure * kSun * (1.4 * exp2(-500.0 * (1.0 - nh)));
    water += glint * inversesqrt(1.0 + glint * glint) * (1.0 - water);
    if (outside) water = mix(water, kEdge, 0.4 * boxEdge(v, view * from_m, passage.normal.z > 0.0, pixel_rad * from_m));
    float clear = clearAir(from_m);
    vec3 kept = passed * ((1.0 - mirror) * clear);
    image = mix(kHorizon, water, clear) + kept * behind;
    seen = dot(kept, vec3(0.2, 0.6, 0.2));
  }
  if (!open) foam *= 0.85 * seen * clearAir(solid * stretch);
  return mix(image, kFoam, foam);
}

void main() {
  vec3 ray = rayAt(gl_FragCoord.xy);
  ivec2 at = ivec2(gl_FragCoord.xy);
  float stored = texelFetch(scene_depth, at, 0).x;
  float near = depth_range.x, far = depth_range.y;
  bool open = stored >= 1.0;
  float solid = open ? kEndless : 2.0 * near * far / (far + near - (2.0 * stored - 1.0) * (far - near));
  vec3 image = texelFetch(scene_color, at, 0).rgb;
  for (int v = 0; v < volumes; ++v) image = through(v, image, ray, solid, open);
  pixel = encoded(vec4(image, 1.0));
}
