/// seam-import: worlds of other programs as scenes. docs/import.md describes it.

#include <cstdio>

#include "common/base/check.h"
#include "common/base/command_line.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/codec/version_line.h"
#include "common/scene/scene.h"
#include "render/export/output_file.h"
#include "render/import/imported.h"

namespace seam {
namespace {

/// Longest file that is read.
constexpr std::size_t kImportBytesMax = 64 << 20;

struct ImportOptions {
  std::string file, out;
  double pixels = 32;
  bool force = false;
};

Imported Read(const ImportOptions& options) {
  const std::string text = ReadPlainFile(options.file, kImportBytesMax + 1, "no such file");
  if (text.size() > kImportBytesMax) throw OperatorError(options.file + ": has more than 64 MB");
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const char begins = first == std::string::npos ? ' ' : text[first];
  if (begins == '{') return ReadRube(text, options.file);
  if (begins == '<') return ReadTiled(text, options.file, options.pixels);
  return ReadDump(text, options.file);
}

int Run(const ImportOptions& options) {
  if (options.file.empty()) {
    throw OperatorError("which file? for example: seam-import level.json -o level.toml");
  }
  OutputFile out(options.out, options.force, {options.file});
  Imported world = Read(options);
  const std::string name = options.file.substr(options.file.find_last_of('/') + 1);
  const std::string text = SceneText(&world, name);
  for (const std::string& line : world.dropped) PrintError("seam-import", "dropped: " + line);
  ParseScene(text, options.out.empty() ? name + ".toml" : options.out);  // or it says why not
  out.Write(text);
  out.Finish();
  return 0;
}

}  // namespace
}  // namespace seam

int main(int argc, char** argv) {
  using namespace seam;
  ImportOptions options;
  const ProgramText text{
      "seam-import", "Writes a world of another program as a scene, and lists what it dropped.",
      VersionLine("seam-import"),
      "examples:\n"
      "  seam-import level.json -o level.toml               R.U.B.E. JSON\n"
      "  seam-import box2d_dump.inl -o dump.toml            what b2World::Dump wrote\n"
      "  seam-import map.tmx --pixels 16 -o map.toml        the objects of a Tiled map"};
  return RunCommandLine(
      text, argc, argv,
      [&](Command& app) {
        app.Option("FILE", options.file, "R.U.B.E. JSON, a b2World::Dump or a Tiled map (.tmx)");
        app.Option("-o,--out", options.out, "the scene to write (stdout)");
        app.Option("--pixels", options.pixels, "Tiled: pixels of a metre").Range(1e-3, 1e6);
        app.Switch("--force", options.force, "replace the file if it is there");
      },
      [&] { return Run(options); });
}
