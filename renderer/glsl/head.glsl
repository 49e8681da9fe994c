// What all shaders share, here and on pages (demos/page/web): whoever draws puts a prologue before it, with the version
// and what differs (desktop.glsl says what). Frame E has the world's axes and its origin at the eye.
BLOCK(0) uniform Frame {
  mat4 clip_from_E;
  vec4 shadow_rows[3];
  vec4 to_light;
  vec4 ray_corner;
  vec4 ray_x;
  vec4 ray_y;
  vec4 ground;
  vec4 reach;
  vec4 mirror;
  vec4 origin;
  vec4 ground_color;
  vec4 pool;
};
// Texture coordinates in the shadow map of a point with normal n, lifted out of the reach of its own shadow.
vec3 shadowCoordinates(vec3 p, vec3 n) {
  float towards = dot(n, to_light.xyz);
  float slope = sqrt(max(1.0 - towards * towards, 0.0));
  vec4 q = vec4(p + to_light.w * (0.2 + 0.8 * slope) * n, 1.0);
  return vec3(dot(shadow_rows[0], q), dot(shadow_rows[1], q), dot(shadow_rows[2], q));
}
