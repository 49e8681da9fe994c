#include "demos/record/npy_file.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

std::string written(NpyType type, const std::vector<std::size_t>& shape, auto&& add,
                    std::size_t text_length = 0) {
  const TemporaryFolder folder;
  NpyFile array(folder.path() / "a.npy", type, shape, text_length);
  add(array);
  array.commit();
  return readTextFile(folder.path() / "a.npy");
}

/// The dictionary, after everything before and behind it has been checked against the format's description.
std::string dictionary(const std::string& file) {
  EXPECT_EQ(file.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length =
      static_cast<unsigned char>(file.at(8)) + 256u * static_cast<unsigned char>(file.at(9));
  EXPECT_EQ((10 + length) % 64, 0u) << "the elements begin at a multiple of 64 bytes";
  const std::string text = file.substr(10, length);
  EXPECT_EQ(text.back(), '\n');
  const std::size_t end = text.find('}') + 1;
  EXPECT_EQ(text.find_first_not_of(' ', end), length - 1) << "spaces up to the line's end";
  return text.substr(0, end);
}

std::string elements(const std::string& file) {
  return file.substr(10 + static_cast<unsigned char>(file.at(8)) +
                     256u * static_cast<unsigned char>(file.at(9)));
}

TEST(NpyFile, DoublesAreLittleEndianBehindTheHeaderThatNumpyDescribes) {
  const std::string file = written(NpyType::kFloat64, {2}, [](NpyFile& array) {
    array.add(1.0);
    array.add(-2.5);
  });
  EXPECT_EQ(dictionary(file), "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }");
  EXPECT_EQ(elements(file), std::string("\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\x04\xc0", 16));
}

TEST(NpyFile, BytesOfSeveralIndicesFollowEachOther) {
  const std::string file = written(NpyType::kUint8, {3, 1, 2}, [](NpyFile& array) {
    for (std::uint8_t i = 0; i < 6; ++i) array.add(i);
  });
  EXPECT_EQ(dictionary(file), "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 1, 2), }");
  EXPECT_EQ(elements(file), std::string("\0\1\2\3\4\5", 6));
}

TEST(NpyFile, TextsArePaddedToTheLongest) {
  const std::string file = written(
      NpyType::kText, {2},
      [](NpyFile& array) {
        array.add(U"a\u00e9");
        array.add(U"\U0001f3b1");
      },
      2);
  EXPECT_EQ(dictionary(file), "{'descr': '<U2', 'fortran_order': False, 'shape': (2,), }");
  EXPECT_EQ(elements(file), std::string("a\0\0\0\xe9\0\0\0\xb1\xf3\x01\0\0\0\0\0", 16));
}

TEST(NpyFile, AnArrayWithoutElementsIsAHeader) {
  EXPECT_EQ(elements(written(NpyType::kFloat64, {0, 3}, [](NpyFile&) {})), "");
}

TEST(NpyFile, NothingIsLeftOfAnArrayThatIsNotFinished) {
  const TemporaryFolder folder;
  {
    NpyFile array(folder.path() / "a.npy", NpyType::kFloat64, {2});
    array.add(1.0);
    EXPECT_THROW(array.commit(), ContractViolation);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(NpyFile, MoreElementsThanTheShapeHoldsAreRefused) {
  const TemporaryFolder folder;
  NpyFile array(folder.path() / "a.npy", NpyType::kFloat64, {1});
  array.add(1.0);
  EXPECT_THROW(array.add(2.0), ContractViolation);
}

TEST(NpyFile, APathThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.file("no_folder", "") / "a.npy";
  const std::string message = thrownMessage<CannotWrite>([&] { NpyFile(path, NpyType::kFloat64, {1}); });
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
}

}  // namespace
}  // namespace carom::demos
