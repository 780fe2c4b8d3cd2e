// SPDX-License-Identifier: GPL-3.0-or-later

// The page of `campaign report`, served to browsers on this machine while a run is on.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace haff::campaign {

// Answers on 127.0.0.1 only, and only if the address holds a token that is drawn at random for each
// server: other users of the machine do not know it. Reads the store anew for each answer,
// and never writes it. Port 0: any that is free. `ready` is told the address once it can be asked.
// Returns when a signal asks to stop (note_stop_signals). Throws PageMissing, std::runtime_error if
// the port is taken, and the errors of the store if it cannot be read at the start.
void serve_report(const std::filesystem::path& store, int port,
                  const std::function<void(const std::string& address)>& ready);

}  // namespace haff::campaign
