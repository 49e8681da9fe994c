void main() {
  pixel = groundPixel(groundPoint(), 1.0);
}
