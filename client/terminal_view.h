#pragma once
/// Draws the world in a terminal, so that a person can play over ssh: outlines of braille dots,
/// coloured by the authority.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/topology/feather_store.h"

namespace seam {

/// A canvas of dots, two wide and four high in each character cell. A cell has one colour, the last
/// drawn.
class BrailleCanvas {
 public:
  BrailleCanvas(int columns, int rows);

  int width() const { return 2 * columns_; }  ///< dots
  int height() const { return 4 * rows_; }
  /// `colour`: one of the terminal's 256. Dots outside the canvas are dropped.
  void Dot(int x, int y, int colour);
  /// `every`: of so many dots one is drawn.
  void Line(Vec2 from, Vec2 to, int colour, int every = 1);
  /// Returns the rows, with colours as escape sequences, each ended by "\r\n".
  std::string Text() const;

 private:
  struct Cell {
    std::uint8_t dots = 0;
    std::uint8_t colour = 0;
  };
  int columns_, rows_;
  std::vector<Cell> cells_;
};

/// Returns the terminal's colour for bodies of this authority: 0, the server, is grey.
int TerminalColour(int peer);

/// Draws the client's current view onto the canvas: a grid of dots, the borders of the players'
/// regions in their colours and the bodies. A client with a vehicle sees a third of the scene's
/// camera around it. `bricks`: the scene's; nullptr: none. Requires a client that has its replica.
void DrawInTerminal(const Client& client, const FeatherStore* bricks, BrailleCanvas* canvas);

/// Returns the speed of the client's own vehicle, m/s; nullopt without one.
std::optional<float> OwnSpeed(const Client& client);

/// Shows the picture with two lines below it, on standard output.
class TerminalView {
 public:
  /// Throws OperatorError if standard output is no terminal. Hides the cursor while it lives.
  TerminalView();
  ~TerminalView();
  TerminalView(const TerminalView&) = delete;
  TerminalView& operator=(const TerminalView&) = delete;

  /// True if the next frame is due, 15 times a second.
  bool Due(std::int64_t now_us) const { return now_us >= next_us_; }
  /// `status` and `keys`: one line each, cut at the terminal's width. The picture is empty while
  /// the client has no world.
  void Show(std::int64_t now_us, const Client& client, const std::string& status,
            const std::string& keys);

 private:
  std::int64_t next_us_ = 0;
  std::unique_ptr<FeatherStore> bricks_;
};

}  // namespace seam
