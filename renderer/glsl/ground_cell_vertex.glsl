layout(location = 0) in vec2 p_E;
void main() {
  gl_Position = clip_from_E * vec4(p_E, ground.x, 1.0);
}
