#pragma once
/// Writes pictures as PNG files fast; the only file pair that includes libpng.

#include <string>
#include <utility>
#include <vector>

#include "render/canvas/image.h"

namespace seam {

using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// Compression of a picture.
enum class PngEffort {
  kFast,  ///< one pass (flat_deflate.h): for sequences
  kSmall  ///< zlib's level 9: for a single picture
};

/// Writes 8-bit RGB, no filter, no time stamp: the same image gives the same bytes.
/// The file appears whole or not at all: it is written as `path`.tmp and then renamed, unless
/// `path` is a device, a pipe or a link. Throws OperatorError when it cannot be written; an earlier
/// file stays. `texts`: keys (1..79 letters of Latin-1) and values (UTF-8) for text chunks.
void WritePng(const std::string& path, const Image& image, PngEffort effort = PngEffort::kFast,
              const PngTexts& texts = {});

/// Reads an 8-bit RGB file as WritePng writes it. Throws OperatorError for any other file.
Image ReadPng(const std::string& path);

}  // namespace seam
