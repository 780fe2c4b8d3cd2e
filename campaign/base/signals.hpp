// Signals that ask to stop: Ctrl-C (SIGINT) and SIGTERM.
//
// They are only noted; whoever works looks often and leaves in order.
#pragma once

namespace haff::campaign {

// From here on the two signals are noted instead of ending the process, and writing to a pipe
// nobody reads, or past a file size limit, is an error of the write instead of a signal.
void note_stop_signals();

// The signal that asked to stop, or 0.
int stop_signal();

// How often one came: who asks twice is in a hurry.
int stop_signals();

}  // namespace haff::campaign
