#pragma once
/// Writes pictures as PNG files fast; the only file pair that includes libpng.

#include <string>
#include <utility>
#include <vector>

#include "render/canvas/image.h"

namespace seam {

using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// 8-bit RGB, no filter, no time stamp: the same image gives the same bytes. `level`: zlib's, 1..9.
/// The file appears whole or not at all: it is written as `path`.tmp and then renamed, unless
/// `path` is a device, a pipe or a link. Throws OperatorError when it cannot be written; what was
/// there stays.
/// `texts`: keys (1..79 letters of Latin-1) and values (UTF-8) for text chunks.
void WritePng(const std::string& path, const Image& image, int level = 3,
              const PngTexts& texts = {});

/// Reads an 8-bit RGB file as WritePng makes it. Throws OperatorError when it is none.
Image ReadPng(const std::string& path);

}  // namespace seam
