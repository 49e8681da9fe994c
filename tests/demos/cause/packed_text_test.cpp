#include "demos/cause/packed_text.h"

#include <fstream>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

std::filesystem::path written(const TemporaryFolder& folder, const std::vector<std::uint8_t>& bytes) {
  return folder.file("packed", std::string(bytes.begin(), bytes.end()));
}

TEST(PackedText, ComesBackAsItWasAndIsSmaller) {
  const TemporaryFolder folder;
  for (const std::string& text :
       {std::string(), std::string("one"), std::string(100000, '7') + "\n\x80\xff"}) {
    const std::vector<std::uint8_t> bytes = packedText(text);
    EXPECT_EQ(unpackedText(written(folder, bytes)), text);
    EXPECT_LT(bytes.size(), 2000u);
  }
}

TEST(PackedText, ThatIsDamagedIsRefused) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> bytes = packedText("some text");
  bytes.resize(bytes.size() / 2);
  EXPECT_THROW(unpackedText(written(folder, bytes)), InputError);
  EXPECT_THROW(unpackedText(folder.file("other", "{}")), InputError);
}

}  // namespace
}  // namespace carom::demos
