// Groups stand in their order, names are texts and links, and the page names nothing outside its folder.
#include "demos/gallery/gallery_index.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

GalleryEntry entryOf(const std::string& name, const std::string& group) {
  GalleryEntry entry;
  entry.name = name;
  entry.group = group;
  entry.description = "<b>bold</b> & \"quoted\"";
  entry.command = "carom render " + name;
  return entry;
}

TEST(GalleryIndex, PutsKnownGroupsFirstAndTheRestLast) {
  const std::vector<GalleryEntry> entries = {entryOf("a", "more"), entryOf("b", "zoo"),
                                             entryOf("c", "machines"), entryOf("d", "the paper"),
                                             entryOf("e", "alphabet")};
  EXPECT_EQ(galleryGroups(entries),
            (std::vector<std::string>{"the paper", "machines", "alphabet", "zoo", "more"}));
}

TEST(GalleryIndex, EscapesTextsAndLinks) {
  const std::vector<GalleryEntry> entries = {entryOf("50% \"x\" scene", "more")};
  const std::string page = galleryIndex(entries);
  EXPECT_EQ(page.find("<b>bold"), std::string::npos);
  EXPECT_NE(page.find("href=\"scenes/50%25%20%22x%22%20scene.html\""), std::string::npos) << page;
  EXPECT_NE(page.find("1 scene,"), std::string::npos);
  EXPECT_EQ(page.find("://"), std::string::npos) << "leads nowhere else";
  EXPECT_EQ(page.find("<!--COUNT"), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
