#include "renderer/png.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <iterator>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

// libpng reports an error by calling us and expects not to return: we jump. So that no jump skips a
// destructor, the functions between setjmp and libpng hold plain data only, and what needs a destructor lives
// in their callers.
struct ErrorText {
  std::array<char, 160> message{};
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  auto* error = static_cast<ErrorText*>(png_get_error_ptr(png));
  std::strncpy(error->message.data(), message, error->message.size() - 1);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

struct Writer {
  explicit Writer(ErrorText& error)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, onError, onWarning)) {
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  png_structp png = nullptr;
  png_infop info = nullptr;
};

struct Reader {
  explicit Reader(ErrorText& error)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, onError, onWarning)) {
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) {
      png_destroy_read_struct(&png, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  png_structp png = nullptr;
  png_infop info = nullptr;
};

struct ByteSource {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
  std::size_t at = 0;
};

void appendBytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto* out = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bool appended = true;
  try {
    out->insert(out->end(), bytes, bytes + count);
  } catch (const std::bad_alloc&) {
    appended = false;
  }
  if (!appended) png_error(png, "out of memory");
}

void takeBytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto* source = static_cast<ByteSource*>(png_get_io_ptr(png));
  if (source->size - source->at < count) png_error(png, "the file is truncated");
  std::memcpy(bytes, source->data + source->at, count);
  source->at += count;
}

// Level 1, the sub filter and run lengths are what plain libpng does fastest: a fifth of its default time for
// a quarter more bytes.
bool writeImage(png_structp png, png_infop info, const Image& image, png_textp text, int text_count) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, 1);
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(png, info, text, text_count);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.pixel(0, y));
  png_write_end(png, info);
  return true;
}

// Small: every filter is tried and deflate takes its time, for reports, which hold many images. Quick: depths
// and ids vary along both axes, and what differs from the row above is short.
bool writeRaster(png_structp png, png_infop info, const Raster& raster, const std::uint8_t* bytes,
                 png_textp text, int text_count, PngPacking packing) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (packing == PngPacking::kQuick) {
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  }
  constexpr std::array<int, 4> kColorTypes = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                              PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  png_set_IHDR(png, info, static_cast<png_uint_32>(raster.width), static_cast<png_uint_32>(raster.height),
               raster.bits, kColorTypes[static_cast<std::size_t>(raster.channels - 1)], PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (raster.bits == 8) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(png, info, text, text_count);
  png_write_info(png, info);
  const std::size_t stride = png_get_rowbytes(png, info);
  for (int y = 0; y < raster.height; ++y) png_write_row(png, bytes + stride * static_cast<std::size_t>(y));
  png_write_end(png, info);
  return true;
}

struct Header {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  std::size_t row_bytes = 0;
  int channels = 3;
  int bits = 8;
  int passes = 1;
};

enum class Samples { kRgb8, kAsStored };

// Deflate packs at most 1032 to 1, so that a short file that claims a large image is refused before it is
// given memory.
constexpr std::size_t kMaxDeflateRatio = 1032;

// Whatever the file holds becomes 8-bit RGB, or whole samples of the channels and bits it has.
bool readHeader(png_structp png, png_infop info, std::size_t file_size, Samples wanted, Header* header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kMaxPngSide, kMaxPngSide);
  png_read_info(png, info);
  header->width = png_get_image_width(png, info);
  header->height = png_get_image_height(png, info);
  if (png_get_rowbytes(png, info) * header->height / kMaxDeflateRatio > file_size)
    png_error(png, "the file is truncated");
  png_set_expand(png);
  if (wanted == Samples::kRgb8) {
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_strip_alpha(png);
  }
  header->passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header->row_bytes = png_get_rowbytes(png, info);
  header->channels = png_get_channels(png, info);
  header->bits = png_get_bit_depth(png, info);
  return true;
}

bool readRows(png_structp png, png_infop info, const Header& header, std::uint8_t* rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (int pass = 0; pass < header.passes; ++pass)
    for (png_uint_32 y = 0; y < header.height; ++y) png_read_row(png, rows + header.row_bytes * y, nullptr);
  png_read_end(png, info);
  return true;
}

bool isAscii(const std::string& s) {
  return std::all_of(s.begin(), s.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

// libpng copies the strings; the pointers only have to live through png_set_text.
std::vector<png_text> textChunks(const PngText& text) {
  std::vector<png_text> chunks;
  for (const auto& [keyword, value] : text) {
    REQUIRE(!keyword.empty() && keyword.size() <= 79 && isAscii(keyword), keyword);
    png_text chunk{};
    chunk.compression = isAscii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<png_charp>(keyword.c_str());
    chunk.text = const_cast<png_charp>(value.c_str());
    chunks.push_back(chunk);
  }
  return chunks;
}

std::vector<std::uint8_t> readBytes(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw InputError("cannot read '" + path.string() + "': it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read '" + path.string() + "': " + std::strerror(errno));
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError("cannot read '" + path.string() + "': " + std::strerror(errno));
  return bytes;
}

PngText readText(const Reader& reader) {
  png_textp chunks = nullptr;
  const int count = png_get_text(reader.png, reader.info, &chunks, nullptr);
  PngText text;
  for (int i = 0; i < count; ++i) {
    const std::size_t length = chunks[i].compression > 0 ? chunks[i].itxt_length : chunks[i].text_length;
    text.emplace_back(chunks[i].key, std::string(chunks[i].text, length));
  }
  return text;
}

struct DecodedBytes {
  Header header;
  std::vector<std::uint8_t> bytes;
  PngText text;
};

DecodedBytes decode(const std::filesystem::path& path, Samples wanted) {
  const std::vector<std::uint8_t> file = readBytes(path);
  if (file.size() < 8 || png_sig_cmp(file.data(), 0, 8) != 0)
    throw InputError("'" + path.string() + "' is no PNG file: its first bytes are not PNG's");
  ErrorText error;
  const Reader reader(error);
  ByteSource source{file.data(), file.size(), 0};
  png_set_read_fn(reader.png, &source, takeBytes);

  DecodedBytes decoded;
  bool complete = readHeader(reader.png, reader.info, file.size(), wanted, &decoded.header);
  if (complete) {
    decoded.bytes.resize(decoded.header.row_bytes * decoded.header.height);
    complete = readRows(reader.png, reader.info, decoded.header, decoded.bytes.data());
  }
  if (!complete) throw InputError("cannot decode PNG '" + path.string() + "': " + error.message.data());
  decoded.text = readText(reader);
  return decoded;
}

// PNG stores the high byte of a 16-bit sample first.
std::vector<std::uint8_t> bytesOf(const Raster& raster) {
  if (raster.bits == 8) return {raster.samples.begin(), raster.samples.end()};
  std::vector<std::uint8_t> bytes(2 * raster.samples.size());
  for (std::size_t i = 0; i < raster.samples.size(); ++i) {
    bytes[2 * i] = static_cast<std::uint8_t>(raster.samples[i] >> 8);
    bytes[2 * i + 1] = static_cast<std::uint8_t>(raster.samples[i] & 0xff);
  }
  return bytes;
}

std::vector<std::uint16_t> samplesOf(const std::vector<std::uint8_t>& bytes, int bits) {
  if (bits == 8) return {bytes.begin(), bytes.end()};
  std::vector<std::uint16_t> samples(bytes.size() / 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  return samples;
}

}  // namespace

std::vector<std::uint8_t> encodePng(const Image& image, const PngText& text) {
  REQUIRE(image.width > 0 && image.height > 0, image.width, image.height);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  REQUIRE(image.rgb.size() == 3 * pixels, image.rgb.size(), image.width, image.height);
  std::vector<png_text> chunks = textChunks(text);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels / 2 + 4096);
  ErrorText error;
  const Writer writer(error);
  png_set_write_fn(writer.png, &bytes, appendBytes, nullptr);
  if (!writeImage(writer.png, writer.info, image, chunks.data(), static_cast<int>(chunks.size())))
    throw std::runtime_error(std::string("cannot encode PNG: ") + error.message.data());
  return bytes;
}

std::vector<std::uint8_t> encodePng(const Raster& raster, const PngText& text, PngPacking packing) {
  REQUIRE(raster.width > 0 && raster.height > 0, raster.width, raster.height);
  REQUIRE(raster.channels >= 1 && raster.channels <= 4, raster.channels);
  REQUIRE(raster.bits == 8 || raster.bits == 16, raster.bits);
  const std::size_t pixels = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
  REQUIRE(raster.samples.size() == pixels * static_cast<std::size_t>(raster.channels), raster.samples.size());
  std::vector<png_text> chunks = textChunks(text);
  const std::vector<std::uint8_t> rows = bytesOf(raster);
  std::vector<std::uint8_t> bytes;
  ErrorText error;
  const Writer writer(error);
  png_set_write_fn(writer.png, &bytes, appendBytes, nullptr);
  if (!writeRaster(writer.png, writer.info, raster, rows.data(), chunks.data(),
                   static_cast<int>(chunks.size()), packing))
    throw std::runtime_error(std::string("cannot encode PNG: ") + error.message.data());
  return bytes;
}

DecodedPng readPng(const std::filesystem::path& path) {
  DecodedBytes decoded = decode(path, Samples::kRgb8);
  DecodedPng png;
  png.image.width = static_cast<int>(decoded.header.width);
  png.image.height = static_cast<int>(decoded.header.height);
  png.image.rgb = std::move(decoded.bytes);
  png.text = std::move(decoded.text);
  return png;
}

DecodedRaster readPngRaster(const std::filesystem::path& path) {
  DecodedBytes decoded = decode(path, Samples::kAsStored);
  DecodedRaster png;
  png.raster.width = static_cast<int>(decoded.header.width);
  png.raster.height = static_cast<int>(decoded.header.height);
  png.raster.channels = decoded.header.channels;
  png.raster.bits = decoded.header.bits;
  png.raster.samples = samplesOf(decoded.bytes, decoded.header.bits);
  png.text = std::move(decoded.text);
  return png;
}

}  // namespace carom::renderer
