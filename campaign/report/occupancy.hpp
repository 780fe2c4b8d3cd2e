// SPDX-License-Identifier: GPL-3.0-or-later

// How many processors a campaign kept busy, over time.
#pragma once

#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// Processors at work on one host. busy[k] holds from time[k] to time[k + 1], and is 0 after the
// last. Times are seconds since 1970, UTC.
struct Occupancy {
  std::string host;
  std::vector<double> time, busy;
};

// From the start, the end and the CPU time of each job, since a store keeps no more. A job's CPU
// time is spread evenly from its first start to its end, or to its last sign of life, so that a job
// that was interrupted for a night counts for little in that time. The hosts are in their order.
std::vector<Occupancy> occupancy(const std::vector<schema::JobRow>& jobs,
                                 const std::vector<schema::RunningJob>& running);

// "2003-09-05T12:00:00.000Z" as seconds since 1970; NaN if it is no such text.
double seconds_of(const std::string& utc);

}  // namespace haff::campaign
