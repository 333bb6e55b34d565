#pragma once
/// Memory on huge pages for a program that goes through much of it in every tick: what a thousand
/// bodies and hundreds of clients are is spread over more small pages than a processor remembers
/// where they are.

namespace seam {

/// How many heaps the C library's allocator makes.
enum class Heaps {
  kAsUsual,  ///< further ones for threads that allocate at the same time, on small pages
  kOne,      ///< for all threads: all of it on huge pages
};

/// Starts this program anew, with the same arguments, and a heap that asks the system for huge
/// pages: GLIBC_TUNABLES glibc.malloc.hugetlb=1, which glibc (2.35 or later) reads at start only.
/// Before threads, files and sockets. Does nothing where GLIBC_TUNABLES is set, as it is when
/// started anew, and where the system does not give them to who asks
/// (/sys/kernel/mm/transparent_hugepage/enabled is not "[madvise]"). `argv`: of main.
void UseHugePages(char** argv, Heaps heaps);

}  // namespace seam
