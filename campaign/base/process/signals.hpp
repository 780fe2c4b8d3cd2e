// SPDX-License-Identifier: GPL-3.0-or-later

// Signals that ask to stop: Ctrl-C (SIGINT), SIGTERM, a terminal that is gone (SIGHUP), and what
// batch systems send before a time limit (SIGUSR1, SIGUSR2, SIGXCPU).
//
// They are only noted. The work looks for them often, and stops in order.
#pragma once

namespace haff::campaign {

// From here on these signals are noted instead of ending the process, whatever the parent had
// blocked; only a SIGHUP that the parent had ignored (nohup) stays ignored. Writing to a pipe that
// nothing reads, or past a file size limit, is an error of the write instead of a signal. Children
// that end can be waited for, even where the parent ignored SIGCHLD.
void note_stop_signals();

// The signal that asked to stop, or 0.
int stop_signal();

// How many came: the second means "at once". A signal that comes a fraction of a second after the
// first one counts as the first one, passed on by another process.
int stop_signals();

// Whether there is time to wait for another process to release the store: always before a stop
// signal, a moment after it.
bool may_wait_for_locks();

}  // namespace haff::campaign
