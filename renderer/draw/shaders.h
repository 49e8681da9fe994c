#pragma once
// The GLSL of all passes, and the block of values they share. Frame E: the world's axes, origin at the eye;
// light is linear until the sRGB framebuffer encodes it. Variants are chosen by lines between the head and
// the rest: PRINT (white surroundings), SMALL_SHADOWS (2x2 texels), MIRROR (bodies as the ground mirrors
// them), POLISHED (the ground shows what it mirrors), SUNLIT (faces that no other body can darken), CHECKER
// (bodies whose level faces are checker boards), PICTURES (surfaces with pictures of their own).

namespace carom::renderer {

/// Matches the GLSL block `Frame` below under std140.
struct FrameBlock {
  float clip_from_E[16];
  float shadow_rows[3][4];  ///< Texture u, v and depth of a point.
  float to_light[4];  ///< Unit; w: how far a point is lifted along its normal before its shadow is looked up.
  float ray_corner[4];  ///< Direction through the lower left corner of the image; w: 1 / fog distance.
  float ray_x[4];       ///< Added per pixel to the right; w: texels along a side of the shadow map.
  float ray_y[4];       ///< Added per pixel upwards.
  float ground[4];      ///< x: z of the ground; y: 1 / checker square; zw: the eye's xy in squares, modulo 2.
  float reach[4];       ///< x: half the side of the ground's innermost square.
  float mirror[4];      ///< xy: how mirrored things are sheared, over their height above the ground; zw: 1 /
                        ///< pixels.
};

inline constexpr const char* kGlslHead = R"(#version 420 core
layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_E;
  vec4 shadow_rows[3];
  vec4 to_light;
  vec4 ray_corner;
  vec4 ray_x;
  vec4 ray_y;
  vec4 ground;
  vec4 reach;
  vec4 mirror;
};
// Texture coordinates in the shadow map of a point with normal n, lifted out of the reach of its own shadow.
vec3 shadowCoordinates(vec3 p, vec3 n) {
  float towards = dot(n, to_light.xyz);
  float slope = sqrt(max(1.0 - towards * towards, 0.0));
  vec4 q = vec4(p + to_light.w * (0.2 + 0.8 * slope) * n, 1.0);
  return vec3(dot(shadow_rows[0], q), dot(shadow_rows[1], q), dot(shadow_rows[2], q));
}
)";

// What lights a scene: sun, sky and bounced light, the air in between, and the film.
inline constexpr const char* kGlslLight = R"(
layout(binding = 0) uniform sampler2DShadow shadow_map;
const vec3 kSun = vec3(1.76, 1.67, 1.53);
const vec3 kSkyLight = vec3(0.32, 0.365, 0.44);
const vec3 kGroundLight = vec3(0.10, 0.097, 0.095);

// The sky as it appears on the image.
const vec3 kHorizon = vec3(0.615, 0.665, 0.735);
const vec3 kZenith = vec3(0.24, 0.37, 0.59);
const vec3 kBelow = vec3(0.45, 0.47, 0.50);

vec3 skyAt(float elevation) {
  float up = clamp(elevation, 0.0, 1.0);
  float rest = (1.0 - up) * (1.0 - up);
  float high = 1.0 - rest * rest;
  float low = clamp(-elevation * 2.0, 0.0, 1.0);
  return mix(mix(kHorizon, kZenith, high), kBelow, low);
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
  vec4 q00 = textureGather(shadow_map, lower, z);
  vec4 q10 = textureGather(shadow_map, vec2(upper.x, lower.y), z);
  vec4 q01 = textureGather(shadow_map, vec2(lower.x, upper.y), z);
  vec4 q11 = textureGather(shadow_map, upper, z);
  vec4 rows = vec4(dot(wx, vec4(q00.wz, q10.wz)), dot(wx, vec4(q00.xy, q10.xy)),
                   dot(wx, vec4(q01.wz, q11.wz)), dot(wx, vec4(q01.xy, q11.xy)));
  return dot(wy, rows) / 16.0;
}
#endif

// Checker of the world's xy, each pixel the exact mean over its footprint.
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

// A film's shoulder: straight for dim light, never quite white. Then the air in between, bright as the horizon.
vec3 film(vec3 light, float distance_m) {
  vec3 image = light * inversesqrt(1.0 + light * light);
#ifdef PRINT
  return image;
#endif
  float q = distance_m * ray_corner.w;
  return mix(kHorizon, image, exp(-q * q));
}
)";

inline constexpr const char* kBodyVertex = R"(
layout(location = 0) in vec3 p_B;
layout(location = 1) in vec3 n_B;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec4 color;
layout(location = 6) in vec4 bend_and_nearness;
layout(location = 7) in uint face;
layout(location = 8) in uint faces;
layout(location = 9) in uint sunlit_faces;
layout(location = 10) in vec4 tint;
#ifdef PICTURES
layout(location = 15) in vec3 picture;
out vec3 on_picture;
#endif
out vec3 p_E;
out vec3 n_E;
flat out vec3 bend;
out float nearness;
#ifdef SUNLIT
flat out float sunlight;
#else
out vec3 shadow;
#endif
invariant gl_Position;
flat out vec4 albedo;
void main() {
  vec4 p = vec4(p_B, 1.0);
  p_E = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  n_E = vec3(dot(row0.xyz, n_B), dot(row1.xyz, n_B), dot(row2.xyz, n_B));
#ifdef SUNLIT
  sunlight = float(sunlit_faces >> face & 1u);
#else
  shadow = shadowCoordinates(p_E, n_E);
#endif
  bend = vec3(dot(row0.xyz, bend_and_nearness.xyz), dot(row1.xyz, bend_and_nearness.xyz),
              dot(row2.xyz, bend_and_nearness.xyz));
  nearness = bend_and_nearness.w;
  albedo = vec4(color.rgb * tint.rgb, color.w);
#ifdef PICTURES
  on_picture = picture;
#endif
#ifdef MIRROR
  float height = p_E.z - ground.x;
  gl_Position = clip_from_E * vec4(p_E.xy + height * mirror.xy, ground.x - height, 1.0);
#else
  gl_Position = clip_from_E * vec4(p_E, 1.0);
#endif
  if ((faces >> face & 1u) == 0u) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // Another draws this face.
}
)";

// albedo.w: the distance from the ground within which it is darkened by it; negative marks a checker board.
inline constexpr const char* kBodyFragment = R"(
in vec3 p_E;
in vec3 n_E;
flat in vec3 bend;
in float nearness;
#ifdef SUNLIT
flat in float sunlight;
#else
in vec3 shadow;
#endif
flat in vec4 albedo;
#ifdef PICTURES
in vec3 on_picture;
layout(binding = 3) uniform sampler2DArray pictures;
#endif
out vec4 pixel;
void main() {
#ifdef MIRROR
  if (p_E.z < ground.x) discard;
  vec3 from_eye = p_E - vec3(0.0, 0.0, 2.0 * ground.x);  // from below the ground, where the eye's image is
  float distance_m = length(from_eye);
  vec3 v = from_eye / -distance_m;
#else
  float distance_m = length(p_E);
  vec3 v = p_E / -distance_m;
#endif
  vec3 n = normalize(n_E + clamp(nearness, 0.0, 1.0) * bend);
  vec3 base = albedo.rgb;
#ifdef PICTURES
  vec3 pictured = texture(pictures, vec3(on_picture.xy, max(on_picture.z, 0.0))).rgb;
  if (on_picture.z > -0.5) base *= pictured;
#endif
#ifdef CHECKER
  if (albedo.w < 0.0 && n.z > 0.5)
    base = mix(kDarkSquare, kLightSquare, checker(p_E.xy * ground.y + ground.zw));
#endif
  float towards = dot(n, to_light.xyz);
#ifdef SUNLIT
  float sun = towards > 0.0 ? sunlight : 0.0;
#else
  float sun = towards > 0.0 ? lit(shadow) : 0.0;
#endif

  float near_ground = clamp(1.0 - (p_E.z - ground.x) / max(abs(albedo.w), 1e-6), 0.0, 1.0);
  float open_below = 1.0 - 0.85 * near_ground * near_ground;
  vec3 around = mix(kGroundLight * open_below, kSkyLight, 0.5 + 0.5 * n.z);
  vec3 light = base * (kSun * (max(towards, 0.0) * sun) + around);

  // A thin coat of lacquer: the sun's glint and the sky's reflection, stronger at grazing angles.
  vec3 h = normalize(v + to_light.xyz);
  float nh = max(dot(n, h), 0.0);
  float nv = max(dot(n, v), 0.0);
  float grazing = 1.0 - nv;
  float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * grazing * grazing;
  float glint = exp2(-70.0 * (1.0 - nh)) * 0.42;
  float up = clamp(2.0 * nv * n.z - v.z, -1.0, 1.0);
  vec3 sky = mix(kHorizon, kZenith, max(up, 0.0));
  vec3 mirrored = mix(kGroundLight * open_below, sky, clamp(0.5 + 2.0 * up, 0.0, 1.0));
  light += kSun * (glint * sun) + fresnel * mirrored;
  pixel = vec4(film(light, distance_m), 1.0);
}
)";

// Four vertices: the square around the point below the eye. Ten more: the ring from there to a square sixteen
// times as large, and so on to beyond the horizon. Rings share their corners to the bit, so that no gap
// shows; one square of that size would have depths of no precision near the eye.
inline constexpr int kGroundRings = 3;
inline constexpr const char* kGroundVertex = R"(
void main() {
  int rings = gl_VertexID < 4 ? 0 : (gl_VertexID - 4) / 10;
  int in_ring = (gl_VertexID - 4) % 10;
  int corner = gl_VertexID < 4 ? gl_VertexID ^ (gl_VertexID >> 1) : (in_ring >> 1) & 3;
  if (gl_VertexID >= 4) rings += in_ring & 1;
  vec2 p = vec2(((corner + 1) & 2) - 1, (corner & 2) - 1) * (reach.x * float(1 << (4 * rings)));
  gl_Position = clip_from_E * vec4(p, ground.x, 1.0);
}
)";

// The part of the ground where shadows may fall.
inline constexpr const char* kGroundCellVertex = R"(
layout(location = 0) in vec2 p_E;
void main() {
  gl_Position = clip_from_E * vec4(p_E, ground.x, 1.0);
}
)";

// The point is where the pixel's ray meets the plane: exact however far the plane reaches.
inline constexpr const char* kGroundCommon = R"(
out vec4 pixel;
vec3 groundPoint() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
  return ray * (ground.x / ray.z);
}
#ifdef POLISHED
layout(binding = 1) uniform sampler2D mirrored;
// Sky and bodies, as a coat of varnish mirrors them: more at grazing angles.
vec3 polished(vec3 image, vec3 p) {
  float nv = -p.z * inversesqrt(dot(p, p));
  float grazing = 1.0 - nv;
  float share = 0.16 + 0.5 * grazing * grazing * grazing * grazing * grazing;
  vec4 bodies = texture(mirrored, gl_FragCoord.xy * mirror.zw);
  return mix(image, mix(mix(image, skyAt(nv), 0.4), bodies.rgb, bodies.a), share);
}
#endif
vec4 groundPixel(vec3 p, float sun) {
  vec3 base = mix(kDarkSquare, kLightSquare, checker(p.xy * ground.y + ground.zw));
#ifdef PRINT
  // Paper: shadows and a trace of the squares, both gone before the horizon.
  float far = length(p) * ray_corner.w * 2.0;
  vec3 paper = (base + 0.2) * mix(vec3(0.52, 0.54, 0.58), vec3(1.0), max(to_light.z, 0.0) > 0.0 ? sun : 1.0);
  return vec4(mix(vec3(1.0), paper, exp(-far * far)), 1.0);
#endif
#ifdef POLISHED
  vec3 lit_ground = base * (kSun * (max(to_light.z, 0.0) * sun) + kSkyLight);
  vec3 image = polished(lit_ground * inversesqrt(1.0 + lit_ground * lit_ground), p);
  float q = length(p) * ray_corner.w;
  return vec4(mix(kHorizon, image, exp(-q * q)), 1.0);
#endif
  vec3 light = base * (kSun * (max(to_light.z, 0.0) * sun) + kSkyLight);
  return vec4(film(light, length(p)), 1.0);
}
)";
inline constexpr const char* kGroundShadowedFragment = R"(
void main() {
  vec3 p = groundPoint();
  pixel = groundPixel(p, lit(shadowCoordinates(p, vec3(0.0, 0.0, 1.0))));
}
)";
inline constexpr const char* kGroundOpenFragment = R"(
void main() {
  pixel = groundPixel(groundPoint(), 1.0);
}
)";

inline constexpr const char* kSkyVertex = R"(
void main() {
  gl_Position = vec4(vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1), 1.0, 1.0);
}
)";

inline constexpr const char* kSkyFragment = R"(
out vec4 pixel;
void main() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
#ifdef PRINT
  pixel = vec4(1.0);
#else
  pixel = vec4(skyAt(ray.z * inversesqrt(dot(ray, ray))), 1.0);
#endif
}
)";

// Surface images: the plane of the face, constant over it, meets the pixel's ray. Color's first component is
// the number to write.
inline constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 p_B;
layout(location = 1) in vec3 n_B;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec4 color;
flat out vec4 plane;
flat out float id;
void main() {
  vec4 p = vec4(p_B, 1.0);
  vec3 p_E = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  vec3 n_E = vec3(dot(row0.xyz, n_B), dot(row1.xyz, n_B), dot(row2.xyz, n_B));
  plane = vec4(n_E, dot(n_E, p_E));
  id = color.x;
  gl_Position = clip_from_E * vec4(p_E, 1.0);
}
)";
inline constexpr const char* kSurfaceFragment = R"(
flat in vec4 plane;
flat in float id;
layout(location = 0) out vec4 normal_and_depth;
layout(location = 1) out float number;
void main() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
  normal_and_depth = vec4(plane.xyz, plane.w / dot(plane.xyz, ray));
  number = id;
}
)";

inline constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 p_B;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
void main() {
  vec4 p = vec4(p_B, 1.0);
  vec3 p_E = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  gl_Position = vec4(2.0 * shadowCoordinates(p_E, vec3(0.0)) - 1.0, 1.0);
}
)";

inline constexpr const char* kShadowFragment = R"(
void main() {}
)";

inline constexpr const char* kOcclusionVertex = R"(
layout(location = 0) in vec3 p_E;
layout(location = 1) in vec3 p_R_in;
layout(location = 2) in vec3 n_R_in;
layout(location = 3) in vec3 half_in;
layout(location = 4) in vec3 radius_reach_strength;
out vec3 p_R;
out float strength;
flat out vec3 n_R;
flat out vec3 half_R;
flat out vec2 fall;  // Nearness is the first less the second times the distance from the box.
void main() {
  p_R = p_R_in;
  n_R = n_R_in;
  half_R = half_in;
  fall = vec2(radius_reach_strength.x + radius_reach_strength.y, 1.0) / radius_reach_strength.y;
  float q = length(p_E) * ray_corner.w;
  strength = radius_reach_strength.z * exp(-q * q);
  gl_Position = clip_from_E * vec4(p_E, 1.0);
}
)";

// Darkens by nearness, most where the near surface lies straight above the face and half as much where it
// stands on it. What is left of the light is multiplied into sRGB's bytes, nearly its 2.2th root: the cubic
// is within 0.001 of that for the losses that occur.
inline constexpr const char* kOcclusionFragment = R"(
in vec3 p_R;
in float strength;
flat in vec3 n_R;
flat in vec3 half_R;
flat in vec2 fall;
out vec4 pixel;
void main() {
  vec3 out_of_box = p_R - clamp(p_R, -half_R, half_R);
  float square = max(dot(out_of_box, out_of_box), 1e-12);
  float inverse = inversesqrt(square);
  float nearness = clamp(fall.x - fall.y * square * inverse, 0.0, 1.0);
  float above = clamp(-dot(out_of_box, n_R) * inverse, 0.0, 1.0);
  float lost = strength * (0.5 + 0.5 * above) * nearness * nearness;
  pixel = vec4(vec3(1.0 - lost * (0.4545 + lost * (0.102 + lost * 0.145))), 1.0);
}
)";

}  // namespace carom::renderer
