out vec4 pixel;
void main() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
#if defined(CUTOUT)
  pixel = vec4(vec3(0.0), 1.0);
#elif defined(PRINT)
  pixel = vec4(1.0);
#else
  pixel = vec4(skyAt(ray.z * inversesqrt(dot(ray, ray))), 1.0);
#ifdef GLOW
  pixel.rgb += glowTowards(normalize(ray));
#endif
  pixel = encoded(pixel);
#endif
}
