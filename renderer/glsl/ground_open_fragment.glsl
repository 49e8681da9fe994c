void main() {
  pixel = encoded(groundPixel(groundPoint(), 1.0));
}
