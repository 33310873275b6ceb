#pragma once

// What glibc keeps of memory that was freed. Elsewhere these do nothing.
namespace vasa {

/// For a program that stays for hours. Left alone, glibc takes ever larger blocks from its heaps (up to 32
/// MiB, once one as large was freed), where small ones that live longer come to lie between them and hold
/// what is free; and of each heap it keeps up to 64 MiB that are free at its end. From here on blocks of 4
/// MiB and more go back to the system as they are freed, and 16 MiB are kept: what a picture or a dragged
/// edit takes and gives back fits in, or each would have its pages made anew. With 1 and 8 MiB dragging takes
/// a fifth more processor time; with glibc's own 128 KiB at a heap's end so does every picture, and more.
void keepHeapSmall();

/// Gives back what is free in the middle of the heaps, too. glibc has one for every few threads: what several
/// made together, and one frees, is hardly used again. For when something large is over; takes some tens of
/// milliseconds, in which other threads that ask for memory may wait.
void returnFreedMemory();

}  // namespace vasa
