#pragma once
#include <chrono>

#include "core/cancellation.h"
#include "core/result.h"

// How the program ends before its time, with an exit code and a sentence of its own, whatever it is doing: by
// SIGINT or SIGTERM, and for want of memory. Files need no care: they appear whole or not at all however a
// process ends.
namespace vasa::cli {

/// From now on the first SIGINT or SIGTERM asks stopWish(): work leaves at its next checkpoint
/// (core/cancellation.h), in good order. What has not left after this long (a library's loop, a driver's
/// call, a disk), and a second signal, end the process at once with 130 or 143.
void catchStopSignals(std::chrono::milliseconds patience = std::chrono::milliseconds(150));

/// For work that is left in its own good order rather than from within, as a session with something to save.
void setPatience(std::chrono::milliseconds patience);
constexpr std::chrono::seconds kPatienceToSave{10};

const Cancellation& stopWish();
bool stopRequested();
Error stopError();

/// From now on an allocation by new that fails ends the process at once with 1: on the way up from it
/// destructors, threads and libraries would allocate again.
void endWhereMemoryEnds();

/// What is thrown where nobody may catch it, as for want of memory in a library's thread, ends with 1 and a
/// sentence.
void tellWhatTerminates();

}  // namespace vasa::cli
