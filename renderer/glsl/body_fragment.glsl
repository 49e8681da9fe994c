in vec3 p_E;
in vec3 n_E;
flat in vec3 bend;
in float nearness;
#ifdef SUNLIT
flat in float sunlight;
#else
in vec3 shadow;
#endif
flat in vec4 albedo;
#ifdef PICTURES
in vec3 on_picture;
TEXTURE(4) uniform sampler2DArray pictures;
#endif
#ifdef SURFACE
in vec3 p_S;
in vec3 n_S;
flat in vec4 half_S;
#endif
out vec4 pixel;

// The mean of an edge's bevel over the pixel: a tent, 1 at the edge and 0 from its width on. Where it is narrower than a
// pixel, a single look would find it here and miss it there.
float halfTent(float x) { float a = min(abs(x), 1.0); return sign(x) * (a - 0.5 * a * a); }
float bevelShare() {
  float g = max(abs(dFdx(nearness)) + abs(dFdy(nearness)), 1e-3);
  float away = 1.0 - nearness;
  return (halfTent(away + 0.5 * g) - halfTent(away - 0.5 * g)) / g;
}

void main() {
#ifdef MIRROR
  if (p_E.z < ground.x) discard;
  vec3 from_eye = p_E - vec3(0.0, 0.0, 2.0 * ground.x);  // from below the ground, where the eye's image is
  float distance_m = length(from_eye);
  vec3 v = from_eye / -distance_m;
#else
  float distance_m = length(p_E);
  vec3 v = p_E / -distance_m;
#endif
  vec3 n = normalize(n_E + bevelShare() * bend);
  // What stands on the ground has no bevel there that anyone could look into; a pixel of it here and there would be black.
  float lifted = clamp(1.0 - (p_E.z - ground.x) / max(0.16 * abs(albedo.w), 1e-6), 0.0, 1.0);
  n = normalize(vec3(n.xy, n.z + lifted * max(-n.z, 0.0)));
  vec3 base = albedo.rgb;
#ifdef PICTURES
  vec3 pictured = texture(pictures, vec3(on_picture.xy, max(on_picture.z, 0.0))).rgb;
  if (on_picture.z > -0.5) base *= pictured;
#endif
#ifdef CHECKER
  if (albedo.w < 0.0 && n.z > 0.5) base = groundBase(p_E.xy, albedo.rgb);
#endif
#ifdef SURFACE
  vec3 across = dFdx(p_S), upwards = dFdy(p_S);
  // Between the longer way across the pixel and its mean: what is squeezed along one way still shows along the other.
  vec3 area = cross(across, upwards);
  float px = mix(sqrt(max(dot(across, across), dot(upwards, upwards))), sqrt(sqrt(dot(area, area))), 0.55);
  Finish finish = finishAt(p_S, n_S, half_S.xyz, px, base, half_S.w);
  base = finish.base;
#endif
  float towards = dot(n, to_light.xyz);
#ifdef SUNLIT
  float sun = towards > 0.0 ? sunlight : 0.0;
#else
  float sun = towards > 0.0 ? lit(shadow) : 0.0;
#endif

  float near_ground = clamp(1.0 - (p_E.z - ground.x) / max(abs(albedo.w), 1e-6), 0.0, 1.0);
  float open_below = 1.0 - 0.85 * near_ground * near_ground;
  vec3 around = mix(kGroundLight * open_below, kSkyLight, 0.5 + 0.5 * n.z);
  vec3 light = base * (kSun * (max(towards, 0.0) * sun) + around);

#ifdef SURFACE
  vec3 h = normalize(v + to_light.xyz);
  float nv = max(dot(n, v), 0.0);
  float grazing = 1.0 - nv;
  vec3 share = finish.reflected + finish.clear * grazing * grazing * grazing * grazing * grazing;
  vec3 r = 2.0 * dot(n, v) * n - v;
  float soft = 0.06 + 0.9 * finish.matte;
  float open = mix(1.0, open_below, clamp(0.5 - r.z, 0.0, 1.0));
  vec3 mirrored = surroundings(r, soft) * open;
  float glint = exp2(-finish.sharpness * (1.0 - max(dot(n, h), 0.0))) * finish.glint;
  light += kSun * sun * glint * max(share, vec3(0.3)) * step(0.0, towards) + share * mirrored;
#else
  // A thin coat of lacquer: the sun's glint and the sky's reflection, stronger at grazing angles.
  vec3 h = normalize(v + to_light.xyz);
  float nh = max(dot(n, h), 0.0);
  float nv = max(dot(n, v), 0.0);
  float grazing = 1.0 - nv;
  float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * grazing * grazing;
  float glint = exp2(-70.0 * (1.0 - nh)) * 0.42;
  float up = clamp(2.0 * nv * n.z - v.z, -1.0, 1.0);
  vec3 sky = mix(kHorizon, kZenith, max(up, 0.0));
  vec3 mirrored = mix(kGroundLight * open_below, sky, clamp(0.5 + 2.0 * up, 0.0, 1.0));
  light += kSun * (glint * sun) + fresnel * mirrored;
#endif
  light *= lightAt(p_E.xy);
  pixel = encoded(vec4(film(light, distance_m, -v), kOpaque));
}
