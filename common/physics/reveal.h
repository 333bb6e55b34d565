#pragma once
/// Access to private members of the engine's classes that determine a world's future. An explicit
/// instantiation may name private members ([temp.spec]), so this bypasses only the class, not the
/// compiler. Box2D 2.4 only.

#include <box2d/box2d.h>

namespace seam {
namespace {  // each file its own: the same member may be revealed in two

template <typename Tag, typename Tag::Type kMember>
struct Reveal {
  friend typename Tag::Type Member(Tag) { return kMember; }
};

/// Declares `tag`, so that `object.*Member(tag())` is the member.
#define SEAM_REVEAL(tag, type, owner, member) \
  struct tag {                                \
    using Type = type owner::*;               \
    friend Type Member(tag);                  \
  };                                          \
  template struct Reveal<tag, &owner::member>

/// The entries of a fixture in the engine's tree of boxes.
SEAM_REVEAL(Proxies, b2FixtureProxy*, b2Fixture, m_proxies);

}  // namespace
}  // namespace seam
