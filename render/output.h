#pragma once
/// The folder a sequence goes into: never mixes its frames with other people's files.

#include <string>

namespace seam {

/// Beside the frames: where they come from (manifest.h).
constexpr const char* kManifestName = "manifest.json";

/// frame_00000.png, frame_00001.png, ... in a folder.
class OutputFolder {
 public:
  /// Writes nothing. Throws OperatorError when the folder holds anything but frames of an earlier
  /// run and not `force`, or is no folder.
  OutputFolder(const std::string& path, bool force);
  /// Makes the folder, and removes the earlier frames. Throws OperatorError when it cannot.
  void Prepare() const;
  std::string FramePath(int frame) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Throws OperatorError unless `path` ends in `ending`, its folder exists, and there is no such
/// file yet (or `force`, or it is a file that may be replaced: an earlier picture).
void CheckOutputFile(const std::string& path, const std::string& ending, bool force);

/// ".mp4", ".webm" or ".gif", as the path ends. Throws OperatorError when it ends otherwise.
std::string VideoEnding(const std::string& path);

/// Runs ffmpeg over a folder's frames. Throws OperatorError when it fails.
void EncodeVideo(const OutputFolder& folder, int fps, const std::string& path);
/// Throws OperatorError with one clear line when there is no ffmpeg on the PATH.
void RequireFfmpeg();

}  // namespace seam
