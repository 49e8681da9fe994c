#include "demos/scene/written_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "demos/language/scene_choice.h"
#include "demos/system/exit_code.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

struct WrittenFiles : testing::Test {
  /// What is said of one that is written and one that is read.
  static std::string refusal(const fs::path& written, const fs::path& read) {
    const NamedFile out{"--csv", written}, in{"the scene", read};
    return thrownMessage<UsageError>([&] { requireNotRead({&out, 1}, {&in, 1}); });
  }
  static void require(const fs::path& a, const fs::path& b) {
    const NamedFile both[] = {{"--csv", a}, {"--audit", b}};
    requireDistinct(both);
  }
  TemporaryFolder folder;
  fs::path file = folder.file("a.json", "{}");
};

TEST_F(WrittenFiles, AreNoneThatIsReadByWhateverPathOrLink) {
  EXPECT_EQ(refusal(file, file),
            "--csv " + file.string() + ": the scene is read from there; accepted: another file");
  fs::create_symlink(file, folder.path() / "soft");
  fs::create_hard_link(file, folder.path() / "hard");
  fs::create_directory(folder.path() / "in");
  for (const char* name : {"soft", "hard", "in/../a.json", "./a.json"})
    EXPECT_NE(refusal(folder.path() / name, file), "") << name;
  const NamedFile other{"--csv", folder.path() / "b.json"}, read{"the scene", file};
  EXPECT_NO_THROW(requireNotRead({&other, 1}, {&read, 1}));
}

TEST_F(WrittenFiles, AreDistinctAlsoBeforeTheyAreThere) {
  EXPECT_NO_THROW(require(folder.path() / "x.csv", folder.path() / "y.csv"));
  EXPECT_THROW(require(folder.path() / "x.csv", folder.path() / "in/../x.csv"), UsageError);
  EXPECT_THROW(require("x.csv", fs::current_path() / "x.csv"), UsageError);
  EXPECT_THROW(require("-", "-"), UsageError);
}

TEST_F(WrittenFiles, MayBeOneDeviceOrPipe) {
  EXPECT_NO_THROW(require("/dev/null", "/dev/null"));
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NO_THROW(require(pipe, pipe));
}

TEST_F(WrittenFiles, AreNoneOfAScenesPartsMeshesAndTheirMaterials) {
  folder.file("m.mtl", "newmtl red\n");
  folder.file("m.obj",
              "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.file("part.json",
              R"({ "format": 1, "bodies": [ { "name": "p", "shape": { "mesh": { "file": "m.obj" } } } ] })");
  const fs::path scene = folder.file("scene.json", R"({ "format": 1, "bodies": [ { "include": "part.json" },
    { "name": "b", "shape": { "box": [1, 1, 1] }, "position": [9, 0, 0] } ] })");
  SceneChoice choice;
  choice.scene = scene.string();
  for (const char* name : {"scene.json", "part.json", "m.obj", "m.mtl"}) {
    choice.written = {{"-o", folder.path() / name}};
    EXPECT_THROW(chosenScene(choice), UsageError) << name;
  }
  choice.written = {{"-o", folder.path() / "m.csv"}};
  EXPECT_NO_THROW(chosenScene(choice));
}

}  // namespace
}  // namespace carom::demos
