#pragma once
/// The colours of a page: light paper, dark ink, and colours of peers and runs that a colour-blind
/// reader can distinguish. Any two that can appear in one picture differ by at least 12 (CIE 1976)
/// as protanopes, deuteranopes and tritanopes see them (Machado, Oliveira and Fernandes, "A
/// Physiologically-based Model for Simulation of Color Vision Deficiency", 2009).

#include "render/canvas/image.h"

namespace seam {

constexpr Colour kPaper{246, 246, 243, 255};  ///< around the panels
constexpr Colour kPanel{255, 255, 255, 255};  ///< behind the world
constexpr Colour kFrame{205, 205, 199, 255};  ///< edges of panels
constexpr Colour kGrid{240, 240, 237, 255};
constexpr Colour kInk{28, 31, 36, 255};          ///< text, ghosts, playhead
constexpr Colour kFaintInk{104, 109, 117, 255};  ///< secondary text: 5 : 1 on paper
constexpr Colour kGround{214, 210, 202, 255};
constexpr Colour kGroundEdge{136, 130, 120, 255};
constexpr Colour kWater{96, 160, 205, 255};     ///< drawn with low opacity
constexpr Colour kWaterLine{38, 96, 145, 255};  ///< water level
constexpr Colour kSpark{196, 30, 58, 255};      ///< impacts: no peer has it

/// Number of clients, and of runs, with a colour of their own.
constexpr int kPeerHues = 10;

/// Returns the colour of bodies under a peer's authority; peer 0, the server, is a neutral grey.
/// Beyond the tenth client the hues repeat, darker, and names carry the peer's number.
Colour PeerColour(int peer);

/// Returns the colour of a run's curve in a comparison; beyond the tenth the colours repeat.
Colour RunColour(int run);

/// Returns the colour of an error, m: from pale at 1 mm to dark at 1 m, by its logarithm,
/// perceptually uniform (after Smith and van der Walt, "viridis", 2015, reversed, beginning at
/// white).
Colour HeatColour(float error_m);

/// Returns a mixture with `share` (0..1) of `b` and the rest of `a`.
Colour Mix(Colour a, Colour b, float share);

/// Returns the colour with its opacity multiplied by `opacity`, 0..1.
Colour Faded(Colour colour, float opacity);

/// Returns a darker colour, for outlines and text in a peer's colour.
Colour Darker(Colour colour);

}  // namespace seam
