// What lights a scene: sun, sky and bounced light, the air in between, and the film. Of linear light are kSun, kSkyLight
// and kGroundLight; kHorizon, kZenith and kBelow are the sky as it appears on the image (renderer/view/light.h).
TEXTURE(0) uniform sampler2DShadow shadow_map;

vec3 skyAt(float elevation) {
  float up = clamp(elevation, 0.0, 1.0);
  float rest = (1.0 - up) * (1.0 - up);
  float high = 1.0 - rest * rest;
  float low = clamp(-elevation * 2.0, 0.0, 1.0);
  return mix(mix(kHorizon, kZenith, high), kBelow, low);
}

// The sky's colour where it meets the ground, in that direction, and what the sun adds to it.
vec3 glowTowards(vec3 ray) {
#ifdef GLOW
  vec2 flat_ray = ray.xy * inversesqrt(dot(ray.xy, ray.xy) + 1e-8);
  vec2 flat_light = to_light.xy * inversesqrt(dot(to_light.xy, to_light.xy) + 1e-8);
  float azimuth = max(dot(flat_ray, flat_light), 0.0), above = max(ray.z, 0.0) - 0.1;
  float near = azimuth * azimuth * azimuth * exp2(-9.0 * above * above);
  float disc = dot(ray, to_light.xyz);
  return kGlow * near + kGlow * 1.5 * smoothstep(0.99955, 0.9998, disc);
#else
  return vec3(0.0);
#endif
}

// What a body mirrors of sky and ground in direction `r`; the horizon is as soft as the surface is matte.
vec3 surroundings(vec3 r, float soft) {
  vec3 lit_ground = 0.4 * kExposure * (kSun * max(to_light.z, 0.0) + kSkyLight);
  vec3 low = lit_ground * inversesqrt(1.0 + lit_ground * lit_ground);
  vec3 sky = skyAt(max(r.z, 0.0)) + glowTowards(r);
  float far = (r.z - 0.02) / (0.05 + soft);  // What stands low all around is darker than the sky behind it.
  return mix(low, sky, smoothstep(-soft, soft, r.z)) * (1.0 - 0.5 * exp2(-2.0 * far * far));
}

// The share of the light that reaches a place: all of it, or a pool about what the camera looks at.
float lightAt(vec2 p_E) {
#ifdef POOL
  vec2 away = (p_E - pool.xy) * pool.z;
  return exp2(-1.2 * dot(away, away));
#else
  return 1.0;
#endif
}

#ifdef SMALL_SHADOWS
float lit(vec3 s) {
  if (any(greaterThan(abs(s.xy - 0.5), vec2(0.497)))) return 1.0;
  return texture(shadow_map, vec3(s.xy, min(s.z, 1.0)));
}
#else
// Shadow softened by a tent of four texels each way: sixteen comparisons in four fetches.
float lit(vec3 s) {
  if (any(greaterThan(abs(s.xy - 0.5), vec2(0.497)))) return 1.0;
  float size = ray_x.w;
  vec2 t = s.xy * size - 0.5;
  vec2 b = floor(t);
  vec2 f = t - b;
  vec4 wx = vec4(1.0 - f.x, 2.0 - f.x, 1.0 + f.x, f.x);
  vec4 wy = vec4(1.0 - f.y, 2.0 - f.y, 1.0 + f.y, f.y);
  vec2 lower = b / size;
  vec2 upper = (b + 2.0) / size;
  float z = min(s.z, 1.0);  // beyond the last caster the empty map (depth 1) must not shade; float depths don't clamp
#ifdef GATHERLESS
  // The same weights: of each pair of neighbours the filter takes the mean that its place asks for.
  vec2 low = 3.0 - 2.0 * f, high = 1.0 + 2.0 * f;
  vec2 p = (b - 0.5 + (2.0 - f) / low) / size, q = (b + 1.5 + f / high) / size;
  return dot(vec4(low.x, high.x, low.x, high.x) * vec4(low.yy, high.yy),
             vec4(texture(shadow_map, vec3(p, z)), texture(shadow_map, vec3(q.x, p.y, z)),
                  texture(shadow_map, vec3(p.x, q.y, z)), texture(shadow_map, vec3(q, z)))) / 16.0;
#else
  vec4 q00 = textureGather(shadow_map, lower, z);
  vec4 q10 = textureGather(shadow_map, vec2(upper.x, lower.y), z);
  vec4 q01 = textureGather(shadow_map, vec2(lower.x, upper.y), z);
  vec4 q11 = textureGather(shadow_map, upper, z);
  vec4 rows = vec4(dot(wx, vec4(q00.wz, q10.wz)), dot(wx, vec4(q00.xy, q10.xy)),
                   dot(wx, vec4(q01.wz, q11.wz)), dot(wx, vec4(q01.xy, q11.xy)));
  return dot(wy, rows) / 16.0;
#endif
}
#endif

// A film's shoulder: straight for dim light, never quite white. Then the air in between, bright as the horizon.
// `ray` is where it is seen: unit.
vec3 film(vec3 light, float distance_m, vec3 ray) {
  light *= kExposure;
  vec3 image = light * inversesqrt(1.0 + light * light);
#if defined(PRINT) || defined(CUTOUT)
  return image;
#else
  float q = distance_m * ray_corner.w;
  return mix(kHorizon + glowTowards(ray), image, exp(-q * q));
#endif
}
