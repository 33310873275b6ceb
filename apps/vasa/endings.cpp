#include "endings.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <exception>
#include <new>
#include <string_view>

#include "core/log.h"

// What a signal's handler may do is little: it sets the wish, a lock-free flag, and a timer, whose own signal
// ends the process. Neither it nor what runs out of memory may allocate, so sentences go to standard error by
// write().
namespace vasa::cli {
namespace {

Cancellation wish;
volatile sig_atomic_t stopSignal = 0;
timer_t patienceTimer;
bool hasTimer = false;
itimerspec patienceTime{};

constexpr int codeOf(int signal) {
  return signal == SIGTERM ? int(Fault::terminated) : int(Fault::interrupted);
}

[[noreturn]] void endAtOnce(int code, std::string_view sentence) {
  [[maybe_unused]] const ssize_t told = write(STDERR_FILENO, sentence.data(), sentence.size());
  _exit(code);
}

extern "C" void onPatienceOver(int) {
  endAtOnce(codeOf(stopSignal), "error: stopped by a signal, in the middle of something\n");
}

extern "C" void onStopSignal(int signal) {
  if (stopSignal) _exit(codeOf(signal));
  stopSignal = signal;
  wish.ask();
  if (hasTimer) timer_settime(patienceTimer, 0, &patienceTime, nullptr);
}

[[noreturn]] void outOfMemory() {
  endAtOnce(int(Fault::failed), "error: out of memory; use smaller inputs or fewer threads\n");
}

[[noreturn]] void onTerminate() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const Cancelled&) {
    endAtOnce(codeOf(stopSignal), "error: stopped by a signal\n");
  } catch (const std::bad_alloc&) {
    outOfMemory();
  } catch (const std::exception& error) {
    logError(error.what());
    _exit(int(Fault::failed));
  }
  abort();
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

}  // namespace

void setPatience(std::chrono::milliseconds patience) {
  const auto ms = patience.count();
  patienceTime.it_value = {time_t(ms / 1000), long(ms % 1000) * 1000000};
}

void catchStopSignals(std::chrono::milliseconds patience) {
  setPatience(patience);
  sigevent over{};
  over.sigev_notify = SIGEV_SIGNAL;
  over.sigev_signo = SIGALRM;
  handle(SIGALRM, onPatienceOver);
  hasTimer = timer_create(CLOCK_MONOTONIC, &over, &patienceTimer) == 0;
  handle(SIGINT, onStopSignal);
  handle(SIGTERM, onStopSignal);
}

const Cancellation& stopWish() { return wish; }

bool stopRequested() { return stopSignal != 0; }

Error stopError() {
  return {stopSignal == SIGTERM ? Fault::terminated : Fault::interrupted, "stopped by a signal"};
}

void endWhereMemoryEnds() { std::set_new_handler(outOfMemory); }

void tellWhatTerminates() { std::set_terminate(onTerminate); }

}  // namespace vasa::cli
