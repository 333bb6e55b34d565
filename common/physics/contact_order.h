#pragma once
/// The order in which the engine solves contacts: that of its list, newest first. The engine adds
/// them in the order in which it comes upon them in its tree of boxes, which hangs on everything
/// that ever was in the world. So two peers that simulate the same things, but do not have the
/// same other things far away, would solve them in two orders, and a pile of crates is half a
/// metre apart after some seconds. Here the order of what is found at once hangs on the shapes
/// alone: ascending by the part, the piece and the segment of the lower and then of the higher.

#include <box2d/box2d.h>

namespace seam {

/// Finds the contacts of an engine whose shapes are all new, as its next step would, and adds them
/// in that order.
void FindContactsInOrder(b2World* world);

/// Puts those that the engine has found by itself since the last call, of this or the above, in
/// that order. Where none is new it costs nothing.
void OrderNewContacts(b2World* world);

}  // namespace seam
