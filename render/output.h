#pragma once
/// The output folder of a sequence. Never mixes frames with unrelated files.

#include <string>
#include <vector>

namespace seam {

/// Name of the file with the frames' origin (manifest.h).
constexpr const char* kManifestName = "manifest.json";

/// A folder with frame_00000.png, frame_00001.png, ...
class OutputFolder {
 public:
  /// Writes nothing. Throws OperatorError when `path` is no folder, or when the folder holds
  /// anything, frames of an earlier run included, and `force` is false.
  OutputFolder(const std::string& path, bool force);
  /// Creates the folder, and removes earlier frames. Throws OperatorError on failure.
  void Prepare() const;
  std::string FramePath(int frame) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Throws OperatorError unless `path` ends in `ending` and its folder exists, or as RequireOutput.
void CheckOutputFile(const std::string& path, const std::string& ending, bool force,
                     const std::vector<std::string>& read);

/// Returns the path's ending: ".mp4", ".webm" or ".gif". Throws OperatorError for any other.
std::string VideoEnding(const std::string& path);

/// Runs ffmpeg over a folder's frames. Throws OperatorError when it fails.
void EncodeVideo(const OutputFolder& folder, int fps, const std::string& path);
/// Throws OperatorError with one clear line when there is no ffmpeg on the PATH.
void RequireFfmpeg();

}  // namespace seam
