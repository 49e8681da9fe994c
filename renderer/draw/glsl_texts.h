#pragma once
// The text of each file of renderer/glsl, embedded at build time by renderer/glsl/embed.cmake; shaders.h puts
// programs together from them.

namespace carom::renderer::glsl {

extern const char* const kDesktop;
extern const char* const kHead;
extern const char* const kLight;
extern const char* const kNoise;
extern const char* const kSurface;
extern const char* const kGroundPattern;
extern const char* const kBodyVertex;
extern const char* const kBodyFragment;
extern const char* const kGroundVertex;
extern const char* const kGroundCellVertex;
extern const char* const kGroundCommon;
extern const char* const kGroundOpenFragment;
extern const char* const kGroundShadowedFragment;
extern const char* const kSkyVertex;
extern const char* const kSkyFragment;
extern const char* const kSurfaceVertex;
extern const char* const kSurfaceFragment;
extern const char* const kShadowVertex;
extern const char* const kShadowFragment;
extern const char* const kOcclusionVertex;
extern const char* const kOcclusionFragment;
extern const char* const kGlassFragment;
extern const char* const kWaterFragment;

}  // namespace carom::renderer::glsl
