void main() {
  vec3 p = groundPoint();
  pixel = encoded(groundPixel(p, lit(shadowCoordinates(p, vec3(0.0, 0.0, 1.0)))));
}
