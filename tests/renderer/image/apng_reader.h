#pragma once
// A reader of animated PNG files of 8-bit RGB, written from the texts of PNG 1.2 and APNG 1.0 alone: what
// ours are held against.

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "renderer/image/png_animation.h"

namespace carom::renderer {

inline std::uint32_t number(const std::uint8_t* at, int bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | at[i];
  return value;
}

inline std::uint8_t paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  return static_cast<std::uint8_t>(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

/// The rows of 8-bit RGB in a zlib stream, by the text of PNG 1.2 alone.
inline Image unpacked(const std::vector<std::uint8_t>& stream, int width, int height) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> raw((row_bytes + 1) * static_cast<std::size_t>(height));
  uLongf size = raw.size();
  EXPECT_EQ(uncompress(raw.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, raw.size());
  Image image{width, height, std::vector<std::uint8_t>(row_bytes * static_cast<std::size_t>(height))};
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::uint8_t* in = raw.data() + y * (row_bytes + 1);
    std::uint8_t* out = image.rgb.data() + y * row_bytes;
    for (std::size_t i = 0; i < row_bytes; ++i) {
      const int a = i < 3 ? 0 : out[i - 3], b = y == 0 ? 0 : *(out + i - row_bytes);
      const int c = i < 3 || y == 0 ? 0 : *(out + i - 3 - row_bytes);
      const int predicted[] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
      out[i] = static_cast<std::uint8_t>(in[i + 1] + predicted[in[0]]);
    }
  }
  return image;
}

struct Decoded {
  std::vector<Image> frames;
  FrameDelay delay;
};

/// An independent reader of APNG 1.0: checks lengths, sums and sequence numbers.
inline Decoded decoded(const std::vector<std::uint8_t>& file) {
  Decoded result;
  Image canvas;
  std::uint32_t announced = 0, sequence = 0;
  int part[4] = {};
  std::vector<std::uint8_t> stream;
  const auto finish = [&] {
    if (stream.empty()) return;
    const Image cut = unpacked(stream, part[0], part[1]);
    for (int y = 0; y < part[1]; ++y)
      std::memcpy(const_cast<std::uint8_t*>(canvas.pixel(part[2], part[3] + y)), cut.pixel(0, y),
                  3 * static_cast<std::size_t>(part[0]));
    result.frames.push_back(canvas);
    stream.clear();
  };
  std::string last;
  for (std::size_t at = 8; at < file.size();) {
    const std::uint8_t* head = file.data() + at;
    const std::size_t length = number(head, 4);
    const std::uint8_t* data = head + 8;
    last.assign(head + 4, head + 8);
    EXPECT_EQ(crc32(0, head + 4, static_cast<uInt>(length + 4)), number(data + length, 4)) << last;
    if (last == "IHDR") {
      canvas = {static_cast<int>(number(data, 4)), static_cast<int>(number(data + 4, 4)), {}};
      canvas.rgb.resize(static_cast<std::size_t>(3 * canvas.width * canvas.height));
    } else if (last == "acTL") {
      announced = number(data, 4);
      EXPECT_EQ(number(data + 4, 4), 0u);
    } else if (last == "fcTL") {
      finish();
      EXPECT_EQ(number(data, 4), sequence++);
      for (int i = 0; i < 4; ++i) part[i] = static_cast<int>(number(data + 4 + 4 * i, 4));
      result.delay = {static_cast<std::uint16_t>(number(data + 20, 2)),
                      static_cast<std::uint16_t>(number(data + 22, 2))};
    } else if (last == "IDAT") {
      stream.insert(stream.end(), data, data + length);
    } else if (last == "fdAT") {
      EXPECT_EQ(number(data, 4), sequence++);
      stream.insert(stream.end(), data + 4, data + length);
    }
    at += 12 + length;
  }
  finish();
  EXPECT_EQ(last, "IEND");
  EXPECT_EQ(announced, result.frames.size());
  return result;
}

}  // namespace carom::renderer
