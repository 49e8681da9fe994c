// Every program that a renderer may link, in every variant, as the reference compiler of the Khronos group
// judges it. Needs Debian's glslang-tools; without it the test is skipped.
#include "renderer/draw/shaders.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/draw/glsl_texts.h"
#include "renderer/draw/shader_lines.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace carom::renderer {
namespace {
namespace fs = std::filesystem;

/// What glslangValidator says of the texts; empty when all are right.
class Validator {
 public:
  void add(const ShaderSources& sources) {
    addStage(sources.vertex, "vert");
    addStage(sources.fragment, "frag");
  }
  int count() const { return static_cast<int>(known_.size()); }

  std::string verdict() const {
    const ShellEnd end =
        endOfShell("cd '" + folder_.path().string() + "' && glslangValidator *.vert *.frag 2>&1");
    if (end.code == 0) return "";
    std::string said;
    std::istringstream lines(end.out);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("ERROR")) said += line + "\n";
    return said.empty() ? "glslangValidator failed" : said;
  }

 private:
  template <typename Pieces>
  void addStage(const Pieces& pieces, const char* ending) {
    std::string text;
    for (const char* piece : pieces)
      if (piece != nullptr) text += piece;
    if (!known_.insert(ending + text).second) return;
    folder_.file(std::to_string(known_.size()) + "." + ending, text);
  }

  TemporaryFolder folder_;
  std::set<std::string> known_;
};

bool hasValidator() {
  return succeeds("glslangValidator --version");
}

std::vector<Settings> settingsOfEveryKind() {
  std::vector<Settings> all;
  for (const std::string& light : lightNames())
    for (const bool cutout : {false, true})
      for (const std::string& preset : presetNames())
        for (const std::string& style : styleNames()) {
          Settings settings;
          settings.preset = presetOf(preset);
          settings.style = styleOf(style);
          settings.light = lightOf(light);
          settings.cutout = cutout;
          // Those that differ by the light alone are many and alike; of each light, one preset will do.
          if (light == "day" || preset == "cinematic") all.push_back(settings);
        }
  return all;
}

std::vector<BodyLook> looksOfEveryKind() {
  std::vector<BodyLook> all;
  for (const BodyShader shader : {BodyShader::kSunlit, BodyShader::kShadowed})
    for (int kind = 0; kind < kSurfaceKinds; ++kind) all.push_back({shader, kind});
  for (int pattern = 0; pattern < kGroundPatterns; ++pattern) all.push_back({BodyShader::kChecker, pattern});
  return all;
}

TEST(Shaders, AreValidGlslInEveryVariant) {
  if (!hasValidator()) GTEST_SKIP() << "there is no glslangValidator here: apt-get install glslang-tools";
  Validator validator;
  for (const Settings& settings : settingsOfEveryKind()) {
    const std::string lines = frameLines(settings);
    for (int shader = 0; shader < kShaders; ++shader)
      validator.add(sourcesOf(static_cast<Shader>(shader), lines));
    for (int pattern = 0; pattern < kGroundPatterns; ++pattern) {
      const std::string ground = lines + shaderLines(static_cast<GroundPattern>(pattern));
      validator.add(sourcesOf(Shader::kOpenGround, ground));
      validator.add(sourcesOf(Shader::kShadowedGround, ground));
    }
    for (const BodyLook& look : looksOfEveryKind())
      for (const bool mirrored : {false, true}) {
        const std::string body = lines + bodyLines(look, mirrored);
        validator.add(sourcesOf(Shader::kBody, body));
      }
  }
  validator.add(sourcesOf(Shader::kShadowMap, "#define GLASS\n"));
  EXPECT_GT(validator.count(), 400);
  EXPECT_EQ(validator.verdict(), "");
}

TEST(Shaders, AMistakeIsFound) {
  if (!hasValidator()) GTEST_SKIP() << "there is no glslangValidator here: apt-get install glslang-tools";
  Validator validator;
  validator.add({"wrong",
                 {glsl::kDesktop, glsl::kHead, "void main() { gl_Position = vec3(0.0); }\n"},
                 {glsl::kDesktop, glsl::kHead, glsl::kShadowFragment}});
  EXPECT_NE(validator.verdict().find("ERROR"), std::string::npos);
}

}  // namespace
}  // namespace carom::renderer
