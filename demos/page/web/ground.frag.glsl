out vec4 pixel;
void main() {
  vec3 ray = rayAt(gl_FragCoord.xy);
  vec3 p = ray * (ground.x / ray.z);
  float sunlit = lit(shadowCoordinates(p, vec3(0.0, 0.0, 1.0)));
  vec3 base = mix(dark_square.rgb, light_square.rgb, checker(p.xy * ground.y + ground.zw));
  vec3 light = base * (sun.rgb * (max(to_light.z, 0.0) * sunlit) + sky_light.rgb);
  pixel = shown(film(light, length(p)));
}
