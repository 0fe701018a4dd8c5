// SPDX-License-Identifier: BSD-3-Clause
#include "Session/Interrupts.h"

#include "Files/WorkFolder.h"
#include "Session/Ranks.h"
#include "Session/StderrCapture.h"

#include <atomic>
#include <csignal>
#include <thread>

#include <time.h>
#include <unistd.h>

namespace freespace
{

namespace
{

std::atomic<int> arrived{ 0 };
std::atomic<bool> isTold{ false };

// Makes a signal one that is waited for, even if it was ignored, as in background jobs of a shell.
void Nothing(int) {}

[[noreturn]] void EndNow()
{
  RemoveWorkFolders();
  constexpr char sentence[] = "freespace: Stopped on request.\n";
  if (LaunchedRank() == 0 && IsFirstToTellInterrupt() &&
    write(StderrCapture::RealDescriptor(), sentence, sizeof sentence - 1) < 0)
  {
    // Nothing else can be done.
  }
  _exit(InterruptStatus());
}

void Listen(const sigset_t& signals)
{
  int signal = 0;
  if (sigwait(&signals, &signal) != 0)
  {
    return;
  }
  arrived = signal;
  const timespec patience = { 0, 300000000 }; // nanoseconds
  sigtimedwait(&signals, nullptr, &patience);
  EndNow();
}

}

void ListenToInterrupts()
{
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : { SIGINT, SIGTERM })
  {
    sigaddset(&signals, signal);
    std::signal(signal, Nothing);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] { Listen(signals); }).detach();
}

int Interrupt()
{
  return arrived;
}

bool IsFirstToTellInterrupt()
{
  return !isTold.exchange(true);
}

int InterruptStatus()
{
  return 128 +
    (arrived != 0 ? arrived.load() : SIGINT); // of another process where there are several
}

}
