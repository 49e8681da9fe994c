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
#ifdef LINEAR  // The blend is of light; else of bytes.
  float left = 1.0 - lost;
#else
  float left = 1.0 - lost * (0.4545 + lost * (0.102 + lost * 0.145));
#endif
#ifdef CUTOUT
  pixel = vec4(left);
#else
  pixel = vec4(vec3(left), 1.0);
#endif
}
