out vec4 pixel;
void main() {
  vec3 ray = rayAt(gl_FragCoord.xy);
  pixel = shown(skyAt(ray.z * inversesqrt(dot(ray, ray))));
}
