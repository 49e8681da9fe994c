// Bodies: SHADOW (depths seen from the sun), ID (the body's number as a colour), OUTLINE (a little thicker).
layout(location = 0) in vec4 corner;      // 0 to 1 over the mesh's box
layout(location = 1) in vec2 folded;      // the normal on the unfolded octahedron
layout(location = 2) in vec4 tint;
layout(location = 3) in vec3 low;         // of each body: a corner of the mesh's box
layout(location = 4) in vec3 size;
layout(location = 5) in vec3 p_E;         // of each body: where it is
layout(location = 6) in vec4 rotation;
layout(location = 7) in vec4 color;       // of each body, linear; w: negative for a checker, else how near the ground darkens it
layout(location = 8) in float number;
out vec3 at_E;
out vec3 n_E;
out vec3 shadow;
flat out vec4 albedo;
flat out float body;

vec3 unfolded(vec2 f) {
  vec3 n = vec3(f, 1.0 - abs(f.x) - abs(f.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  n_E = turned(rotation, unfolded(folded * (32767.0 / 1023.0)));
  at_E = p_E + turned(rotation, low + corner.xyz * size);
  albedo = vec4(color.rgb * tint.rgb, color.w);
  body = number;
#ifdef SHADOW
  gl_Position = vec4(2.0 * shadowCoordinates(at_E, vec3(0.0)) - 1.0, 1.0);
#else
  shadow = shadowCoordinates(at_E, n_E);
#ifdef OUTLINE
  at_E += n_E * (reach.y * length(ray_x.xyz) * length(at_E));
#endif
  gl_Position = clip_from_E * vec4(at_E, 1.0);
#endif
}
