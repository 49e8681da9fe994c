// The part of the ground near a body, where it takes light of the sky away: its box's shadow straight down, widened.
layout(location = 3) in vec3 low;
layout(location = 4) in vec3 size;
layout(location = 5) in vec3 p_E;
layout(location = 6) in vec4 rotation;
layout(location = 8) in float number;  // a quarter over a whole number where the box stands for the body
out vec3 at_E;
out vec3 at_R;
flat out vec3 down_R;
flat out vec3 half_R;
flat out float reach_m;
void main() {
  half_R = 0.5 * size;
  reach_m = 0.9 * min(half_R.x, min(half_R.y, half_R.z)) + 0.1 * max(half_R.x, max(half_R.y, half_R.z));
  vec3 center = p_E + turned(rotation, low + half_R);
  vec3 x = turned(rotation, vec3(half_R.x, 0.0, 0.0)), y = turned(rotation, vec3(0.0, half_R.y, 0.0));
  vec3 z = turned(rotation, vec3(0.0, 0.0, half_R.z));
  vec2 extent = abs(x.xy) + abs(y.xy) + abs(z.xy) + reach_m;
  float lowest = center.z - abs(x.z) - abs(y.z) - abs(z.z) - ground.x;
  vec2 side = vec2(float((gl_VertexID & 1) * 2 - 1), float((gl_VertexID & 2) - 1));
  at_E = vec3(center.xy + side * extent, ground.x);
  vec4 back = vec4(rotation.x, -rotation.yzw);
  at_R = turned(back, at_E - center);
  down_R = turned(back, vec3(0.0, 0.0, -1.0));
  gl_Position = clip_from_E * vec4(at_E, 1.0);
  if (lowest > reach_m || lowest < -reach_m || fract(number) < 0.1) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
