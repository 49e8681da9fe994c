// The part of the ground near a body, where it takes light of the sky away: its box's shadow straight down, widened; for
// the renderer's occlusion_fragment.glsl. Reach and strength are the renderer's (renderer/mesh/contact_occlusion.h).
layout(location = 3) in vec3 low;
layout(location = 4) in vec3 size;
layout(location = 5) in vec3 middle_E;
layout(location = 6) in vec4 rotation;
layout(location = 8) in float number;  // a quarter over a whole number where the box stands for the body
layout(location = 9) in vec4 finish;   // w: a ball
out vec3 p_R;
out float strength;
flat out vec3 n_R;
flat out vec3 half_R;
flat out vec2 fall;
void main() {
  vec3 half_box = 0.5 * size;
  float least = min(half_box.x, min(half_box.y, half_box.z)), reach_m = 1.3 * least;
  float radius = finish.w * least;
  half_R = half_box - vec3(radius);
  fall = vec2(radius + reach_m, 1.0) / reach_m;
  vec3 center = middle_E + turned(rotation, low + half_box);
  vec3 x = turned(rotation, vec3(half_box.x, 0.0, 0.0)), y = turned(rotation, vec3(0.0, half_box.y, 0.0));
  vec3 z = turned(rotation, vec3(0.0, 0.0, half_box.z));
  vec2 extent = abs(x.xy) + abs(y.xy) + abs(z.xy) + reach_m;
  float lowest = center.z - abs(x.z) - abs(y.z) - abs(z.z) - ground.x;
  vec2 side = vec2(float((gl_VertexID & 1) * 2 - 1), float((gl_VertexID & 2) - 1));
  vec3 p_E = vec3(center.xy + side * extent, ground.x);
  vec4 back = vec4(rotation.x, -rotation.yzw);
  p_R = turned(back, p_E - center);
  n_R = turned(back, vec3(0.0, 0.0, 1.0));
  float q = length(p_E) * ray_corner.w;
  strength = 0.62 * exp(-q * q);
  gl_Position = clip_from_E * vec4(p_E, 1.0);
  if (lowest > reach_m || lowest < -reach_m || fract(number) < 0.1) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
