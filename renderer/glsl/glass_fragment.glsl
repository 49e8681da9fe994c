// Glass: what is behind is seen along a ray that is bent where it enters and where it leaves the body, a ball or the box
// around it, and absorbed on the way; the surroundings are mirrored in front, most at grazing angles. Whoever is behind is
// looked up on a copy of the image without this body, where the bent ray meets the ground or ends.
TEXTURE(3) uniform sampler2D scene_copy;
in vec3 p_E;
in vec3 n_E;
flat in vec3 bend;
in float nearness;
in vec3 shadow;
flat in vec4 albedo;
in vec3 p_S;
in vec3 n_S;
flat in vec4 half_S;
flat in vec3 eye_S;
flat in vec3 rows_S[3];
flat in float is_ball;
out vec4 pixel;
const float kIndex = 1.5;
const float kFar = 12.0;  // Of the body's size: where a ray that meets no ground ends.

// Where the ray from p along r leaves the body, and the outward normal there.
float exitOf(vec3 p, vec3 r, out vec3 normal) {
  if (is_ball > 0.5) {
    float t = -2.0 * dot(p, r);
    normal = normalize(p + t * r);
    return t;
  }
  vec3 turn = vec3(greaterThanEqual(r, vec3(0.0))) * 2.0 - 1.0;
  vec3 away = max((turn * half_S.xyz - p) * turn, 0.0) / max(abs(r), 1e-6);
  float t = min(away.x, min(away.y, away.z));
  normal = t == away.x ? vec3(turn.x, 0.0, 0.0) : t == away.y ? vec3(0.0, turn.y, 0.0) : vec3(0.0, 0.0, turn.z);
  return t;
}

vec3 intoE(vec3 v) { return vec3(dot(rows_S[0], v), dot(rows_S[1], v), dot(rows_S[2], v)); }

// Colour, and what of the nothing behind a cut-out picture shows.
vec4 seenAlong(vec3 p, vec3 d, float size) {
  float s = kFar * size;
  if (d.z < -1e-4 && p.z > ground.x) s = min((ground.x - p.z) / d.z, 4.0 * s);
  vec4 clip = clip_from_E * vec4(p + s * d, 1.0);
  vec2 uv = 0.5 + 0.5 * clip.xy / max(clip.w, 1e-6);
  vec2 inside = min(uv, 1.0 - uv);
  float known = clip.w > 0.0 ? smoothstep(0.0, 0.02, min(inside.x, inside.y)) : 0.0;
#ifdef CUTOUT
  vec4 open = vec4(vec3(0.0), 1.0);
#else
  vec4 open = vec4(surroundings(d, 0.06), 0.0);
#endif
  return mix(open, texture(scene_copy, clamp(uv, 0.0, 1.0)), known);
}

void main() {
  float distance_m = length(p_E);
  vec3 v = p_E / -distance_m;
  vec3 n = normalize(n_E + clamp(nearness, 0.0, 1.0) * bend);
  vec3 d = normalize(p_S - eye_S), n_in = normalize(n_S), n_out;
  vec3 r = refract(d, n_in, 1.0 / kIndex);
  float t = exitOf(p_S, r, n_out);
  vec3 left = refract(r, -n_out, kIndex);
  if (dot(left, left) < 0.5) left = reflect(r, -n_out);
  float size = half_S.x + half_S.y + half_S.z, to_metres = length(rows_S[0]);
  vec4 behind = seenAlong(p_E + intoE(t * r), normalize(intoE(left)), 0.3333 * size * to_metres);
  vec3 through = pow(albedo.rgb, vec3(1.5 * t / size));

  float grazing = 1.0 - max(dot(n, v), 0.0);
  float fresnel = 0.04 + 0.80 * grazing * grazing * grazing * grazing * grazing;
  vec3 mirrored = surroundings(2.0 * dot(n, v) * n - v, 0.03);
  float sun = dot(n, to_light.xyz) > 0.0 ? lit(shadow) : 0.0;
  vec3 h = normalize(v + to_light.xyz);
  vec3 glint = kExposure * kSun * (1.6 * sun * exp2(-420.0 * (1.0 - max(dot(n, h), 0.0))));
  vec3 image = mix(behind.rgb * through, mirrored * lightAt(p_E.xy), fresnel);
  image += glint * inversesqrt(1.0 + glint * glint) * (1.0 - image);
#ifdef CUTOUT
  pixel = vec4(image, behind.a * (1.0 - fresnel) * dot(through, vec3(1.0 / 3.0)));
#else
  float q = distance_m * ray_corner.w;
  pixel = vec4(mix(kHorizon + glowTowards(-v), image, exp(-q * q)), 1.0);
#endif
}
