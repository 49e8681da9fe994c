#include "demos/asset/jpeg_picture.h"

#include "engine/foundation/contract.h"

#ifdef CAROM_HAS_JPEG
#include <csetjmp>
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>
#endif

namespace carom::demos {

#ifdef CAROM_HAS_JPEG
namespace {

constexpr double kMostPixels = 0x1p25;

/// libjpeg ends by a jump; nothing that is to be destroyed may be made between it and its mark.
struct Failure {
  jpeg_error_mgr manager;  // Must be the first: libjpeg knows only this.
  std::jmp_buf mark;
  char text[JMSG_LENGTH_MAX];
};

[[noreturn]] void fail(j_common_ptr info) {
  auto* failure = reinterpret_cast<Failure*>(info->err);
  info->err->format_message(info, failure->text);
  std::longjmp(failure->mark, 1);
}

void keepSilent(j_common_ptr, int) {}

/// False with the failure's text.
bool decode(std::span<const std::uint8_t> file, SurfacePicture& picture, Failure& failure) {
  jpeg_decompress_struct info;
  info.err = jpeg_std_error(&failure.manager);
  failure.manager.error_exit = fail;
  failure.manager.emit_message = keepSilent;
  if (setjmp(failure.mark) != 0) {
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, file.data(), static_cast<unsigned long>(file.size()));
  jpeg_read_header(&info, TRUE);
  info.out_color_space = JCS_RGB;
  info.dct_method = JDCT_ISLOW;
  if (static_cast<double>(info.image_width) * info.image_height > kMostPixels) {
    std::snprintf(failure.text, sizeof failure.text, "more than 32 million pixels");
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_start_decompress(&info);
  picture.width = static_cast<int>(info.output_width);
  picture.height = static_cast<int>(info.output_height);
  const std::size_t row = 3 * static_cast<std::size_t>(info.output_width);
  picture.rgb.resize(row * info.output_height);
  while (info.output_scanline < info.output_height) {
    JSAMPROW to = picture.rgb.data() + row * info.output_scanline;
    jpeg_read_scanlines(&info, &to, 1);
  }
  jpeg_finish_decompress(&info);
  jpeg_destroy_decompress(&info);
  return true;
}

}  // namespace

bool readsJpeg() {
  return true;
}

SurfacePicture decodedJpeg(std::span<const std::uint8_t> file, const std::string& name) {
  SurfacePicture picture;
  Failure failure{};
  if (!decode(file, picture, failure)) throw InputError(name + ": " + failure.text);
  return picture;
}
#else
bool readsJpeg() {
  return false;
}

SurfacePicture decodedJpeg(std::span<const std::uint8_t>, const std::string& name) {
  throw InputError(name + ": this build reads no JPEG (libjpeg-dev was not there); PNG is read");
}
#endif

}  // namespace carom::demos
