#include "renderer/draw/shaders.h"

#include "renderer/draw/glsl_texts.h"

namespace carom::renderer {

ShaderSources sourcesOf(Shader shader, const std::string& lines) {
  using namespace glsl;
  const char* l = lines.c_str();
  switch (shader) {
    case Shader::kOpenSky:
      return {"sky", {kHead, l, kSkyVertex}, {kHead, l, kLight, kSkyFragment}};
    case Shader::kOpenGround:
      return {"open ground",
              {kHead, l, kGroundVertex},
              {kHead, l, kLight, kNoise, kGroundPattern, kGroundCommon, kGroundOpenFragment}};
    case Shader::kShadowedGround:
      return {"shadowed ground",
              {kHead, l, kGroundCellVertex},
              {kHead, l, kLight, kNoise, kGroundPattern, kGroundCommon, kGroundShadowedFragment}};
    case Shader::kBody:
      return {"body",
              {kHead, l, kBodyVertex},
              {kHead, l, kLight, kNoise, kGroundPattern, kSurface, kBodyFragment}};
    case Shader::kSurfaces:
      return {"surface", {kHead, l, kSurfaceVertex}, {kHead, l, kSurfaceFragment}};
    case Shader::kShadowMap:
      return {"shadow", {kHead, l, kShadowVertex}, {kHead, l, kShadowFragment}};
    case Shader::kOcclusion:
      return {"occlusion", {kHead, l, kOcclusionVertex}, {kHead, l, kOcclusionFragment}};
    case Shader::kGlass:
      return {"glass",
              {kHead, l, "#define SURFACE\n#define GLASS\n", kBodyVertex},
              {kHead, l, kLight, kGlassFragment}};
    case Shader::kWater:
      break;
  }
  return {"water", {kHead, l, kSkyVertex}, {kHead, l, kLight, kWaterFragment}};
}

}  // namespace carom::renderer
