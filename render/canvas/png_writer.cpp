#include "render/canvas/png_writer.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/plain_file.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

void Quiet(png_structp, png_const_charp) {}

/// libpng leaves by longjmp, so nothing with a destructor may live in here.
bool Encode(std::FILE* file, const Image& image, int level, png_textp texts, int text_count) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, Quiet);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_compression_level(png, level);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px),
               static_cast<png_uint_32>(image.height_px), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (text_count > 0) png_set_text(png, info, texts, text_count);
  png_write_info(png, info);
  for (int y = 0; y < image.height_px; ++y) png_write_row(png, image.At(0, y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

void WritePng(const std::string& path, const Image& image, int level, const PngTexts& texts) {
  SEAM_ASSERT(image.width_px > 0 && image.height_px > 0);
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  const bool renamed = !fs::exists(there) || fs::is_regular_file(there);
  const std::string written = renamed ? path + ".tmp" : path;
  RequirePlainFile(path);
  std::FILE* file = OpenPlainFile(written, FileUse::kReplace);
  if (file == nullptr) throw OperatorError(path + ": " + std::strerror(errno));
  errno = 0;
  std::vector<png_text> chunks;
  for (const auto& [key, value] : texts) {
    png_text chunk{};
    chunk.compression = PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(key.c_str());  // libpng only reads them
    chunk.text = const_cast<char*>(value.c_str());
    chunk.itxt_length = value.size();
    chunks.push_back(chunk);
  }
  const bool encoded = Encode(file, image, level, chunks.data(), static_cast<int>(chunks.size()));
  const bool closed = std::fclose(file) == 0;
  if (encoded && closed && (!renamed || std::rename(written.c_str(), path.c_str()) == 0)) return;
  const std::string why = errno != 0 ? std::strerror(errno) : "write failed";
  if (renamed) fs::remove(written, ignored);
  throw OperatorError(path + ": " + why);
}

Image ReadPng(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    throw OperatorError(path + ": " + png.message);
  png.format = PNG_FORMAT_RGB;
  Image image;
  image.width_px = static_cast<int>(png.width);
  image.height_px = static_cast<int>(png.height);
  image.rgb.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0)
    throw OperatorError(path + ": " + png.message);
  return image;
}

}  // namespace seam
