// Bodies, as the renderer's body_vertex.glsl from a page's packed numbers. SHADOW (depths seen from the sun), OUTLINE (a
// little thicker), PICTURES, SURFACE and GLASS as there.
layout(location = 0) in vec4 corner;      // 0 to 1 over the mesh's box
layout(location = 1) in vec2 folded;      // the normal on the unfolded octahedron
layout(location = 2) in vec4 tint;
layout(location = 3) in vec3 low;         // of each body: a corner of the mesh's box
layout(location = 4) in vec3 size;
layout(location = 5) in vec3 middle_E;    // of each body: where it is
layout(location = 6) in vec4 rotation;
layout(location = 7) in vec4 color;       // of each body, linear; w: negative for a checker, else how near the ground darkens it
layout(location = 8) in float number;
layout(location = 9) in vec4 finish;      // 1 / scale, the axis of the body that is z, its number in [0, 1); w: a ball
#ifdef PICTURES
layout(location = 10) in vec3 picture;
out vec3 on_picture;
#endif
out vec3 p_E;
out vec3 n_E;
flat out vec3 bend;  // Bevels are in the mesh.
out float nearness;
out vec3 shadow;
flat out vec4 albedo;
flat out float body;
#ifdef SURFACE
out vec3 p_S;
out vec3 n_S;
flat out vec4 half_S;
#ifdef GLASS
flat out vec3 eye_S;
flat out vec3 rows_S[3];
flat out float is_ball;
#endif
vec3 alongLongest(vec3 v) { return finish.y < 0.5 ? v.yzx : finish.y < 1.5 ? v.zxy : v; }
#endif

vec3 unfolded(vec2 f) {
  vec3 n = vec3(f, 1.0 - abs(f.x) - abs(f.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  vec3 p_B = low + corner.xyz * size, n_B = unfolded(folded * (32767.0 / 1023.0));
  n_E = turned(rotation, n_B);
  p_E = middle_E + turned(rotation, p_B);
  bend = vec3(0.0);
  nearness = 0.0;
  albedo = vec4(color.rgb * tint.rgb, color.w);
  body = number;
#ifdef PICTURES
  on_picture = picture;
#endif
#ifdef SURFACE
  p_S = finish.x * alongLongest(p_B);
  n_S = alongLongest(n_B);
  half_S = vec4(0.5 * finish.x * alongLongest(size), finish.z);
#ifdef GLASS
  vec4 back = vec4(rotation.x, -rotation.yzw);
  eye_S = -finish.x * alongLongest(turned(back, middle_E));
  rows_S[0] = alongLongest(turned(back, vec3(1.0, 0.0, 0.0))) / finish.x;
  rows_S[1] = alongLongest(turned(back, vec3(0.0, 1.0, 0.0))) / finish.x;
  rows_S[2] = alongLongest(turned(back, vec3(0.0, 0.0, 1.0))) / finish.x;
  is_ball = finish.w;
#endif
#endif
#ifdef SHADOW
  gl_Position = vec4(2.0 * shadowCoordinates(p_E, vec3(0.0)) - 1.0, 1.0);
#else
  shadow = shadowCoordinates(p_E, n_E);
#ifdef OUTLINE
  p_E += n_E * (reach.y * length(ray_x.xyz) * length(p_E));
#endif
  gl_Position = clip_from_E * vec4(p_E, 1.0);
#endif
}
