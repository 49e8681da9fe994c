uniform sampler2DShadow shadow_map;

vec3 skyAt(float elevation) {
  float up = clamp(elevation, 0.0, 1.0);
  float rest = (1.0 - up) * (1.0 - up);
  float high = 1.0 - rest * rest;
  float low = clamp(-elevation * 2.0, 0.0, 1.0);
  return mix(mix(horizon.rgb, zenith.rgb, high), below.rgb, low);
}

// A tent of six texels each way, in nine fetches of four comparisons (Castano, The Witness, 2013).
float lit(vec3 s) {
  if (any(greaterThan(abs(s.xy - 0.5), vec2(0.497)))) return 1.0;
  float size = ray_x.w;
  float z = min(s.z, 1.0);
  vec2 base = floor(s.xy * size + 0.5);
  vec2 f = s.xy * size + 0.5 - base;
  base = (base - 0.5) / size;
  vec3 wx = vec3(4.0 - 3.0 * f.x, 7.0, 1.0 + 3.0 * f.x);
  vec3 wy = vec3(4.0 - 3.0 * f.y, 7.0, 1.0 + 3.0 * f.y);
  vec3 x = (vec3(3.0 - 2.0 * f.x, 3.0 + f.x, f.x) / wx + vec3(-2.0, 0.0, 2.0)) / size;
  vec3 y = (vec3(3.0 - 2.0 * f.y, 3.0 + f.y, f.y) / wy + vec3(-2.0, 0.0, 2.0)) / size;
  float sum = 0.0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      sum += wx[i] * wy[j] * texture(shadow_map, vec3(base + vec2(x[i], y[j]), z));
  return sum / 144.0;
}

// Checker of the world's xy, each pixel the exact mean over its footprint.
float checker(vec2 uv) {
  vec2 w = 1.2 * max(abs(dFdx(uv)), abs(dFdy(uv))) + 1e-5;
  vec2 a = abs(fract(0.5 * (uv - 0.5 * w)) - 0.5);
  vec2 b = abs(fract(0.5 * (uv + 0.5 * w)) - 0.5);
  vec2 mean = 2.0 * (a - b) / w;
  return 0.5 - 0.5 * mean.x * mean.y;
}

// A film's shoulder, then the air in between, bright as the horizon.
vec3 film(vec3 light, float distance_m) {
  vec3 image = light * inversesqrt(1.0 + light * light);
  float q = distance_m * ray_corner.w;
  return mix(horizon.rgb, image, exp(-q * q));
}

vec4 shown(vec3 light) {
#ifdef LINEAR
  return vec4(light, 1.0);
#else
  vec3 low = 12.92 * light;
  vec3 high = 1.055 * pow(max(light, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
  return vec4(mix(high, low, vec3(lessThan(light, vec3(0.0031308)))), 1.0);
#endif
}

vec3 rayAt(vec2 pixel) {
  return ray_corner.xyz + pixel.x * ray_x.xyz + pixel.y * ray_y.xyz;
}
