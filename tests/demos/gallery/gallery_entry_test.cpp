// An entry comes back from its JSON; files that were changed or are gone are seen; the identity follows the
// scene and the shape.
#include "demos/gallery/gallery_entry.h"

#include <gtest/gtest.h>

#include "demos/format/content_hash.h"
#include "demos/language/scene_file.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

GalleryEntry sample(const TemporaryFolder& folder) {
  GalleryEntry entry;
  entry.name = "dice";
  entry.identity = "0123456789abcdef";
  entry.group = "many contacts";
  entry.description = "two \"dice\" <roll>";
  entry.look_for = "d = v^2 / 2 g";
  entry.command = "carom render dice";
  entry.bodies = 2;
  entry.duration_s = 2.5;
  entry.width = 480;
  entry.height = 270;
  folder.file("page.html", "text");
  ContentHash hash;
  hash.add(std::string("text"));
  entry.files = {{"page.html", hash.value(), 4}};
  return entry;
}

TEST(GalleryEntry, ComesBackFromItsJson) {
  const TemporaryFolder folder;
  const GalleryEntry entry = sample(folder);
  const GalleryEntry read = galleryEntry(Json::parse(entry.json().text(), "entry"));
  EXPECT_EQ(read.json().text(), entry.json().text());
  EXPECT_EQ(read.files[0].hash, entry.files[0].hash);
  EXPECT_THROW(galleryEntry(Json::parse("{ \"name\": 1 }", "entry")), InputError);
}

TEST(GalleryEntry, IsNotWholeOnceAFileIsAnother) {
  const TemporaryFolder folder;
  const GalleryEntry entry = sample(folder);
  EXPECT_TRUE(isWhole(entry, folder.path()));
  folder.file("page.html", "tex!");
  EXPECT_FALSE(isWhole(entry, folder.path())) << "of the same length";
  std::filesystem::remove(folder.path() / "page.html");
  EXPECT_FALSE(isWhole(entry, folder.path()));
}

TEST(GalleryEntry, RemovesOnlyFilesOfTheGalleryThatAreAsWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "in");
  GalleryEntry entry = sample(folder);
  entry.files[0].name = "../page.html";  // whole, and not in the gallery's folder "in"
  removeFiles(entry, folder.path() / "in");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "page.html"));
  entry.files[0].name = "page.html";
  removeFiles(entry, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.html"));
}

TEST(GalleryIdentity, FollowsTheSceneAndThePictures) {
  const TemporaryFolder folder;
  const std::string text = R"({ "format": 1, "bodies": [{ "name": "a", "shape": { "box": [1, 1, 1] } }] })";
  const Scene one = readSceneFile(folder.file("one.json", text)),
              two = readSceneFile(folder.file("two.json", text + "\n"));
  GalleryShape shape;
  const std::string identity = galleryIdentity(one, shape);
  EXPECT_EQ(galleryIdentity(one, shape), identity);
  EXPECT_NE(galleryIdentity(two, shape), identity);
  shape.width = 400;
  EXPECT_NE(galleryIdentity(one, shape), identity);
  shape.width = 480;
  shape.folder = "elsewhere";
  EXPECT_EQ(galleryIdentity(one, shape), identity);
}

}  // namespace
}  // namespace carom::demos
