// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/expansion.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace haff::campaign {
namespace {

class Plan {
 public:
  void add(const schema::Job& job, double tau_max, double checkpoint_every) {
    const auto [place, is_new] = places_.try_emplace(identity(job), jobs_.size());
    if (is_new) {
      jobs_.push_back({job, tau_max, checkpoint_every, std::nullopt});
      return;
    }
    schema::Planned& known = jobs_[place->second];
    known.tau_max = std::max(known.tau_max, tau_max);
    known.checkpoint_every = std::min(known.checkpoint_every, checkpoint_every);
  }

  std::vector<schema::Planned> take() { return std::move(jobs_); }

 private:
  std::vector<schema::Planned> jobs_;
  std::unordered_map<std::string, std::size_t> places_;
};

template <class Visit>
void for_each_job(const schema::SubGrid& grid, Visit&& visit) {
  for (const int d : grid.d)
    for (std::size_t k = 0; k < grid.tau_max.size(); ++k)  // one for each e
      for (const double n : grid.n)
        for (const std::uint32_t particles : grid.particles)
          for (const double equilibrate : grid.equilibrate)
            for (const double sample_every : grid.sample_every)
              for (const schema::Effects& effects : grid.effects)
                for (const std::uint64_t seed : grid.seeds) {
                  schema::Job job;
                  job.kind = schema::Kind::cooling;
                  job.d = d;
                  job.e = grid.e.empty() ? std::nullopt : std::optional(grid.e[k]);
                  job.n = n;
                  job.particles = particles;
                  job.seed = seed;
                  job.equilibrate = equilibrate;
                  job.sample_every = sample_every;
                  job.effects = effects;
                  job.observables = grid.observables;
                  job.profiles_every = grid.profiles_every;
                  job.fields_at = grid.fields_at;
                  job.sample_at = grid.sample_at;
                  job.snapshots_at = grid.snapshots_at;
                  visit(job, grid.tau_max[k]);
                }
}

}  // namespace

std::vector<schema::Planned> expand(const schema::Grid& grid) {
  Plan plan;
  for (const schema::SubGrid& part : grid.grids)
    for_each_job(part, [&](const schema::Job& job, double tau_max) {
      plan.add(equilibration_of(job), job.equilibrate, part.checkpoint_every);
      plan.add(job, tau_max, part.checkpoint_every);
    });
  return plan.take();
}

std::vector<schema::Target> targets_of(const schema::Grid& grid) {
  std::vector<schema::Target> all;
  for (const schema::SubGrid& part : grid.grids)
    for_each_job(part, [&](const schema::Job& job, double) {
      if (job.seed != part.seeds.front()) return;
      for (schema::Target target : part.targets) {
        target.series = schema::series_identity(job);
        target.pilots = part.seeds;
        all.push_back(std::move(target));
      }
    });
  return all;
}

}  // namespace haff::campaign
