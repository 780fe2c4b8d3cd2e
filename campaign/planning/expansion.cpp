// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/expansion.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace haff::campaign {
namespace {

class Plan {
 public:
  void add(schema::Planned planned) {
    const auto [place, is_new] = places_.try_emplace(identity(planned.job), jobs_.size());
    if (is_new) {
      jobs_.push_back(std::move(planned));
      return;
    }
    schema::Planned& known = jobs_[place->second];
    known.tau_max = std::max(known.tau_max, planned.tau_max);
    known.checkpoint_every = std::min(known.checkpoint_every, planned.checkpoint_every);
  }

  std::vector<schema::Planned> take() { return std::move(jobs_); }

 private:
  std::vector<schema::Planned> jobs_;
  std::unordered_map<std::string, std::size_t> places_;
};

// How long gases with this start are equilibrated: not at all if it is a crystal or a file.
std::vector<double> equilibrations(const schema::SubGrid& grid, const schema::AskedStart& asked) {
  return asked.start.is_equilibrated() ? grid.equilibrate : std::vector<double>{0};
}

template <class Visit>
void for_each_job(const schema::SubGrid& grid, const ReadState& read_state, Visit&& visit) {
  for (const int d : grid.d)
    for (std::size_t k = 0; k < grid.tau_max.size(); ++k)  // one for each e
      for (const double n : grid.n)
        for (const std::uint32_t particles : grid.particles)
          for (const schema::AskedStart& asked : grid.starts)
            for (const double equilibrate : equilibrations(grid, asked))
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
                    job.start = asked.start;
                    job.equilibrate = equilibrate;
                    job.sample_every = sample_every;
                    job.sample_at = grid.sample_at;
                    job.effects = effects;
                    job.observables = grid.observables;
                    job.profiles_every = grid.profiles_every;
                    job.fields_at = grid.fields_at;
                    job.snapshots_at = grid.snapshots_at;
                    GivenState given;
                    if (asked.start.kind == schema::Start::Kind::file && read_state) {
                      given = read_state(asked, job);
                      job.start.digest = given.digest;
                    }
                    visit(job, grid.tau_max[k], given);
                  }
}

}  // namespace

std::vector<schema::Planned> expand(const schema::Grid& grid, const ReadState& read_state) {
  Plan plan;
  for (const schema::SubGrid& part : grid.grids)
    for_each_job(
        part, read_state, [&](const schema::Job& job, double tau_max, const GivenState& given) {
          const schema::Job start = equilibration_of(job);
          plan.add({.job = start,
                    .tau_max = tau_max_of_equilibration(start),
                    .checkpoint_every = part.checkpoint_every,
                    .given_state = given.state});
          plan.add({.job = job, .tau_max = tau_max, .checkpoint_every = part.checkpoint_every});
        });
  return plan.take();
}

std::vector<schema::Target> targets_of(const schema::Grid& grid, const ReadState& read_state) {
  std::vector<schema::Target> all;
  for (const schema::SubGrid& part : grid.grids)
    for_each_job(part, read_state, [&](const schema::Job& job, double, const GivenState&) {
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
