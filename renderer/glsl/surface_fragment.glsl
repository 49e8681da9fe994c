flat in vec4 plane;
flat in float id;
layout(location = 0) out vec4 normal_and_depth;
layout(location = 1) out float number;
void main() {
  vec3 ray = ray_corner.xyz + gl_FragCoord.x * ray_x.xyz + gl_FragCoord.y * ray_y.xyz;
  normal_and_depth = vec4(plane.xyz, plane.w / dot(plane.xyz, ray));
  number = id;
}
