// What the process that reads a mesh answers: whole, cut off anywhere, and changed anywhere; and vertices
// that are alike, which become one.

#include "demos/asset/mesh_answer.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

using Point = ReadPart::Point;

ReadMeshes triangle() {
  ReadPart part;
  part.vertices = {{0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  part.normals = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}};
  part.colors = {{1.0f, 0.0f, 0.5f}, {1.0f, 0.0f, 0.5f}, {1.0f, 0.0f, 0.5f}};
  part.uv = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  part.triangles = {{0, 1, 2}};
  part.picture = 0;
  return {{part}, {{1, 2, {1, 2, 3, 4, 5, 6}}}, {"left out"}};
}

TEST(MeshAnswer, GivesBackWhatWasRead) {
  const ImportedMesh mesh = meshOfAnswer(answerBytes(triangle()), "a.obj");
  ASSERT_EQ(mesh.parts.size(), 1u);
  const MeshPart& part = mesh.parts[0];
  ASSERT_EQ(part.vertices.size(), 3u);
  EXPECT_EQ(part.vertices[0], Vec3(0.1, 0.0, 0.0)) << "in double precision";
  EXPECT_EQ(part.normals[2], Vec3(0.0, 0.0, 1.0));
  EXPECT_EQ(part.colors[1], Vec3(1.0, 0.0, 0.5));
  EXPECT_EQ(part.uv[1], Vec2(1.0, 0.0));
  ASSERT_EQ(part.triangles.size(), 1u);
  EXPECT_EQ(part.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(part.picture_of, std::vector<int>{0});
  ASSERT_EQ(mesh.pictures.size(), 1u);
  EXPECT_EQ(mesh.pictures[0].rgb, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"left out"});
}

TEST(MeshAnswer, IsNoneWhereItIsCutOff) {
  const std::vector<std::uint8_t> whole = answerBytes(triangle());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(thrownMessage<InputError>([&] {
                meshOfAnswer({whole.data(), size}, "a.obj");
              }),
              "a.obj: cannot be read as a mesh: its reader gave no answer")
        << size;
}

// A reader that has gone astray may answer anything: it is a mesh, or refused, and nothing is read beyond it.
TEST(MeshAnswer, SurvivesAnyByte) {
  const std::vector<std::uint8_t> whole = answerBytes(triangle());
  int taken = 0;
  for (std::size_t at = 1; at < whole.size(); ++at)
    for (const int byte : {0, 1, 4, 127, 255}) {
      std::vector<std::uint8_t> changed = whole;
      changed[at] = static_cast<std::uint8_t>(byte);
      try {
        const ImportedMesh mesh = meshOfAnswer(changed, "a.obj");
        for (const MeshPart& part : mesh.parts)
          for (const Triangle& t : part.triangles)
            for (const int corner : t) ASSERT_LT(static_cast<std::size_t>(corner), part.vertices.size());
        ++taken;
      } catch (const InputError&) {
      }
    }
  EXPECT_GT(taken, 0) << "digits of coordinates may be anything finite";
}

TEST(MeshAnswer, OfAnErrorIsItsText) {
  EXPECT_EQ(thrownMessage<InputError>([] { meshOfAnswer(errorBytes("no mesh"), "a.obj"); }),
            "a.obj: no mesh");
  try {
    meshOfAnswer(refusalBytes(std::make_error_code(std::errc::permission_denied)), "a.obj");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), static_cast<int>(std::errc::permission_denied));
  }
}

TEST(MeshAnswer, JoinsWhatIsAlikeInTheOrderInWhichItIsNamed) {
  ReadPart part;
  part.vertices = {{5, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, -0.0, 3}, {0, 0, 3}, {1, 0, 0}};
  part.triangles = {{3, 5, 2}, {1, 2, 4}};
  part.picture = 7;
  const ReadPart joined = joinedPart(part, {3, 5, 2, 1, 4});
  const std::vector<ReadPart::Place> places{{0, 0, 3}, {1, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(joined.vertices, places) << "none that is not named";
  const std::vector<ReadPart::Corners> triangles{{0, 1, 2}, {1, 2, 0}};
  EXPECT_EQ(joined.triangles, triangles);
  EXPECT_EQ(joined.picture, 7);
}

TEST(MeshAnswer, KeepsApartWhatLooksAnother) {
  ReadPart part;
  part.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  part.triangles = {{0, 1, 2}, {3, 2, 1}};
  const std::vector<Point> alike(4, Point{0, 0, 1});
  std::vector<Point> another = alike;
  another[3] = {0, 0, -1};
  const std::vector<unsigned> named{0, 1, 2, 3};
  part.normals = part.colors = part.uv = alike;
  EXPECT_EQ(joinedPart(part, named).vertices.size(), 3u);
  for (std::vector<Point> ReadPart::*list : {&ReadPart::normals, &ReadPart::colors, &ReadPart::uv}) {
    ReadPart changed = part;
    changed.*list = another;
    const ReadPart joined = joinedPart(changed, named);
    EXPECT_EQ(joined.vertices.size(), 4u);
    EXPECT_EQ((joined.*list)[3], another[3]);
  }
}

}  // namespace
}  // namespace carom::demos
