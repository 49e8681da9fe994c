#include "renderer/quick_deflate.h"

#include "engine/foundation/contract.h"

#ifdef CAROM_HAS_ISAL

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace carom::renderer {

bool hasQuickDeflate() {
  return true;
}

namespace {

struct Form {
  std::uint16_t wrapped = IGZIP_ZLIB;
  std::uint16_t flush = NO_FLUSH;
  bool ends = true;  // The stream.
};

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, const Form& form) {
  // The library's counts have 32 bits: input and output go in parts.
  constexpr std::size_t kMostIn = 1u << 30;
  constexpr std::size_t kLeastOut = 1u << 16;
  const auto stream = std::make_unique<isal_zstream>();
  std::vector<std::uint8_t> work(ISAL_DEF_LVL1_DEFAULT);
  isal_deflate_init(stream.get());
  stream->level = 1;
  stream->level_buf = work.data();
  stream->level_buf_size = static_cast<std::uint32_t>(work.size());
  stream->gzip_flag = form.wrapped;
  stream->flush = form.flush;

  std::vector<std::uint8_t> packed(std::min(bytes.size() / 4 + kLeastOut, kMostIn));
  std::size_t size = 0;
  const auto isDone = [&] {
    if (form.ends) return stream->internal_state.state == ZSTATE_END;
    return bytes.empty() && stream->avail_in == 0 && stream->avail_out > 0;
  };
  do {
    if (stream->avail_in == 0) {
      const std::span<const std::uint8_t> part = bytes.first(std::min(bytes.size(), kMostIn));
      bytes = bytes.subspan(part.size());
      stream->next_in = const_cast<std::uint8_t*>(part.data());
      stream->avail_in = static_cast<std::uint32_t>(part.size());
      stream->end_of_stream = form.ends && bytes.empty() ? 1 : 0;
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
  return deflated(bytes, {});
}

DeflatedPart quickDeflatePart(std::span<const std::uint8_t> bytes, bool is_last) {
  return {deflated(bytes, {.wrapped = IGZIP_DEFLATE, .flush = FULL_FLUSH, .ends = is_last}),
          isal_adler32(1, bytes.data(), bytes.size())};
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
