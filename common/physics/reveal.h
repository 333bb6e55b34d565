#pragma once
/// What the engine keeps to itself, without setters: joints' impulses, a body's time to sleep. An
/// explicit instantiation may name private members ([temp.spec]), so this is no trick on the
/// compiler, only on the class.

namespace seam {
namespace {

template <typename Tag, typename Tag::Type kMember>
struct Reveal {
  friend typename Tag::Type Member(Tag) { return kMember; }
};

}  // namespace
}  // namespace seam

/// In a source file's anonymous namespace: `object.*Member(tag())` is then the private member.
#define SEAM_REVEAL(tag, type, owner, member) \
  struct tag {                                \
    using Type = type owner::*;               \
    friend Type Member(tag);                  \
  };                                          \
  template struct Reveal<tag, &owner::member>
