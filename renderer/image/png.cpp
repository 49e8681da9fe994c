#include "renderer/image/png.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <istream>
#include <optional>
#include <span>

#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"
#include "renderer/image/quick_deflate.h"

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
  auto* in = static_cast<std::istream*>(png_get_io_ptr(png));
  if (!in->read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count)))
    png_error(png, "the file is truncated");
}

// A file's rows as they lie in the file before they are filtered, and what the header says of them.
struct Rows {
  int width = 0;
  int height = 0;
  int bits = 8;
  int color_type = PNG_COLOR_TYPE_RGB;
  std::size_t pixel_bytes = 3;
  bool srgb = true;
  const std::uint8_t* data = nullptr;
  std::size_t rowBytes() const { return pixel_bytes * static_cast<std::size_t>(width); }
  const std::uint8_t* row(int y) const { return data + rowBytes() * static_cast<std::size_t>(y); }
};

enum class Filter : std::uint8_t { kSub = 1, kUp = 2 };

// How libpng packs rows; quick files with a deflate of our own hand it chunks instead.
enum class Zlib { kSmall, kSub, kUp };

void writeHead(png_structp png, png_infop info, const Rows& rows, png_textp text, int text_count) {
  png_set_IHDR(png, info, static_cast<png_uint_32>(rows.width), static_cast<png_uint_32>(rows.height),
               rows.bits, rows.color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (rows.srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(png, info, text, text_count);
  png_write_info(png, info);
}

// Small: every filter is tried and deflate takes its time, for reports, which hold many images. Level 1, the
// sub filter and run lengths are what plain libpng does fastest to a picture: a fifth of its default time for
// a quarter more bytes. Depths and ids vary along both axes, and what differs from the row above is short.
bool writeRows(png_structp png, png_infop info, const Rows& rows, png_textp text, int text_count, Zlib zlib) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (zlib != Zlib::kSmall) {
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, zlib == Zlib::kSub ? PNG_FILTER_SUB : PNG_FILTER_UP);
  }
  if (zlib == Zlib::kSub) png_set_compression_strategy(png, Z_RLE);
  writeHead(png, info, rows, text, text_count);
  for (int y = 0; y < rows.height; ++y) png_write_row(png, rows.row(y));
  png_write_end(png, info);
  return true;
}

constexpr std::size_t kChunkBytes = 1u << 20;

bool writePacked(png_structp png, png_infop info, const Rows& rows, png_textp text, int text_count,
                 std::span<const std::uint8_t> packed) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  constexpr std::array<png_byte, 5> kData = {'I', 'D', 'A', 'T', 0}, kEnd = {'I', 'E', 'N', 'D', 0};
  writeHead(png, info, rows, text, text_count);
  for (std::size_t at = 0; at < packed.size(); at += kChunkBytes)
    png_write_chunk(png, kData.data(), packed.data() + at, std::min(kChunkBytes, packed.size() - at));
  png_write_chunk(png, kEnd.data(), nullptr, 0);
  return true;
}

bool writeChunk(png_structp png, const png_byte* kind, const std::uint8_t* data, std::size_t size) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_write_chunk(png, kind, data, size);
  return true;
}

// Each row after the byte that names its filter (PNG 1.2, section 6): what differs from the pixel to the
// left, or from the one above; outside the image is 0.
std::vector<std::uint8_t> filtered(const Rows& rows, Filter filter) {
  const std::size_t row_bytes = rows.rowBytes();
  std::vector<std::uint8_t> bytes((row_bytes + 1) * static_cast<std::size_t>(rows.height));
  std::uint8_t* out = bytes.data();
  for (int y = 0; y < rows.height; ++y, out += row_bytes) {
    const std::uint8_t* row = rows.row(y);
    *out++ = static_cast<std::uint8_t>(filter);
    if (filter == Filter::kSub) {
      std::copy_n(row, rows.pixel_bytes, out);
      for (std::size_t i = rows.pixel_bytes; i < row_bytes; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - row[i - rows.pixel_bytes]);
    } else if (y == 0) {
      std::copy_n(row, row_bytes, out);
    } else {
      const std::uint8_t* above = rows.row(y - 1);
      for (std::size_t i = 0; i < row_bytes; ++i) out[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    }
  }
  return bytes;
}

struct Header {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  std::size_t row_bytes = 0;
  std::size_t row_samples = 0;
  int channels = 3;
  int bits = 8;
  int passes = 1;
};

enum class Samples { kRgb8, kAsStored };

// Deflate packs at most 1032 to 1, so that a short file that claims a large image is refused before it is
// given memory.
constexpr std::size_t kMaxDeflateRatio = 1032;

// How the samples of 16 bits lie in memory; a file has the high byte first.
constexpr bool kLowByteFirst = std::endian::native == std::endian::little;

// What the first chunk says, which is of fixed length; libpng checks it again.
constexpr std::size_t kHeadSize = 24;
struct Claimed {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
};

std::uint32_t bigEndian(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
}

std::optional<Claimed> readClaimed(std::istream& in) {
  std::array<std::uint8_t, kHeadSize> head{};
  if (!in.read(reinterpret_cast<char*>(head.data()), kHeadSize) || png_sig_cmp(head.data(), 0, 8) != 0 ||
      std::memcmp(head.data() + 12, "IHDR", 4) != 0)
    return std::nullopt;
  return Claimed{bigEndian(head.data() + 16), bigEndian(head.data() + 20)};
}

// Whatever the file holds becomes 8-bit RGB, or whole samples of the channels and bits it has.
bool readHeader(png_structp png, png_infop info, std::size_t file_size, Samples wanted, Header* header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kMaxPngSide, kMaxPngSide);
  // Of no other chunk do the pixels depend (-1: on none but the critical ones and tRNS). libpng would unpack
  // texts and profiles to whatever length they claim.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
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
  } else if (kLowByteFirst) {
    png_set_swap(png);
  }
  header->passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header->row_bytes = png_get_rowbytes(png, info);
  header->channels = png_get_channels(png, info);
  header->bits = png_get_bit_depth(png, info);
  header->row_samples = std::size_t{header->width} * static_cast<std::size_t>(header->channels);
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

// Where chunks begin: after the file's signature.
constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kLongestKeyword = 79;

// The keyword and text of a tEXt or iTXt chunk (PNG 1.2, 4.2.3); nothing when it is malformed or packed.
std::optional<std::pair<std::string, std::string>> textOf(const std::string& data, bool international) {
  const std::size_t keyword = data.find('\0');
  if (keyword == std::string::npos || keyword == 0 || keyword > kLongestKeyword) return std::nullopt;
  std::size_t begin = keyword + 1;
  if (international) {
    // Whether it is packed, how, the language and the keyword in that language stand before the text.
    if (data.size() < begin + 2 || data[begin] != 0) return std::nullopt;
    const std::size_t language = data.find('\0', begin + 2);
    if (language == std::string::npos) return std::nullopt;
    const std::size_t translated = data.find('\0', language + 1);
    if (translated == std::string::npos) return std::nullopt;
    begin = translated + 1;
  }
  return std::pair{data.substr(0, keyword), data.substr(begin)};
}

// The texts of a file that libpng has found whole, which it was told to pass over.
PngText readText(std::istream& in, const std::string& name) {
  PngText text;
  std::size_t text_bytes = 0;
  in.clear();
  in.seekg(kSignatureSize);
  std::array<std::uint8_t, 8> head{};
  while (in.read(reinterpret_cast<char*>(head.data()), head.size())) {
    const std::size_t length = bigEndian(head.data());
    const std::string kind(head.begin() + 4, head.end());
    if (kind == "IEND") break;
    if (kind != "tEXt" && kind != "iTXt") {
      in.seekg(static_cast<std::streamoff>(length + 4), std::ios::cur);
      continue;
    }
    text_bytes += length;
    if (text_bytes > kMaxPngTextBytes)
      throw InputError("cannot decode PNG '" + name + "': its text chunks are longer than accepted: " +
                       std::to_string(kMaxPngTextBytes) + " bytes in all");
    std::string data(length, '\0');
    std::array<std::uint8_t, 4> sum{};
    if (!in.read(data.data(), static_cast<std::streamsize>(length)) ||
        !in.read(reinterpret_cast<char*>(sum.data()), sum.size()))
      break;
    const uLong of_kind = crc32(0, head.data() + 4, 4);
    if (crc32(of_kind, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(length)) !=
        bigEndian(sum.data()))
      continue;
    if (auto pair = textOf(data, kind == "iTXt")) text.push_back(std::move(*pair));
  }
  return text;
}

void requireAcceptedSize(const Claimed& size, const std::string& name) {
  const bool is_accepted = size.width <= kMaxPngSide && size.height <= kMaxPngSide &&
                           size.width * size.height <= std::uint64_t{kMaxPngPixels};
  if (is_accepted) return;
  throw InputError("cannot decode PNG '" + name + "': it has " + std::to_string(size.width) + " x " +
                   std::to_string(size.height) + " pixels; accepted: at most " +
                   std::to_string(kMaxPngPixels) + ", and " + std::to_string(kMaxPngSide) + " a side");
}

// Decodes to rows where `rowsOf(header)` says; its memory is held by the caller.
template <typename RowsOf>
PngText decode(std::istream& in, const std::string& name, Samples wanted, Header& header,
               const RowsOf& rowsOf) {
  in.seekg(0, std::ios::end);
  const auto file_size = static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0));
  in.seekg(0);
  const std::optional<Claimed> claimed = readClaimed(in);
  if (claimed) requireAcceptedSize(*claimed, name);
  in.clear();
  in.seekg(0);
  std::array<std::uint8_t, kSignatureSize> signature{};
  in.read(reinterpret_cast<char*>(signature.data()), signature.size());
  if (!in || png_sig_cmp(signature.data(), 0, signature.size()) != 0)
    throw InputError("'" + name + "' is no PNG file: its first bytes are not PNG's");
  in.seekg(0);
  ErrorText error;
  const Reader reader(error);
  png_set_read_fn(reader.png, &in, takeBytes);
  const bool complete = readHeader(reader.png, reader.info, file_size, wanted, &header) &&
                        readRows(reader.png, reader.info, header, rowsOf(header));
  if (!complete) throw InputError("cannot decode PNG '" + name + "': " + error.message.data());
  return readText(in, name);
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

std::vector<std::uint8_t> zlibFile(const Rows& rows, Zlib zlib, const PngText& text) {
  std::vector<png_text> chunks = textChunks(text);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(rows.rowBytes() * static_cast<std::size_t>(rows.height) / 6 + 4096);
  ErrorText error;
  const Writer writer(error);
  png_set_write_fn(writer.png, &bytes, appendBytes, nullptr);
  if (!writeRows(writer.png, writer.info, rows, chunks.data(), static_cast<int>(chunks.size()), zlib))
    throw std::runtime_error(std::string("cannot encode PNG: ") + error.message.data());
  return bytes;
}

std::vector<std::uint8_t> packedFile(const Rows& rows, const std::vector<std::uint8_t>& packed,
                                     const PngText& text) {
  std::vector<png_text> chunks = textChunks(text);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(packed.size() + 4096);
  ErrorText error;
  const Writer writer(error);
  png_set_write_fn(writer.png, &bytes, appendBytes, nullptr);
  if (!writePacked(writer.png, writer.info, rows, chunks.data(), static_cast<int>(chunks.size()), packed))
    throw std::runtime_error(std::string("cannot encode PNG: ") + error.message.data());
  return bytes;
}

Rows rowsOf(const Image& image) {
  REQUIRE(image.width > 0 && image.height > 0, image.width, image.height);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  REQUIRE(image.rgb.size() == 3 * pixels, image.rgb.size(), image.width, image.height);
  return {.width = image.width, .height = image.height, .data = image.rgb.data()};
}

}  // namespace

// A picture is packed in bands, none of which refers to another, so that the bytes of a band follow from its
// pixels alone. Files get no larger by it.
struct PngSequence::Bands {
  static constexpr int kRows = 64;
  static int bandsOf(const Rows& rows) { return (rows.height + kRows - 1) / kRows; }

  // A zlib stream (RFC 1950) of the picture.
  std::vector<std::uint8_t> pack(const Rows& rows) {
    const std::size_t size = rows.rowBytes() * static_cast<std::size_t>(rows.height);
    if (rows.width != width || rows.height != height) {
      width = rows.width, height = rows.height;
      pixels.assign(size, 0);
      parts.clear();
    }
    const bool is_first = parts.empty();
    packed = 0;
    parts.resize(static_cast<std::size_t>(bandsOf(rows)));
    std::vector<std::uint8_t> stream = {0x78, 0x01};
    uLong adler = 1;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Rows band = rows;
      band.data = rows.row(static_cast<int>(i) * kRows);
      band.height = std::min(kRows, height - static_cast<int>(i) * kRows);
      const std::size_t bytes = band.rowBytes() * static_cast<std::size_t>(band.height);
      std::uint8_t* known = pixels.data() + (band.data - rows.data);
      if (is_first || std::memcmp(known, band.data, bytes) != 0) {
        std::memcpy(known, band.data, bytes);
        ++packed;
        parts[i] = quickDeflatePart(filtered(band, Filter::kSub), i + 1 == parts.size());
      }
      stream.insert(stream.end(), parts[i].packed.begin(), parts[i].packed.end());
      adler = adler32_combine(adler, parts[i].adler,
                              static_cast<z_off_t>(bytes + static_cast<std::size_t>(band.height)));
    }
    for (const int shift : {24, 16, 8, 0}) stream.push_back(static_cast<std::uint8_t>(adler >> shift & 0xff));
    return stream;
  }

  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  // Of the picture before.
  std::vector<DeflatedPart> parts;   // Its bands.
  int packed = 0;                    // Of them, by the last call.
};

PngSequence::PngSequence() : bands_(std::make_unique<Bands>()) {}
PngSequence::~PngSequence() = default;

std::vector<std::uint8_t> PngSequence::encode(const Image& image, const PngText& text) {
  const Rows rows = rowsOf(image);
  if (!hasQuickDeflate()) {
    bands_->packed = Bands::bandsOf(rows);
    return zlibFile(rows, Zlib::kSub, text);
  }
  return packedFile(rows, bands_->pack(rows), text);
}

int PngSequence::packedBands() const {
  return bands_->packed;
}

std::vector<std::uint8_t> encodePng(const Image& image, const PngText& text, PngDeflate deflate) {
  if (deflate == PngDeflate::kBest) return PngSequence().encode(image, text);
  return zlibFile(rowsOf(image), Zlib::kSub, text);
}

std::vector<std::uint8_t> encodeSmallPng(const Image& image, const PngText& text) {
  return zlibFile(rowsOf(image), Zlib::kSmall, text);
}

std::vector<PngChunk> pngChunks(const std::vector<std::uint8_t>& file) {
  constexpr std::size_t kAround = 12;  // Length, kind and sum.
  std::vector<PngChunk> chunks;
  for (std::size_t at = kSignatureSize; at < file.size();) {
    REQUIRE(at + kAround <= file.size(), at, file.size());
    const std::uint8_t* head = file.data() + at;
    const std::size_t length = bigEndian(head);
    REQUIRE(at + kAround + length <= file.size(), at, length, file.size());
    chunks.push_back({std::string(head + 4, head + 8), {head + 8, head + 8 + length}});
    at += kAround + length;
  }
  return chunks;
}

void appendPngSignature(std::vector<std::uint8_t>& bytes) {
  bytes.insert(bytes.end(), {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
}

void appendPngChunk(std::vector<std::uint8_t>& bytes, const PngChunk& chunk) {
  REQUIRE(chunk.kind.size() == 4, chunk.kind);
  ErrorText error;
  const Writer writer(error);
  png_set_write_fn(writer.png, &bytes, appendBytes, nullptr);
  const auto* kind = reinterpret_cast<const png_byte*>(chunk.kind.c_str());
  if (!writeChunk(writer.png, kind, chunk.data.data(), chunk.data.size()))
    throw std::runtime_error(std::string("cannot encode PNG: ") + error.message.data());
}

std::vector<std::uint8_t> zlibStream(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> stream(size);
  const int outcome = compress2(stream.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 9);
  if (outcome != Z_OK) throw std::bad_alloc();  // of what zlib can fail at here there is nothing else
  stream.resize(size);
  return stream;
}

std::vector<std::uint8_t> encodePng(const Raster& raster, const PngText& text, PngPacking packing,
                                    PngDeflate deflate) {
  REQUIRE(raster.width > 0 && raster.height > 0, raster.width, raster.height);
  REQUIRE(raster.channels >= 1 && raster.channels <= 4, raster.channels);
  REQUIRE(raster.bits == 8 || raster.bits == 16, raster.bits);
  const std::size_t pixels = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
  REQUIRE(raster.samples.size() == pixels * static_cast<std::size_t>(raster.channels), raster.samples.size());
  const std::vector<std::uint8_t> bytes = bytesOf(raster);
  constexpr std::array<int, 4> kColorTypes = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                              PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  const Rows rows{.width = raster.width,
                  .height = raster.height,
                  .bits = raster.bits,
                  .color_type = kColorTypes[static_cast<std::size_t>(raster.channels - 1)],
                  .pixel_bytes = static_cast<std::size_t>(raster.channels * raster.bits / 8),
                  .srgb = raster.bits == 8,
                  .data = bytes.data()};
  if (packing == PngPacking::kSmall) return zlibFile(rows, Zlib::kSmall, text);
  if (deflate == PngDeflate::kBest && hasQuickDeflate())
    return packedFile(rows, quickDeflate(filtered(rows, Filter::kUp)), text);
  return zlibFile(rows, Zlib::kUp, text);
}

DecodedPng decodePng(std::istream& in, const std::string& name) {
  DecodedPng png;
  Header header;
  png.text = decode(in, name, Samples::kRgb8, header, [&png](const Header& read) {
    png.image.rgb.resize(read.row_bytes * read.height);
    return png.image.rgb.data();
  });
  png.image.width = static_cast<int>(header.width);
  png.image.height = static_cast<int>(header.height);
  return png;
}

DecodedPng readPng(const std::filesystem::path& path) {
  std::ifstream file = openInputFile(path);
  return decodePng(file, path.string());
}

DecodedRaster decodePngRaster(std::istream& in, const std::string& name) {
  DecodedRaster png;
  std::vector<std::uint16_t>& samples = png.raster.samples;
  Header header;
  png.text = decode(in, name, Samples::kAsStored, header, [&samples](const Header& read) {
    samples.resize(read.row_samples * read.height);
    auto* bytes = reinterpret_cast<std::uint8_t*>(samples.data());
    // Samples of 8 bits are read into the second half of their memory and spread out from there.
    return read.bits == 8 ? bytes + samples.size() : bytes;
  });
  if (header.bits == 8) {
    const auto* narrow = reinterpret_cast<const std::uint8_t*>(samples.data()) + samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = narrow[i];
  }
  png.raster.width = static_cast<int>(header.width);
  png.raster.height = static_cast<int>(header.height);
  png.raster.channels = header.channels;
  png.raster.bits = header.bits;
  return png;
}

DecodedRaster readPngRaster(const std::filesystem::path& path) {
  std::ifstream file = openInputFile(path);
  return decodePngRaster(file, path.string());
}

PngText readPngText(const std::filesystem::path& path) {
  InputFile file = tryInputFile(path);
  if (!file.problem.empty() || !readClaimed(file.stream)) return {};
  try {
    return readText(file.stream, path.string());
  } catch (const InputError&) {
    return {};
  }
}

std::int64_t pngPixels(const std::filesystem::path& path) {
  InputFile file = tryInputFile(path);
  if (!file.problem.empty()) return 0;
  const std::optional<Claimed> size = readClaimed(file.stream);
  return size ? static_cast<std::int64_t>(size->width * size->height) : 0;
}

}  // namespace carom::renderer
