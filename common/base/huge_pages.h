#pragma once
/// Memory on huge pages for a program that goes through much of it in every tick: what a thousand
/// bodies and hundreds of clients are is spread over more small pages than a processor remembers
/// where they are.

namespace seam {

/// Starts this program anew, with the same arguments, and one heap for all threads that asks the
/// system for huge pages: GLIBC_TUNABLES glibc.malloc.hugetlb=1 and arena_max=1, which glibc (2.35
/// or later) reads at start only. Before threads, files and sockets; for who has one thread that
/// works: several were slower with one heap, and heaps of their own are on small pages.
/// Does nothing where GLIBC_TUNABLES is set, as it is when started anew, and where the system does
/// not give them to who asks (/sys/kernel/mm/transparent_hugepage/enabled is not "[madvise]").
/// `argv`: of main.
void UseHugePages(char** argv);

}  // namespace seam
