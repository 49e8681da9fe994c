#include "demos/record/npy_file.h"

#include <algorithm>
#include <bit>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kPreamble = 10;  // magic, version and the header's length

std::string littleEndian(std::uint64_t word, std::size_t bytes) {
  std::string raw;
  for (std::size_t i = 0; i < bytes; ++i) raw.push_back(static_cast<char>((word >> (8 * i)) & 0xff));
  return raw;
}

std::string typeName(NpyType type, std::size_t text_length) {
  if (type == NpyType::kFloat64) return "<f8";
  return type == NpyType::kUint8 ? "|u1" : "<U" + std::to_string(text_length);
}

/// A Python tuple: "(3,)", "(3, 4)".
std::string tuple(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (const std::size_t side : shape) text += std::to_string(side) + (shape.size() == 1 ? "," : ", ");
  if (shape.size() > 1) text.resize(text.size() - 2);
  return text + ")";
}

std::string header(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + tuple(shape) + ", }";
  const std::size_t used = kPreamble + text.size() + 1;
  text.append((kAlignment - used % kAlignment) % kAlignment, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + littleEndian(text.size(), 2) + text;
}

}  // namespace

NpyFile::NpyFile(const std::filesystem::path& path, NpyType type, const std::vector<std::size_t>& shape,
                 std::size_t text_length)
    : file_(path), type_(type), text_length_(std::max<std::size_t>(1, text_length)) {
  for (const std::size_t side : shape) missing_ *= side;
  file_.write(header(typeName(type, text_length_), shape));
}

void NpyFile::bytes(const std::string& raw) {
  REQUIRE(missing_ > 0);
  --missing_;
  file_.write(raw);
}

void NpyFile::add(double value) {
  REQUIRE(type_ == NpyType::kFloat64);
  bytes(littleEndian(std::bit_cast<std::uint64_t>(value), 8));
}

void NpyFile::add(std::uint8_t value) {
  REQUIRE(type_ == NpyType::kUint8);
  bytes(littleEndian(value, 1));
}

void NpyFile::add(const std::u32string& text) {
  REQUIRE(type_ == NpyType::kText && text.size() <= text_length_, text.size(), text_length_);
  std::string raw;
  for (const char32_t character : text) raw += littleEndian(character, 4);
  raw.resize(4 * text_length_, '\0');
  bytes(raw);
}

void NpyFile::commit() {
  REQUIRE(missing_ == 0, missing_);
  file_.commit();
}

}  // namespace carom::demos
