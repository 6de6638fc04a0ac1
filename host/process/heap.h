// The heap: how glibc's malloc is told to keep what drivers free.
#pragma once

namespace hyalite::core {

/// Makes all threads use one heap. glibc has several, and each keeps its freed memory: a process with many renders,
/// whose driver starts threads each time, would grow by 17 KB a render, to twice the memory that it needs.
void useOneHeap();

/// Makes `malloc` keep what is freed, in pieces smaller than this, of at most 32 MiB, for what is allocated next. glibc
/// gives it back to the kernel, and has it cleared page by page when it needs it again: drivers' compilers allocate the
/// same many times.
void keepFreedMemory(int sizeBytes);

/// Makes the heap 64 MiB larger, which a driver's compiler may need, without memory behind it yet, and lets the system
/// give it huge pages. By itself the heap grows in small steps, and the kernel clears a page of 4 KiB at each first
/// touch: a third of the time that a pipeline takes. The first call does it, if keepFreedMemory() was called before;
/// others do nothing.
void reserveHeap();

} // namespace hyalite::core
