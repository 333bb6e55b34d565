#pragma once
/// Huge pages for a program that reads much memory in every tick. The data of a thousand bodies
/// and hundreds of clients is spread over more small pages than the processor's TLB holds.

namespace seam {

/// Restarts this program with the same arguments and one heap that asks the system for huge pages:
/// GLIBC_TUNABLES glibc.malloc.hugetlb=1 and arena_max=1, which glibc (2.35 or later) reads at
/// start only. Call it before threads, files and sockets exist, and only in a program with one busy
/// thread: several were slower with one heap, and heaps per thread are on small pages.
/// Does nothing if GLIBC_TUNABLES is set (it is after the restart), or if the system has no huge
/// pages on request (/sys/kernel/mm/transparent_hugepage/enabled is not "[madvise]").
/// `argv`: main's.
void UseHugePages(char** argv);

}  // namespace seam
