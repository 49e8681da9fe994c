// The tree keeps its floors: no include points up or sideways, and each library is named by one file.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string_view>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/source_tree.h"

namespace carom::architecture {
namespace {

TEST(Tree, NoIncludePointsUpOrSideways) {
  const std::vector<Source> sources = sourcesOfTheTree();
  ASSERT_GT(sources.size(), 20u) << "the tree was not found";
  for (const std::string& violation : violations(sources)) ADD_FAILURE() << violation;
}

// So that the commands that draw nothing are built where there is no GL (-DCAROM_RENDERER=OFF).
TEST(Tree, OnlyTheDoctorsExaminationOfTheProgramReachesTheHeadersOfGl) {
  std::map<std::string, std::vector<std::string>> own;
  for (const auto& [path, text] : sourcesOfTheTree())
    for (const Include& include : includesOf(text))
      if (include.quoted) own[path].push_back(include.header);
  for (const auto& [path, headers] : own) {
    if (!path.starts_with("demos/") || path == "demos/command/renderer_examination.cpp") continue;
    std::set<std::string> reached(headers.begin(), headers.end());
    for (std::vector<std::string> open(headers); !open.empty();) {
      const std::string header = open.back();
      open.pop_back();
      for (const std::string& next : own[header])
        if (reached.insert(next).second) open.push_back(next);
    }
    EXPECT_FALSE(reached.contains("renderer/gl/gl_functions.h")) << path;
  }
}

TEST(Tree, EveryFolderHasAHeightAndEveryHeightAFolder) {
  std::set<std::string> folders;
  for (const Source& source : sourcesOfTheTree()) folders.insert(folderOf(source.path));
  for (const std::string& folder : folders) EXPECT_TRUE(folderHeights().contains(folder)) << folder;
  for (const auto& [folder, height] : folderHeights()) EXPECT_TRUE(folders.contains(folder)) << folder;
}

TEST(Tree, NoFolderHoldsMoreThanTwentySources) {
  std::vector<std::string> paths;
  for (const Source& source : sourcesOfTheTree({"engine", "renderer", "demos", "tests"}))
    paths.push_back(source.path);
  for (const std::string& folder : overfullFolders(paths)) ADD_FAILURE() << folder;
}

TEST(Tree, EveryHeaderIsIncludedOnce) {
  for (const auto& [path, text] : sourcesOfTheTree())
    EXPECT_TRUE(!path.ends_with(".h") || text.find("#pragma once") != std::string::npos) << path;
}

// The checker itself: each wrong include is found, each right one is let through.

struct Case {
  const char* path;
  const char* include;
  const char* reason;  // empty: allowed
};

void expectJudged(const Case& c) {
  const std::vector<std::string> found = violations({{c.path, c.include}});
  const bool allowed = std::string_view(c.reason).empty();
  ASSERT_EQ(found.size(), allowed ? 0u : 1u) << c.path << " " << c.include;
  if (!allowed) {
    EXPECT_NE(found[0].find(c.reason), std::string::npos) << found[0];
  }
}

TEST(IncludeRules, JudgeEachArrow) {
  const Case cases[] = {
      {"engine/solid/solid.h", R"(#include "engine/foundation/frames.h")", ""},
      {"engine/solid/solid.h", R"(#include "engine/solid/convex_hull.h")", ""},
      {"engine/solid/solid.h", R"(#include "engine/contact/approach.h")", "points up"},
      {"engine/foundation/frames.h", R"(#include "engine/solid/solid.h")", "points up"},
      {"engine/motion/rigid_body.h", R"(#include "engine/closest_features/vclip.h")", "points sideways"},
      {"engine/contact/approach.h", R"(#include "engine/environment/gravity.h")", "points sideways"},
      {"engine/environment/gravity.h", R"(#include "engine/contact/approach.h")", "points sideways"},
      {"engine/response/one_point/impulse.h", R"(#include "engine/environment/gravity.h")", ""},
      {"engine/modes/resting.h", R"(#include "engine/simulation/world.h")", "points up"},
      {"engine/simulation/world.cpp", R"(  #  include "engine/modes/resting.h"  // why)", ""},
      {"engine/simulation/world.cpp", R"(#include "renderer/image/image.h")", "must not see the renderer"},
      {"engine/simulation/world.cpp", R"(#include "demos/scene/scene.h")", "only demos"},
      {"engine/simulation/world.cpp", R"(#include "world.h")", "by its path from the root"},
      {"engine/simulation/world.cpp", R"(#include "../modes/resting.h")", "by its path from the root"},
      {"engine/simulation/world.cpp", R"(#include "engine/shortcuts/all.h")", "no known floor"},
      {"engine/shortcuts/all.h", R"(#include "engine/foundation/frames.h")", "no known floor"},
      {"renderer/mesh/solid_mesh.cpp", R"(#include "engine/solid/solid.h")", ""},
      {"renderer/mesh/solid_mesh.cpp", R"(#include "renderer/image/image.h")", ""},
      {"renderer/frame/frame_renderer.cpp", R"(#include "engine/simulation/world.h")",
       "foundation and solid only"},
      {"renderer/frame/frame_renderer.cpp", R"(#include "engine/motion/rigid_body.h")",
       "foundation and solid only"},
      {"renderer/frame/frame_renderer.cpp", R"(#include "demos/scene/scene.h")", "only demos"},
      {"engine/motion/rigid_body.h", R"(#include "engine/closest_features/pair/feature.h")",
       "points sideways"},
      {"engine/closest_features/vclip.h", R"(#include "engine/closest_features/pair/feature.h")", ""},
      {"engine/solid/solid.h", R"(#include "engine/solid/decomposition/convex_decomposition.h")",
       "points up"},
      {"renderer/image/png.cpp", R"(#include "renderer/gl/scissor.h")", "points up"},
      {"renderer/frame/frame_renderer.cpp", R"(#include "renderer/passes/water_pass.h")", ""},
      {"demos/scene/scene.h", R"(#include "demos/format/json.h")", ""},
      {"demos/scene/scene.h", R"(#include "demos/command/command.h")", "points up"},
      {"demos/compare/comparison.h", R"(#include "demos/report/junit.h")", "points up"},
      {"demos/odds/ends.h", R"(#include "demos/format/json.h")", "no known floor"},
      {"engine/simulation/bodies/body.h", R"(#include "engine/simulation/world.h")", "points up"},
      {"engine/simulation/world.cpp", R"(#include "engine/simulation/events/event_loop.h")", ""},
      {"demos/main.cpp", R"(#include "engine/simulation/world.h")", ""},
      {"demos/main.cpp", R"(#include "renderer/image/image.h")", ""},
      {"demos/main.cpp", R"(// #include "world.h")", ""},
  };
  for (const Case& c : cases) expectJudged(c);
}

TEST(IncludeRules, JudgeEachLibrary) {
  const Case cases[] = {
      {"renderer/gl/gl_functions.h", "#include <GL/glcorearb.h>", ""},
      {"renderer/gl/egl_context.cpp", "#include <EGL/egl.h>", ""},
      {"renderer/gl/osmesa_context.cpp", "#include <GL/osmesa.h>", "may name GL"},
      {"renderer/gl/osmesa_context.cpp", "#include <EGL/egl.h>", "may name EGL"},
      {"renderer/image/quick_deflate.cpp", "#include <isa-l/igzip_lib.h>", ""},
      {"renderer/image/png.cpp", "#include <isa-l/igzip_lib.h>", "may name ISA-L"},
      {"renderer/frame/frame_renderer.cpp", "#include <GL/glcorearb.h>", "may name GL"},
      {"renderer/image/png.cpp", "#include <png.h>", ""},
      {"demos/main.cpp", "#include <png.h>", "may name libpng"},
      {"demos/asset/mesh_import.cpp", "#include <assimp/scene.h>", ""},
      {"demos/scene.cpp", "#include <assimp/scene.h>", "may name assimp"},
      {"engine/solid/convex_hull.cpp", "#include <libqhull_r/qhull_ra.h>", ""},
      {"engine/solid/solid.cpp", "#include <libqhull_r/qhull_ra.h>", "may name qhull"},
      {"demos/language/scene_file.cpp", "#include <nlohmann/json.hpp>", ""},
      {"renderer/image/png.cpp", "#include <nlohmann/json.hpp>", "only the demos read JSON"},
      {"engine/solid/solid.cpp", "#include <boost/graph.hpp>", "Eigen and the standard library"},
      {"engine/solid/solid.cpp", "#include <unistd.h>", "Eigen and the standard library"},
      {"engine/solid/solid.cpp", "#include <Eigen/LU>", ""},
      {"engine/solid/solid.cpp", "#include <vector>", ""},
  };
  for (const Case& c : cases) expectJudged(c);
}

TEST(IncludeRules, LetOneFileNameTheJsonLibrary) {
  const std::string json = "#include <nlohmann/json.hpp>\n#include <nlohmann/json_fwd.hpp>\n";
  EXPECT_TRUE(violations({{"demos/language/scene_file.cpp", json}}).empty());
  EXPECT_EQ(violations({{"demos/language/scene_file.cpp", json}, {"demos/frames/manifest.cpp", json}}).size(),
            1u);
}

TEST(IncludeRules, CountTheSourcesOfAFolder) {
  std::vector<std::string> paths;
  for (int i = 0; i < kMostSources; ++i) paths.push_back("demos/scene/" + std::to_string(i) + ".cpp");
  paths.push_back("demos/main.cpp");
  EXPECT_TRUE(overfullFolders(paths).empty());
  paths.push_back("demos/scene/one_more.h");
  EXPECT_EQ(overfullFolders(paths), std::vector<std::string>{"demos/scene holds 21 sources, more than 20"});
}

TEST(IncludeRules, ReportTheLine) {
  const std::vector<std::string> found =
      violations({{"engine/solid/solid.h", "// head\n\n#include \"engine/modes/resting.h\"\n"}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "engine/solid/solid.h:3: engine/modes/resting.h: points up");
}

}  // namespace
}  // namespace carom::architecture
