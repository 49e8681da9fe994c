#pragma once
// The programs of all passes, put together from the files of renderer/glsl, and the block of values they
// share. Frame E: the world's axes, origin at the eye; light is linear until the sRGB framebuffer encodes it.
// Variants are chosen by lines between the head and the rest: PRINT (white surroundings), SMALL_SHADOWS (2x2
// texels), MIRROR (bodies as the ground mirrors them), POLISHED (the ground shows what it mirrors), SUNLIT
// (faces that no other body can darken), CHECKER (bodies whose level faces are checker boards), PICTURES
// (surfaces with pictures of their own). Tested in tests/renderer/draw/shaders_test.cpp.

#include <string>
#include <vector>

#include "renderer/gl/shader_program.h"

namespace carom::renderer {

/// Matches the GLSL block `Frame` of head.glsl under std140.
struct FrameBlock {
  float clip_from_E[16];
  float shadow_rows[3][4];  ///< Texture u, v and depth of a point.
  float to_light[4];  ///< Unit; w: how far a point is lifted along its normal before its shadow is looked up.
  float ray_corner[4];  ///< Direction through the lower left corner of the image; w: 1 / fog distance.
  float ray_x[4];       ///< Added per pixel to the right; w: texels along a side of the shadow map.
  float ray_y[4];       ///< Added per pixel upwards.
  float ground[4];      ///< x: z of the ground; y: 1 / checker square; zw: the eye's xy in squares, modulo 2.
  float reach[4];       ///< x: half the side of the ground's innermost square.
  float mirror[4];      ///< xy: how mirrored things are sheared, over their height above the ground; zw: 1 /
                        ///< pixels.
  float origin[4];      ///< xy: the eye's xy in squares, modulo 64; zw: how many 64s there are before.
  float ground_color[4];  ///< Linear; of patterns other than the checker board.
  float pool[4];          ///< xy: the middle of the light's pool; z: 1 / its radius.
};

inline constexpr int kWaterWavesInBlock = 64;

/// Matches the GLSL block `Water` of water_fragment.glsl under std140.
struct WaterBlock {
  float low[4];         ///< The lower corner; w: number of waves.
  float high[4];        ///< The upper corner, z the undisturbed level; w: how far waves raise or lower it.
  float absorption[4];  ///< 1/m of each colour; w: the waves' greatest slope.
  float scattered[4];   ///< The light of water without end; w: half the width of the foam line, pixels.
  float depth[4];       ///< x: near, y: far of the depth buffer.
  float waves[kWaterWavesInBlock][4];  ///< Amplitude, wave vector, phase over the eye.
};

enum class Shader {
  kOpenSky,
  kOpenGround,
  kShadowedGround,
  kBody,
  kSurfaces,
  kShadowMap,
  kOcclusion,
  kGlass,
  kWater
};
inline constexpr int kShaders = 9;

/// The texts of a program; `lines` choose its variant and must outlive the answer.
ShaderSources sourcesOf(Shader shader, const std::string& lines = {});

/// The vertices of the open ground: four, the square around the point below the eye; ten more for each ring
/// from there to a square sixteen times as large, and so on to beyond the horizon.
inline constexpr int kGroundRings = 3;

}  // namespace carom::renderer
