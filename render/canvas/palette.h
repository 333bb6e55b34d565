#pragma once
/// The colours of a page, in one place: light paper, dark ink, and peers and runs that a
/// colour-blind reader can tell apart: any two that can stand in one picture differ by 12 and more
/// (CIE 1976) as protanopes, deuteranopes and tritanopes see them (Machado, Oliveira and Fernandes,
/// "A Physiologically-based Model for Simulation of Color Vision Deficiency", 2009).

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
constexpr Colour kWater{96, 160, 205, 255};     ///< laid on thinly
constexpr Colour kWaterLine{38, 96, 145, 255};  ///< its level
constexpr Colour kSpark{196, 30, 58, 255};      ///< impacts: no peer has it

/// So many clients, and so many runs, have a colour of their own.
constexpr int kPeerHues = 10;

/// The colour of what a peer has authority over; peer 0, the server, is a neutral grey. Beyond the
/// tenth client the hues repeat, darker, and names carry the peer's number.
Colour PeerColour(int peer);

/// The colour of a run's curve in a comparison; beyond the tenth they repeat.
Colour RunColour(int run);

/// An error, m, as a colour: from pale at 1 mm to dark at 1 m, by its logarithm, each step about as
/// large to the eye (after Smith and van der Walt, "viridis", 2015, reversed, with white before).
Colour HeatColour(float error_m);

/// `share` of `b` in `a`, 0..1.
Colour Mix(Colour a, Colour b, float share);

/// The same colour with its opacity multiplied, 0..1.
Colour Faded(Colour colour, float opacity);

/// For outlines and text in a peer's colour.
Colour Darker(Colour colour);

}  // namespace seam
