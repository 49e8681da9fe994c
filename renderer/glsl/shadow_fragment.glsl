// Glass lets three quarters of the light pass: one texel of four, which the tent of the look-up evens out.
void main() {
#ifdef GLASS
  if (((int(gl_FragCoord.x) | int(gl_FragCoord.y)) & 1) != 0) discard;
#endif
}
