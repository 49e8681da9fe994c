#pragma once
// One array as NumPy loads it: the .npy format, version 1.0 (numpy/lib/format.py: magic, version, length and
// text of a Python dictionary padded to 64 bytes, then the elements, little-endian, last index fastest).
// Written while a run goes on; the shape is known from the start. Tested in
// tests/demos/record/npy_file_test.cpp.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "demos/system/atomic_file.h"

namespace carom::demos {

enum class NpyType {
  kFloat64,  ///< '<f8'
  kUint8,    ///< '|u1'
  kText      ///< '<U' and the number of characters of the longest text.
};

class NpyFile {
 public:
  /// Throws CannotWrite, as do the others; until `commit` there is no file of that name. `text_length` is
  /// that of kText, in characters.
  NpyFile(const std::filesystem::path& path, NpyType type, const std::vector<std::size_t>& shape,
          std::size_t text_length = 0);

  void add(double value);
  void add(std::uint8_t value);
  void add(const std::u32string& text);
  /// As many elements as the shape holds must have been added.
  void commit();

 private:
  void bytes(const std::string& raw);

  AtomicFile file_;
  NpyType type_;
  std::size_t text_length_ = 0;
  std::size_t missing_ = 1;  // elements not added yet
};

}  // namespace carom::demos
