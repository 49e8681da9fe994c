layout(location = 0) in vec3 p_B;
layout(location = 1) in vec3 n_B;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec4 color;
flat out vec4 plane;
flat out float id;
void main() {
  vec4 p = vec4(p_B, 1.0);
  vec3 p_E = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  vec3 n_E = vec3(dot(row0.xyz, n_B), dot(row1.xyz, n_B), dot(row2.xyz, n_B));
  plane = vec4(n_E, dot(n_E, p_E));
  id = color.x;
  gl_Position = clip_from_E * vec4(p_E, 1.0);
}
