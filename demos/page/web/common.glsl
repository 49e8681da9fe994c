// What all shaders share, as in the renderer (renderer/draw): frame E has the world's axes and its origin at the eye;
// light is linear until `shown` encodes it.
precision highp float;
precision highp int;
precision highp sampler2DShadow;
layout(std140) uniform Frame {
  mat4 clip_from_E;
  vec4 shadow_rows[3];
  vec4 to_light;    // w: how far a point is lifted along its normal before its shadow is looked up
  vec4 ray_corner;  // direction through the lower left corner; w: 1 / distance of the air
  vec4 ray_x;       // added a pixel to the right; w: texels along a side of the shadow map
  vec4 ray_y;       // added a pixel upwards; w: 1 where there is a ground
  vec4 ground;      // x: its height over the eye; y: 1 / checker square; zw: the eye's xy in squares, modulo 2
  vec4 reach;       // x: half the side of the ground's innermost square; y: pixels of the outline
  vec4 sun;
  vec4 sky_light;
  vec4 ground_light;
  vec4 horizon;
  vec4 zenith;
  vec4 below;
  vec4 light_square;
  vec4 dark_square;
};

vec3 shadowCoordinates(vec3 p, vec3 n) {
  float towards = dot(n, to_light.xyz);
  float slope = sqrt(max(1.0 - towards * towards, 0.0));
  vec4 q = vec4(p + to_light.w * (0.2 + 0.8 * slope) * n, 1.0);
  return vec3(dot(shadow_rows[0], q), dot(shadow_rows[1], q), dot(shadow_rows[2], q));
}

vec3 turned(vec4 q, vec3 v) {  // w first
  vec3 t = 2.0 * cross(q.yzw, v);
  return v + q.x * t + cross(q.yzw, t);
}
