#pragma once
/// Origin of pictures: stored in each PNG file, and in manifest.json beside a sequence.

#include <string>
#include <utility>
#include <vector>

#include "render/frame.h"
#include "render/options.h"
#include "render/output.h"

namespace seam {

/// Returns keys and values for a PNG's text chunks: Software, Title, Source (each log's name and
/// hash), Description (the run's settings and the displayed peer). No time of day: the same log
/// gives the same bytes.
std::vector<std::pair<std::string, std::string>> AboutPictures(const RenderOptions& options,
                                                               const Page& page);

/// Writes manifest.json into the folder: version, logs with their hashes, relevant flags, and for
/// each frame its moment, tick and the box of the world that its panels show (m). Throws
/// OperatorError when it cannot be written.
void WriteManifest(const RenderOptions& options, const Page& page,
                   const std::vector<double>& times_s, const OutputFolder& folder);

}  // namespace seam
