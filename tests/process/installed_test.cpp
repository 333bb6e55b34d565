/// An installation by `make install` works from its folder: programs, scenes by name, the library.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "common/base/version.h"
#include "common/codec/messages.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace installed_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Installed once, below a DESTDIR of its own; nothing is built.
class Installed : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = std::make_unique<Workspace>();
    const fs::path bin = fs::path(BuiltProgram("seam-server")).parent_path();
    Program make(
        {"env", "-u", "MAKEFLAGS", "-u", "MAKELEVEL", "make", "install-built",
         "BUILD=" + bin.filename().string(), "DESTDIR=" + *made_ / "dest", "PREFIX=/opt/seam"},
        Root().string());
    ASSERT_TRUE(make.Wait(60) && make.status() == 0) << make.Story();
  }
  static void TearDownTestSuite() { made_.reset(); }

  static std::string At(const std::string& path) { return *made_ / ("dest/opt/seam/" + path); }

  /// Runs `words` in `folder`, with pkg-config set to the installation.
  static std::unique_ptr<Program> Run(Words words, const Workspace& folder) {
    words.insert(words.begin(), {"env", "PKG_CONFIG_PATH=" + At("lib/pkgconfig")});
    auto program = std::make_unique<Program>(words, folder.path());
    EXPECT_TRUE(program->Wait(120)) << "hangs";
    return program;
  }

  /// A tenth of a second of a room that waits for nobody.
  static Words ServerWords(const std::string& scene) {
    return {At("bin/seam-server"), scene, "--bind",    "127.0.0.1:0", "--wait", "0",
            "--duration",          "0.1", "--lcm-url", "none"};
  }

 private:
  inline static std::unique_ptr<Workspace> made_;
};

/// Returns the text between `begin` and the next `end`; "" without such a place.
std::string Between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size(), to = text.find(end, from);
  return to == std::string::npos ? "" : text.substr(from, to - from);
}

/// A program of docs/embedding.md: its text, and the line that it prints.
struct PageProgram {
  std::string text;
  std::string printed;
};

/// Returns the page's block of this language, and the text behind it in "prints `...`".
PageProgram ProgramOf(const std::string& language) {
  std::ifstream file(Root() / "docs/embedding.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string begin = "```" + language + "\n";
  const std::string rest = page.substr(std::min(page.size(), page.find(begin)));
  PageProgram program{Between(rest, begin, "```"), Between(rest, "prints `", "`") + "\n"};
  EXPECT_GT(program.text.size(), 100u) << language;
  EXPECT_GT(program.printed.size(), 10u) << language;
  return program;
}

TEST_F(Installed, TheEmbeddingPagesProgramsCompileAndPrintAsDocumented) {
  struct Case {
    const char *language, *file, *command;
  };
  for (const Case& each :
       {Case{"cpp", "slide.cpp",
             "g++ -Wall -Wextra -Werror slide.cpp $(pkg-config --cflags --libs seam2d) -o out"},
        Case{"c", "slide.c",
             "gcc -std=c99 -Wall -Wextra -Wpedantic -Werror slide.c "
             "$(pkg-config --cflags --libs seam2d-c) -Wl,-rpath,$(pkg-config --variable=libdir "
             "seam2d-c) -o out"}}) {
    const PageProgram program = ProgramOf(each.language);
    const Workspace folder;
    folder.Write(each.file, program.text);
    const auto compile = Run({"sh", "-c", each.command}, folder);
    ASSERT_EQ(compile->status(), 0) << compile->Story();
    const auto run = Run({"./out"}, folder);
    EXPECT_EQ(run->status(), 0) << run->Story();
    EXPECT_EQ(run->output(), program.printed);
  }
}

TEST_F(Installed, CMakeFindsBothLibraries) {
  if (std::system("cmake --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "cmake is not here";
  const Workspace folder;
  const PageProgram cpp = ProgramOf("cpp"), c = ProgramOf("c");
  folder.Write("slide.cpp", cpp.text);
  folder.Write("slide.c", c.text);
  folder.Write("CMakeLists.txt",
               "cmake_minimum_required(VERSION 3.16)\nproject(slide C CXX)\n"
               "find_package(seam2d 0.26 REQUIRED)\n"
               "add_executable(one slide.cpp)\ntarget_link_libraries(one seam2d::seam2d)\n"
               "add_executable(two slide.c)\ntarget_link_libraries(two seam2d::c)\n");
  const auto made = Run({"sh", "-c",
                         "cmake -S . -B build -DCMAKE_PREFIX_PATH=" + At("") +
                             " && cmake --build build && build/one && build/two"},
                        folder);
  ASSERT_EQ(made->status(), 0) << made->Story();
  EXPECT_NE(made->output().find(cpp.printed + c.printed), std::string::npos) << made->Story();
  folder.Write("CMakeLists.txt",
               "cmake_minimum_required(VERSION 3.16)\nproject(slide C)\n"
               "find_package(seam2d 99 REQUIRED)\n");
  EXPECT_NE(
      Run({"cmake", "-S", ".", "-B", "other", "-DCMAKE_PREFIX_PATH=" + At("")}, folder)->status(),
      0);
}

TEST_F(Installed, HeadersTakeNoNameButSeam2d) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(At("include"))) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_EQ(names, std::vector<std::string>{"seam2d"});
  // Each public header compiles alone, though the program has folders of our names.
  const Workspace folder;
  for (const char* own : {"common", "server", "client"}) fs::create_directory(folder / own);
  int headers = 0;
  for (const auto& entry : fs::directory_iterator(At("include/seam2d"))) {
    if (entry.path().extension() != ".h") continue;
    ++headers;
    const std::string name = "seam2d/" + entry.path().filename().string();
    folder.Write("one" + std::to_string(headers) + ".cpp", "#include <" + name + ">\n");
  }
  EXPECT_GE(headers, 9);
  const auto compile = Run({"sh", "-c",
                            "g++ -fsyntax-only -Wall -Wextra -Werror -I. one*.cpp "
                            "$(pkg-config --cflags seam2d)"},
                           folder);
  EXPECT_EQ(compile->status(), 0) << compile->Story();
}

TEST_F(Installed, TheSharedLibraryShowsNothingButTheCInterface) {
  const Workspace folder;
  const auto names = Run({"nm", "-D", "--defined-only", At("lib/libseam2d.so")}, folder);
  ASSERT_EQ(names->status(), 0) << names->Story();
  std::istringstream lines(names->output());
  std::string line;
  int functions = 0;
  while (std::getline(lines, line)) {
    EXPECT_NE(line.find(" T seam2d_"), std::string::npos) << line;
    ++functions;
  }
  EXPECT_GE(functions, 20);
}

TEST_F(Installed, TypesDocsAndLicenceAreThere) {
  std::size_t types = 0;
  for (const auto& entry : fs::directory_iterator(Root() / "lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    ++types;
    EXPECT_TRUE(fs::exists(At("share/seam2d/lcmtypes/" + entry.path().filename().string())));
  }
  EXPECT_GT(types, 20u);
  for (const char* file : {"copyright", "embedding.md", "recordings.md", "README.md"}) {
    EXPECT_GT(fs::file_size(At(std::string("share/doc/seam2d/") + file)), 500u) << file;
  }
}

TEST_F(Installed, PkgConfigAndEveryProgramPrintTheVersion) {
  const Workspace folder;
  EXPECT_EQ(Run({"pkg-config", "--modversion", "seam2d"}, folder)->output(),
            std::string(kVersion) + "\n");
  for (const char* name : {"seam-server", "seam-token", "seam-relay", "seam-client", "seam-swarm",
                           "seam-top", "seam-render", "seam-measure", "seam-export", "seam-import",
                           "seam-view", "seam-log", "seam", "seam-lab"}) {
    const auto program = Run({At(std::string("bin/") + name), "--version"}, folder);
    EXPECT_EQ(program->status(), 0) << program->Story();
    EXPECT_EQ(program->errors(), "");
    EXPECT_EQ(program->output(), std::string(name) + " " + kVersion + " (protocol " +
                                     std::to_string(kProtocolVersion) + ")\n");
  }
}

TEST_F(Installed, EveryProgramHasItsManPageAndItsCompletionInEachShell) {
  for (const std::string name :
       {"seam-server", "seam-client", "seam-render", "seam-measure", "seam-export", "seam-import",
        "seam-view", "seam-log", "seam", "seam-lab"}) {
    for (const std::string& file :
         {"share/man/man1/" + name + ".1", "share/bash-completion/completions/" + name,
          "share/zsh/site-functions/_" + name,
          "share/fish/vendor_completions.d/" + name + ".fish"}) {
      std::error_code error;
      EXPECT_GT(fs::file_size(At(file), error), name == "seam-import" ? 300u : 500u) << file;
    }
  }
  std::ifstream file(At("share/bash-completion/completions/seam-server"));
  const std::string script{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(script.find(" crossing "), std::string::npos) << "the scenes that were installed";
}

TEST_F(Installed, ScenesAreFoundByNameFromAnyFolder) {
  const Workspace folder;
  for (const char* scene : {"crossing", "arch"}) {  // one of them lies in scenes/hard
    const auto server = Run(ServerWords(scene), folder);
    EXPECT_EQ(server->status(), 0) << server->Story();
  }
  const auto lab = Run(
      {At("bin/seam-lab"), "run", "crossing", "-o", "run.lcm", "--no-floor", "--duration", "0.1"},
      folder);
  EXPECT_EQ(lab->status(), 0) << lab->Story();
  const auto none = Run({At("bin/seam-server")}, folder);
  EXPECT_EQ(none->status(), 2);
  EXPECT_NE(none->errors().find("by name: arena, battlefield, "), std::string::npos)
      << none->Story();
}

TEST_F(Installed, ASceneOfTheCurrentFolderComesBeforeAnInstalledOne) {
  const Workspace folder;
  fs::create_directory(folder / "scenes");
  folder.Write("scenes/crossing.toml", "nonsense = 1\n");
  const auto scenes = Run(ServerWords("crossing"), folder);
  EXPECT_EQ(scenes->errors().rfind("seam-server: scenes/crossing.toml:1: ", 0), 0u)
      << scenes->Story();
  folder.Write("crossing", "nonsense = 1\n");  // the file itself before both
  const auto file = Run(ServerWords("crossing"), folder);
  EXPECT_EQ(file->errors().rfind("seam-server: crossing:1: ", 0), 0u) << file->Story();
}

TEST_F(Installed, AnUnknownSceneIsOneLineThatListsTheFoldersSearched) {
  const Workspace folder;
  const auto server = Run(ServerWords("crosing"), folder);
  EXPECT_EQ(server->status(), 2);
  const std::string line = server->errors();
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  for (const std::string& place :
       {std::string("no scene \"crosing\""), std::string(" scenes/crosing.toml"),
        std::string(" scenes/hard/crosing.toml"), At("share/seam2d/scenes/crosing.toml"),
        At("share/seam2d/scenes/hard/crosing.toml")}) {
    EXPECT_NE(line.find(place), std::string::npos) << line << "does not name " << place;
  }
  const auto path = Run(ServerWords("./crossing"), folder);
  EXPECT_EQ(path->errors().rfind("seam-server: ./crossing: no such", 0), 0u) << path->Story();
}

}  // namespace installed_test
}  // namespace seam
