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
#ifdef SURFACE
layout(location = 11) in vec4 finish;     // Of the coordinates: 1 / scale, the axis of the body that is z; the body's number in [0, 1).
layout(location = 12) in vec4 half_size;  // In the body's own frame.
out vec3 p_S;
out vec3 n_S;
#ifdef GLASS
flat out vec3 eye_S;      // The eye.
flat out vec3 rows_S[3];  // The rotation from S into E.
flat out float is_ball;
#endif
flat out vec4 half_S;  // w: the body's number.
vec3 alongLongest(vec3 v) { return finish.y < 0.5 ? v.yzx : finish.y < 1.5 ? v.zxy : v; }
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
#ifdef SURFACE
  p_S = finish.x * alongLongest(p_B);
  n_S = alongLongest(n_B);
  half_S = vec4(finish.x * alongLongest(half_size.xyz), finish.z);
#ifdef GLASS
  eye_S = -finish.x * alongLongest(row0.xyz * row0.w + row1.xyz * row1.w + row2.xyz * row2.w);
  rows_S[0] = alongLongest(row0.xyz) / finish.x;
  rows_S[1] = alongLongest(row1.xyz) / finish.x;
  rows_S[2] = alongLongest(row2.xyz) / finish.x;
  is_ball = half_size.w;
#endif
#endif
#ifdef MIRROR
  float height = p_E.z - ground.x;
  gl_Position = clip_from_E * vec4(p_E.xy + height * mirror.xy, ground.x - height, 1.0);
#else
  gl_Position = clip_from_E * vec4(p_E, 1.0);
#endif
  if ((faces >> face & 1u) == 0u) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // Another draws this face.
}
