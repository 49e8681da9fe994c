in vec3 at_E;
in vec3 at_R;
flat in vec3 down_R;
flat in vec3 half_R;
flat in float reach_m;
out vec4 pixel;
void main() {
  vec3 out_of_box = at_R - clamp(at_R, -half_R, half_R);
  float distance_m = max(length(out_of_box), 1e-6);
  float nearness = clamp(1.0 - distance_m / reach_m, 0.0, 1.0);
  float above = clamp(dot(out_of_box, down_R) / distance_m, 0.0, 1.0);
  float q = length(at_E) * ray_corner.w;
  float lost = 0.55 * (0.5 + 0.5 * above) * nearness * nearness * exp(-q * q);
#ifdef LINEAR
  pixel = vec4(vec3(1.0 - lost), 1.0);
#else  // what is left of the light, as a factor of sRGB's numbers
  pixel = vec4(vec3(1.0 - lost * (0.4545 + lost * (0.102 + lost * 0.145))), 1.0);
#endif
}
