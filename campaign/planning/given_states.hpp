// SPDX-License-Identifier: GPL-3.0-or-later

// States of the user's own, that grids name by a file: read, checked, and made those of a job.
#pragma once

#include <map>
#include <string>

#include "campaign/planning/expansion.hpp"

namespace haff::campaign {

class GivenStates {
 public:
  // The state in the file as the start of such a job, and its digest, which names what is in the
  // file whatever the file is called. Reads each file once for each gas. Throws schema::GridError,
  // with the place in the grid and in the file, if it is not a sound state of this gas.
  GivenState state_of(const schema::AskedStart& asked, const schema::Job& job);

 private:
  std::map<std::string, GivenState> known_;
};

}  // namespace haff::campaign
