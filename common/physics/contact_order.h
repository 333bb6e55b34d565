#pragma once
/// Gives contacts an order that depends on the shapes alone. The engine solves contacts in the
/// order of its list, newest first, and finds them in the order of its tree of boxes, which depends
/// on the whole history of the world. Two peers that simulate the same bodies, but know different
/// ones far away, would solve them in different orders, and a pile of crates is half a metre apart
/// after some seconds. Here contacts that are found together are sorted ascending by part, piece
/// and segment of the lower shape and then of the higher.

#include <box2d/box2d.h>

namespace seam {

/// Finds the contacts of an engine with only new shapes, as its next step would, and adds them
/// in that order.
void FindContactsInOrder(b2World* world);

/// Sorts into that order the contacts that the engine has found since the last call of one of these
/// functions. Costs nothing if none is new.
void OrderNewContacts(b2World* world);

/// Finds the contacts of shapes that were added or placed since the last step, as the engine's next
/// step would, and sorts them before it solves them. Costs nothing if there are none.
void FindNewContactsInOrder(b2World* world);

}  // namespace seam
