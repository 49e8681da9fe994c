#include "renderer/image/quick_deflate.h"

#include "engine/foundation/contract.h"

#ifdef CAROM_HAS_ISAL

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <memory>

namespace carom::renderer {

bool hasQuickDeflate() {
  return true;
}

namespace {

// ISA-L 2.30 packs the beginning of a stream without history to other bytes where its isal_zstream lies at
// some other addresses: 17 of 20000 inputs did, packed twice. The first bytes therefore go into a stored
// block (RFC 1951, 3.2.4), and the rest has these as its dictionary.
constexpr std::size_t kStored = 8;

std::vector<std::uint8_t> storedBlock(std::span<const std::uint8_t> bytes, bool is_last) {
  constexpr std::size_t kHead = 5;
  std::vector<std::uint8_t> block(kHead + bytes.size());
  block[0] = is_last ? 1 : 0;
  block[1] = static_cast<std::uint8_t>(bytes.size());
  block[3] = static_cast<std::uint8_t>(~block[1]);
  block[4] = 0xff;
  std::copy(bytes.begin(), bytes.end(), block.begin() + kHead);
  return block;
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, bool is_last) {
  // The library's counts have 32 bits: input and output go in parts.
  constexpr std::size_t kMostIn = 1u << 30;
  constexpr std::size_t kLeastOut = 1u << 16;
  if (bytes.size() <= kStored) return storedBlock(bytes, is_last);
  std::vector<std::uint8_t> packed = storedBlock(bytes.first(kStored), false);
  std::size_t size = packed.size();
  std::array<std::uint8_t, kStored> dictionary{};
  std::copy_n(bytes.begin(), kStored, dictionary.begin());
  bytes = bytes.subspan(kStored);

  const auto stream = std::make_unique<isal_zstream>();
  std::vector<std::uint8_t> work(ISAL_DEF_LVL1_DEFAULT);
  isal_deflate_init(stream.get());
  stream->level = 1;
  stream->level_buf = work.data();
  stream->level_buf_size = static_cast<std::uint32_t>(work.size());
  stream->gzip_flag = IGZIP_DEFLATE;
  stream->flush = FULL_FLUSH;
  const int primed = isal_deflate_set_dict(stream.get(), dictionary.data(), kStored);
  REQUIRE(primed == COMP_OK, primed);

  packed.resize(std::min(bytes.size() / 4 + kLeastOut, kMostIn));
  const auto isDone = [&] {
    if (is_last) return stream->internal_state.state == ZSTATE_END;
    return bytes.empty() && stream->avail_in == 0 && stream->avail_out > 0;
  };
  do {
    if (stream->avail_in == 0) {
      const std::span<const std::uint8_t> part = bytes.first(std::min(bytes.size(), kMostIn));
      bytes = bytes.subspan(part.size());
      stream->next_in = const_cast<std::uint8_t*>(part.data());
      stream->avail_in = static_cast<std::uint32_t>(part.size());
      stream->end_of_stream = is_last && bytes.empty() ? 1 : 0;
    }
    if (packed.size() - size < kLeastOut) packed.resize(packed.size() + packed.size() / 2 + kLeastOut);
    stream->next_out = packed.data() + size;
    const std::size_t room = std::min(packed.size() - size, kMostIn);
    stream->avail_out = static_cast<std::uint32_t>(room);
    const int outcome = isal_deflate(stream.get());
    REQUIRE(outcome == COMP_OK, outcome);
    size += room - stream->avail_out;
  } while (!isDone());
  packed.resize(size);
  return packed;
}

}  // namespace

std::vector<std::uint8_t> quickDeflate(std::span<const std::uint8_t> bytes) {
  const DeflatedPart whole = quickDeflatePart(bytes, true);
  constexpr std::size_t kHead = 2;
  std::vector<std::uint8_t> stream(kHead + whole.packed.size());
  stream[0] = 0x78, stream[1] = 0x01;
  std::copy(whole.packed.begin(), whole.packed.end(), stream.begin() + kHead);
  for (const int shift : {24, 16, 8, 0})
    stream.push_back(static_cast<std::uint8_t>(whole.adler >> shift & 0xff));
  return stream;
}

DeflatedPart quickDeflatePart(std::span<const std::uint8_t> bytes, bool is_last) {
  return {deflated(bytes, is_last), isal_adler32(1, bytes.data(), bytes.size())};
}

}  // namespace carom::renderer

#else

namespace carom::renderer {

bool hasQuickDeflate() {
  return false;
}

std::vector<std::uint8_t> quickDeflate(std::span<const std::uint8_t>) {
  REQUIRE(hasQuickDeflate());
  return {};
}

DeflatedPart quickDeflatePart(std::span<const std::uint8_t>, bool) {
  REQUIRE(hasQuickDeflate());
  return {};
}

}  // namespace carom::renderer

#endif
