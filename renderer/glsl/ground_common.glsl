out vec4 pixel;
vec3 groundPoint() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
  return ray * (ground.x / ray.z);
}
#ifdef POLISHED
TEXTURE(1) uniform sampler2D mirrored;
// Sky and bodies, as a coat of varnish mirrors them: more at grazing angles.
vec3 polished(vec3 image, vec3 p) {
  float nv = -p.z * inversesqrt(dot(p, p));
  float grazing = 1.0 - nv;
  float share = 0.16 + 0.5 * grazing * grazing * grazing * grazing * grazing;
  vec4 bodies = texture(mirrored, gl_FragCoord.xy * mirror.zw);
  return mix(image, mix(mix(image, skyAt(nv), 0.4), bodies.rgb, bodies.a), share);
}
#endif
vec4 groundPixel(vec3 p, float sun) {
#ifdef CUTOUT
  // Nothing of the ground but its shadows, as bytes lose them: what is left of what is behind the picture.
  vec3 open = kExposure * (kSun * max(to_light.z, 0.0) + kSkyLight), shaded = kExposure * (kSun * (max(to_light.z, 0.0) * sun) + kSkyLight);
  float share = dot(shaded * inversesqrt(1.0 + 0.15 * shaded * shaded), vec3(1.0)) / dot(open * inversesqrt(1.0 + 0.15 * open * open), vec3(1.0));
  float far = length(p) * ray_corner.w;
  return vec4(vec3(0.0), mix(1.0, pow(share, 0.4545), exp(-far * far)));
#else
  vec3 base = groundBase(p.xy, ground_color.rgb);
#ifdef PRINT
  // Paper: shadows and a trace of the squares, both gone before the horizon.
  float far = length(p) * ray_corner.w * 2.0;
  vec3 paper = (base + 0.2) * mix(vec3(0.52, 0.54, 0.58), vec3(1.0), max(to_light.z, 0.0) > 0.0 ? sun : 1.0);
  return vec4(mix(vec3(1.0), paper, exp(-far * far)), 1.0);
#else
  vec3 light = base * (kSun * (max(to_light.z, 0.0) * sun) + kSkyLight) * lightAt(p.xy);
#ifdef POLISHED
  light *= kExposure;
  vec3 image = polished(light * inversesqrt(1.0 + light * light), p);
  float q = length(p) * ray_corner.w;
  return vec4(mix(kHorizon + glowTowards(normalize(p)), image, exp(-q * q)), 1.0);
#else
  return vec4(film(light, length(p), normalize(p)), 1.0);
#endif
#endif
#endif
}
