// A square around the point below the eye, and three rings around it, each sixteen times as large, to the horizon.
void main() {
  int rings = gl_VertexID < 4 ? 0 : (gl_VertexID - 4) / 10;
  int in_ring = (gl_VertexID - 4) % 10;
  int corner = gl_VertexID < 4 ? gl_VertexID ^ (gl_VertexID >> 1) : (in_ring >> 1) & 3;
  if (gl_VertexID >= 4) rings += in_ring & 1;
  vec2 p = vec2(float(((corner + 1) & 2) - 1), float((corner & 2) - 1)) * (reach.x * float(1 << (4 * rings)));
  gl_Position = clip_from_E * vec4(p, ground.x, 1.0);
}
