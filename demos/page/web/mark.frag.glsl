// A body's number as a colour (ID), or the colour of its outline.
flat in float body;
out vec4 pixel;
void main() {
#ifdef ID
  int id = int(body + 0.5) + 1;
  pixel = vec4(float(id & 255), float((id >> 8) & 255), float(id >> 16), 255.0) / 255.0;
#else
  pixel = encoded(vec4(1.0, 0.45, 0.05, 1.0));
#endif
}
