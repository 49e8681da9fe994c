in vec3 at_E;
in vec3 n_E;
in vec3 shadow;
flat in vec4 albedo;
flat in float body;
out vec4 pixel;

#ifdef SHADOW
void main() {}
#elif defined(ID)
void main() {
  int id = int(body + 0.5) + 1;
  pixel = vec4(float(id & 255), float((id >> 8) & 255), float(id >> 16), 255.0) / 255.0;
}
#elif defined(OUTLINE)
void main() {
  pixel = shown(vec3(1.0, 0.45, 0.05));
}
#else
void main() {
  float distance_m = length(at_E);
  vec3 v = at_E / -distance_m;
  vec3 n = normalize(n_E);
  if (!gl_FrontFacing) n = -n;
  float near_ground = ray_y.w * clamp(1.0 - (at_E.z - ground.x) / max(abs(albedo.w), 1e-6), 0.0, 1.0);
  // Of what faces the ground beside it only bevels are seen, which would draw a dark line there.
  n = normalize(vec3(n.xy, mix(n.z, max(n.z, 0.0), near_ground) + 1e-4));
  vec3 base = albedo.rgb;
  if (albedo.w < 0.0 && n.z > 0.5)
    base = mix(dark_square.rgb, light_square.rgb, checker(at_E.xy * ground.y + ground.zw));
  float towards = dot(n, to_light.xyz);
  float sunlit = towards > 0.0 ? lit(shadow) : 0.0;

  float open_below = 1.0 - 0.85 * near_ground * near_ground;
  vec3 around = mix(ground_light.rgb * open_below, sky_light.rgb, 0.5 + 0.5 * n.z);
  vec3 light = base * (sun.rgb * (max(towards, 0.0) * sunlit) + around);

  // A thin coat of lacquer: the sun's glint and the sky's reflection, stronger at grazing angles.
  vec3 h = normalize(v + to_light.xyz);
  float nh = max(dot(n, h), 0.0);
  float nv = max(dot(n, v), 0.0);
  float grazing = 1.0 - nv;
  float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * grazing * grazing;
  float glint = exp2(-70.0 * (1.0 - nh)) * 0.42;
  float up = clamp(2.0 * nv * n.z - v.z, -1.0, 1.0);
  vec3 sky = mix(horizon.rgb, zenith.rgb, max(up, 0.0));
  vec3 mirrored = mix(ground_light.rgb * open_below, sky, clamp(0.5 + 2.0 * up, 0.0, 1.0));
  light += sun.rgb * (glint * sunlit) + fresnel * mirrored;
  pixel = shown(film(light, distance_m));
}
#endif
