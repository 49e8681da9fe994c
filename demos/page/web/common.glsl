// What the page's shaders share after the renderer's head.glsl. LINEAR: the target encodes by itself.
const float kOpaque = 1.0;

vec4 encoded(vec4 light) {
#ifdef LINEAR
  return light;
#else
  vec3 low = 12.92 * light.rgb;
  vec3 high = 1.055 * pow(max(light.rgb, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
  return vec4(mix(high, low, vec3(lessThan(light.rgb, vec3(0.0031308)))), light.a);
#endif
}

vec3 turned(vec4 q, vec3 v) {  // w first
  vec3 t = 2.0 * cross(q.yzw, v);
  return v + q.x * t + cross(q.yzw, t);
}

vec3 rayAt(vec2 pixel) {
  return ray_corner.xyz + pixel.x * ray_x.xyz + pixel.y * ray_y.xyz;
}
