#pragma once
/// The world in a terminal, so that a person can play over ssh: outlines of braille dots, coloured
/// by who has authority.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Dots, two wide and four high in each character cell; a cell has one colour, the last drawn.
class BrailleCanvas {
 public:
  BrailleCanvas(int columns, int rows);

  int width() const { return 2 * columns_; }  ///< dots
  int height() const { return 4 * rows_; }
  /// `colour`: of the terminal's 256. What lies outside is cut off.
  void Dot(int x, int y, int colour);
  void Line(Vec2 from, Vec2 to, int colour);
  /// The rows, with colours as escape sequences, each ended by "\r\n".
  std::string Text() const;

 private:
  struct Cell {
    std::uint8_t dots = 0;
    std::uint8_t colour = 0;
  };
  int columns_, rows_;
  std::vector<Cell> cells_;
};

/// The terminal's colour of what a peer has authority over: 0, the server's, is grey.
int TerminalColour(int peer);

/// Draws what the client shows now onto the canvas: its own vehicle, if it has one, in the middle,
/// with a third of what the scene's camera shows. `bricks`: the scene's, nullptr: it has
/// none. Requires a running client.
void DrawInTerminal(const Client& client, const FeatherStore* bricks, BrailleCanvas* canvas);

/// The picture with two lines below it, on standard output.
class TerminalView {
 public:
  /// Throws OperatorError when standard output is no terminal. Hides the cursor while it lives.
  TerminalView();
  ~TerminalView();
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  /// 15 times a second.
  bool Due(std::int64_t now_us) const { return now_us >= next_us_; }
  /// `status` and `keys`: one line each, cut where the terminal ends.
  void Show(std::int64_t now_us, const Client& client, const std::string& status,
            const std::string& keys);

 private:
  std::int64_t next_us_ = 0;
  std::unique_ptr<FeatherStore> bricks_;
};

}  // namespace seam
