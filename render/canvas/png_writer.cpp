#include "render/canvas/png_writer.h"

#include <png.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "render/canvas/flat_deflate.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::uint8_t>;

void Put32(Bytes* out, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out->push_back(static_cast<std::uint8_t>(value >> shift));
}

/// Begins a chunk with its length, to be filled in at the end, and its name.
std::size_t BeginChunk(Bytes* out, const char* name) {
  Put32(out, 0);
  const std::size_t begin = out->size();
  out->insert(out->end(), name, name + 4);
  return begin;
}

void EndChunk(Bytes* out, std::size_t begin) {
  const std::size_t length = out->size() - begin - 4;
  for (int i = 0; i < 4; ++i)
    (*out)[begin - 4 + static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(length >> (24 - 8 * i));
  Put32(out, crc32(0, out->data() + begin, static_cast<uInt>(length + 4)));
}

void PutHeader(Bytes* out, const Image& image) {
  const std::size_t chunk = BeginChunk(out, "IHDR");
  Put32(out, static_cast<std::size_t>(image.width_px));
  Put32(out, static_cast<std::size_t>(image.height_px));
  const std::uint8_t format[] = {8, 2, 0, 0,
                                 0};  // bits, RGB, deflate, filters by row, no interlace
  out->insert(out->end(), std::begin(format), std::end(format));
  EndChunk(out, chunk);
}

void PutText(Bytes* out, const std::string& key, const std::string& value) {
  const std::size_t chunk = BeginChunk(out, "iTXt");
  out->insert(out->end(), key.begin(), key.end());
  // The key's end, not compressed, method 0, no language, no translated key.
  out->insert(out->end(), {0, 0, 0, 0, 0});
  out->insert(out->end(), value.begin(), value.end());
  EndChunk(out, chunk);
}

/// Returns the rows, each preceded by its filter byte, none.
Bytes Rows(const Image& image) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  Bytes rows((row_bytes + 1) * static_cast<std::size_t>(image.height_px));
  std::uint8_t* to = rows.data();
  for (int y = 0; y < image.height_px; ++y, to += row_bytes) {
    *to++ = 0;
    const std::uint8_t* from = image.At(0, y);
    for (std::size_t i = 0; i < row_bytes; i += 3, from += 4) std::memcpy(to + i, from, 3);
  }
  return rows;
}

void PutSmall(Bytes* out, const Bytes& rows) {
  const std::size_t before = out->size();
  uLongf bytes = compressBound(static_cast<uLong>(rows.size()));
  out->resize(before + bytes);
  const int status =
      compress2(out->data() + before, &bytes, rows.data(), static_cast<uLong>(rows.size()), 9);
  SEAM_ASSERT(status == Z_OK);
  out->resize(before + bytes);
}

void Encode(const Image& image, PngEffort effort, const PngTexts& texts, Bytes* out) {
  static const std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  out->assign(std::begin(kSignature), std::end(kSignature));
  PutHeader(out, image);
  for (const auto& [key, value] : texts) PutText(out, key, value);
  const std::size_t chunk = BeginChunk(out, "IDAT");
  if (effort == PngEffort::kSmall) {
    PutSmall(out, Rows(image));
  } else {
    FlatDeflate(image.rgba.data(), static_cast<std::size_t>(image.width_px),
                static_cast<std::size_t>(image.height_px), out);
  }
  EndChunk(out, chunk);
  EndChunk(out, BeginChunk(out, "IEND"));
}

}  // namespace

void WritePng(const std::string& path, const Image& image, PngEffort effort,
              const PngTexts& texts) {
  SEAM_ASSERT(image.width_px > 0 && image.height_px > 0);
  thread_local Bytes encoded;
  Encode(image, effort, texts, &encoded);
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  const bool renamed = !fs::exists(there) || fs::is_regular_file(there);
  const std::string written = renamed ? path + ".tmp" : path;
  RequirePlainFile(path);
  std::FILE* file = OpenPlainFile(written, FileUse::kReplace);
  if (file == nullptr) throw OperatorError(path + ": " + std::strerror(errno));
  errno = 0;
  const bool whole = std::fwrite(encoded.data(), 1, encoded.size(), file) == encoded.size();
  const bool closed = std::fclose(file) == 0;
  if (whole && closed && (!renamed || std::rename(written.c_str(), path.c_str()) == 0)) return;
  const std::string why = errno != 0 ? std::strerror(errno) : "write failed";
  if (renamed) fs::remove(written, ignored);
  throw OperatorError(path + ": " + why);
}

Image ReadPng(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    throw OperatorError(path + ": " + png.message);
  png.format = PNG_FORMAT_RGBA;
  Image image;
  image.width_px = static_cast<int>(png.width);
  image.height_px = static_cast<int>(png.height);
  image.rgba.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0)
    throw OperatorError(path + ": " + png.message);
  return image;
}

}  // namespace seam
