#include "renderer/draw/shaders.h"

#include "renderer/draw/glsl_texts.h"

namespace carom::renderer {

ShaderSources sourcesOf(Shader shader, const std::string& lines) {
  using namespace glsl;
  const char* l = lines.c_str();
  switch (shader) {
    case Shader::kOpenSky:
      return {"sky", {kDesktop, kHead, l, kSkyVertex}, {kDesktop, kHead, l, kLight, kSkyFragment}};
    case Shader::kOpenGround:
      return {"open ground",
              {kDesktop, kHead, l, kGroundVertex},
              {kDesktop, kHead, l, kLight, kNoise, kGroundPattern, kGroundCommon, kGroundOpenFragment}};
    case Shader::kShadowedGround:
      return {"shadowed ground",
              {kDesktop, kHead, l, kGroundCellVertex},
              {kDesktop, kHead, l, kLight, kNoise, kGroundPattern, kGroundCommon, kGroundShadowedFragment}};
    case Shader::kBody:
      return {"body",
              {kDesktop, kHead, l, kBodyVertex},
              {kDesktop, kHead, l, kLight, kNoise, kGroundPattern, kSurface, kBodyFragment}};
    case Shader::kSurfaces:
      return {"surface", {kDesktop, kHead, l, kSurfaceVertex}, {kDesktop, kHead, l, kSurfaceFragment}};
    case Shader::kShadowMap:
      return {"shadow", {kDesktop, kHead, l, kShadowVertex}, {kDesktop, kHead, l, kShadowFragment}};
    case Shader::kOcclusion:
      return {"occlusion", {kDesktop, kHead, l, kOcclusionVertex}, {kDesktop, kHead, l, kOcclusionFragment}};
    case Shader::kGlass:
      return {"glass",
              {kDesktop, kHead, l, "#define SURFACE\n#define GLASS\n", kBodyVertex},
              {kDesktop, kHead, l, kLight, kGlassFragment}};
    case Shader::kWater:
      break;
  }
  return {"water", {kDesktop, kHead, l, kSkyVertex}, {kDesktop, kHead, l, kLight, kWaterFragment}};
}

}  // namespace carom::renderer
