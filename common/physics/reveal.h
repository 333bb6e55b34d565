#pragma once
/// Members of the engine's classes that have no public access and decide how a world goes on. An
/// explicit instantiation may name private members ([temp.spec]), so this is no trick on the
/// compiler, only on the class. Box2D 2.4 only.

#include <box2d/box2d.h>

namespace seam {
namespace {  // each file its own: the same member may be revealed in two

template <typename Tag, typename Tag::Type kMember>
struct Reveal {
  friend typename Tag::Type Member(Tag) { return kMember; }
};

/// `object.*Member(tag())` is the member.
#define SEAM_REVEAL(tag, type, owner, member) \
  struct tag {                                \
    using Type = type owner::*;               \
    friend Type Member(tag);                  \
  };                                          \
  template struct Reveal<tag, &owner::member>

}  // namespace
}  // namespace seam
