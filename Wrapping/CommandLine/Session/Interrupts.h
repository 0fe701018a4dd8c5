// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Interrupts_h
#define freespace_Interrupts_h

namespace freespace
{

/// Starts to wait for SIGINT and SIGTERM on a separate thread. Call it before other threads start, so that
/// they inherit the signal mask. A signal asks the running stage to stop. Where it has not
/// done so after a third of a second, or at a second signal, the process removes what it has half written
/// and ends.
void ListenToInterrupts();

/// The signal that came; 0: none.
int Interrupt();

/// True for the first who asks: who tells that the process was stopped. That can be the thread that waits for signals.
bool IsFirstToTellInterrupt();

/// The exit status of a process that was stopped by it: 130 for SIGINT, 143 for SIGTERM.
int InterruptStatus();

}

#endif
