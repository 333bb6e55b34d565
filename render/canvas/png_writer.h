#pragma once
/// Writes pictures as PNG files fast; the only file pair that includes libpng.

#include <string>

#include "render/canvas/image.h"

namespace seam {

/// 8-bit RGB, no filter, no time stamp: the same image gives the same bytes. `level`: zlib's, 1..9.
/// Throws OperatorError when the file cannot be written; a half-written one is removed.
void WritePng(const std::string& path, const Image& image, int level = 3);

/// Reads an 8-bit RGB file as WritePng makes it. Throws OperatorError when it is none.
Image ReadPng(const std::string& path);

}  // namespace seam
