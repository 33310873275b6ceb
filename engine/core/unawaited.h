#pragma once
#include <functional>
#include <future>

namespace vasa {

/// Starts work that nothing has to wait for: letting go of the future does not, and a program that has done
/// what it was for may end meanwhile. The work must own all that it reads.
///   std::future<void> compiled = startUnawaited([adapter] { compile(adapter); });
/// @return ready once the work has ended; get() throws what it threw
std::future<void> startUnawaited(std::function<void()> work);

/// Whether such work still goes on. main() then has to end by std::_Exit(): libraries tidy up after main(),
/// and the work would run into that.
bool hasUnawaited();

}  // namespace vasa
