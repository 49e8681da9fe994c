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
