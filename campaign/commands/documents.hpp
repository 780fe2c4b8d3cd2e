// SPDX-License-Identifier: GPL-3.0-or-later

// The man page and the completions of shells, made from the same description of the command line as
// --help, so that they agree with it. The hidden command `campaign document`
// prints them; `cmake --install` puts them where man and the shells look.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace haff::campaign {

inline constexpr const char* document_kinds[] = {"man", "bash", "zsh", "fish"};

// One of document_kinds. Throws std::invalid_argument for another.
std::string document(const CLI::App& app, const std::string& kind);

}  // namespace haff::campaign
