// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examiner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "schema/grid/effects.hpp"
#include "schema/grid/job.hpp"
#include "schema/grid/observables.hpp"
#include "schema/grid/rules.hpp"

namespace haff::schema {

namespace {

// In a smaller box a sphere could meet another one and its image at once. [sigma]
constexpr double smallest_box = 2;

// The engine keeps a particle's number in 28 bits, beside four bits about its cell.
constexpr double most_particles = 0x1p28;

// The whole numbers that a double holds exactly.
constexpr double most_collisions = 0x1p53;

// A sample is a row of 115 bytes: so many are 1 GB for each job.
constexpr double most_samples = 1e7;

// A plan takes 1 kB of memory and 1 kB of the store for each job.
constexpr double most_jobs = 2e6;

// Each waiting time keeps 48 bytes of every particle, in memory and in the state.
constexpr std::size_t most_waiting_times = 16;

// Each is a series of its own, and a line of a plan.
constexpr double most_effects = 10'000;

std::string rounded(double value) {  // to 3 digits
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 3);
  return {digits.data(), end.ptr};
}

std::string gigabytes(double bytes) {
  return rounded(bytes / 1e9) + " GB";
}

// The part of the volume that the densest packing of equal spheres, or disks, fills.
double close_packing(int d) {
  return d == 2 ? std::numbers::pi / std::sqrt(12.0) : std::numbers::pi / std::sqrt(18.0);
}

// What effects say about sizes; equal particles are a mixture without a second species.
struct Mixture {
  double fraction = 0;  // of species 2
  double diameter_ratio = 1;

  // clang-tidy 14 takes the zero that <=> compares with for a null pointer.
  auto operator<=>(const Mixture&) const = default;  // NOLINT(modernize-use-nullptr)
};

Mixture mixture_in(const Json& effects) {
  if (!effects.contains("mixture")) return {};
  return {effects["mixture"]["fraction"].get<double>(),
          effects["mixture"]["diameter_ratio"].get<double>()};
}

// The part of the volume that the particles fill.
double packing_fraction(int d, double n, const Mixture& mixture) {
  const double largest = d == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;  // [sigma^d]
  return n * largest *
         (1 - mixture.fraction + mixture.fraction * std::pow(mixture.diameter_ratio, d));
}

class Examiner {
 public:
  Examiner(const std::string& file, const Memory& memory, const Refusal& cannot_start)
      : file_(file), memory_(memory), cannot_start_(cannot_start) {}

  // No list holds a value twice, however it is written.
  void no_repeats(const Json& value, const Pointer& where) const {
    if (value.is_object())
      for (const auto& [key, member] : value.items()) no_repeats(member, where / key);
    if (!value.is_array()) return;
    std::map<Json, std::size_t> first;  // of scalars
    for (std::size_t i = 0; i < value.size(); ++i) {
      no_repeats(value[i], where / i);
      if (!value[i].is_primitive()) continue;
      const auto [known, is_new] = first.try_emplace(value[i], i);
      if (!is_new)
        throw fault(file_, where / i,
                    shown(value[i]) + " is already at " + (where / known->second).to_string() +
                        "; expected each value once");
    }
  }

  void complete(const Source& source) const {
    for (const std::string& key : required_keys())
      if (!source.find(key))
        throw fault(file_, source.where(),
                    "has no \"" + key + "\", and there is none beside \"grids\"; expected " +
                        description(key));
  }

  // Lists within effects multiply: their product must be one that can be made.
  void can_be_counted(const Source& source) const {
    const Placed effects = source["effects"];
    if (const double count = count_expanded(effects.value); count > most_effects)
      throw fault(file_, effects.where,
                  "makes " + rounded(count) + " combinations of effects; expected at most " +
                      text(most_effects));
  }

  // The particles fit into their box, and the box into the machine.
  void fits(const Source& source) const {
    for (const Placed& particles : items(source["N"])) {
      const double N = particles.value.get<double>();
      fits_in_memory(particles, N);
      for (const int d : source.list<int>("d"))
        for (const double n : source.list<double>("n")) {
          fits_in_box(particles, N, n, d);
          suffices_for_observables(source, particles, N, n, d);
        }
      for (const double sample_every : source.list<double>("sample_every"))
        collides_between_samples(source, N, sample_every);
    }
    can_be_packed(source);
  }

  void go_together(const Source& source) const {
    const Placed effects = source["effects"];
    for (const Placed& listed : items(effects))
      for (const Json& one : expanded(listed.value)) {
        const Effects effects_of_one(one.dump());
        if (const auto why = nonsense(effects_of_one)) throw fault(file_, listed.where, *why);
        has_one_restitution(source, effects_of_one);
        if (effects_of_one.contains("thermostat") && !lose_energy_at_e_1(effects_of_one))
          loses_energy(source);
      }
    collides_between_shuffles(source, effects);
    has_both_species(source, effects);
  }

  // How far each e is run, in the order of e.
  std::vector<double> tau_max(const Source& source) const {
    const Placed placed = source["tau_max"];
    const auto e = source.e();
    if (placed.value.is_number())
      return std::vector<double>(std::max<std::size_t>(e.size(), 1), placed.value.get<double>());
    if (e.empty())
      throw fault(file_, placed.where,
                  "is a map from e, which no gas of this grid has; expected a number");
    return matched(placed, e);
  }

  // A map beside "grids" may serve several grids: each of its keys must be the e of one of them.
  void no_strays(const std::vector<Source>& sources) const {
    for (const Source& one : sources) {
      const Placed placed = one["tau_max"];
      if (!placed.value.is_object()) continue;
      std::vector<double> asked;
      for (const Source& source : sources)
        if (source["tau_max"].where == placed.where) {
          const auto e = source.e();
          asked.insert(asked.end(), e.begin(), e.end());
        }
      for (const auto& [key, value] : placed.value.items())
        if (std::count(asked.begin(), asked.end(), restitution(placed.where, key)) == 0)
          throw fault(file_, placed.where / key,
                      "there is no such e; expected the e of this grid: " + listed(asked));
    }
  }

  void sampled(const Source& source, const std::vector<double>& tau_max) const {
    for (const Placed& item : items(source["sample_every"])) {
      const double shortest = *std::min_element(tau_max.begin(), tau_max.end());
      if (item.value.get<double>() > shortest)
        throw fault(file_, item.where,
                    shown(item.value) +
                        " is longer than the run; expected at most tau_max = " + text(shortest));
      const double longest = *std::max_element(tau_max.begin(), tau_max.end());
      if (const double samples = longest / item.value.get<double>(); samples > most_samples)
        throw fault(file_, item.where,
                    shown(item.value) + " makes " + rounded(samples) +
                        " samples of a run to tau_max = " + text(longest) +
                        "; expected at most 10^7, sample_every >= " + text(longest / most_samples));
    }
  }

  // A start that goes with the other keys.
  void can_start(const Source& source) const {
    const Placed seeds = source["seeds"];
    const bool has_several_seeds =
        seeds.value.is_number() ? seeds.value.get<double>() > 1 : seeds.value.size() > 1;
    bool is_equilibrated = false;
    for (const Placed& start : items(source["start"])) {
      const bool is_file = start.value.is_object() && start.value.contains("file");
      is_equilibrated = is_equilibrated || !(is_file || start.value == "crystal");
      if (is_file && has_several_seeds) tells_seeds_apart(source, start);
    }
    const auto equilibrate = source.find("equilibrate");
    if (!is_equilibrated && source.is_given("equilibrate"))
      throw fault(file_, equilibrate->where,
                  shown(equilibrate->value) +
                      " does not go together with \"start\": " + shown(source["start"].value) +
                      ", which is not equilibrated; expected a grid without it");
  }

  // Collisions are counted in whole numbers that a double holds exactly.
  void can_count_collisions(const Source& source, const std::vector<double>& tau_max) const {
    const double longest = *std::max_element(tau_max.begin(), tau_max.end());
    for (const double N : source.list<double>("N"))
      if (const double collisions = 0.5 * longest * N; collisions > most_collisions)
        throw fault(file_, source["tau_max"].where,
                    text(longest) + " makes " + rounded(collisions) + " collisions of " + text(N) +
                        " particles; expected at most 2^53 = 9.01e+15, tau_max below " +
                        rounded(2 * most_collisions / N));
  }

  // Profiles and fields belong to samples within the run.
  void in_step(const Source& source, const std::vector<double>& tau_max) const {
    const auto names = source.observables();
    const double longest = *std::max_element(tau_max.begin(), tau_max.end());
    const auto belongs = [&](const Placed& item) {
      const double tau = item.value.get<double>();
      if (tau > longest)
        throw fault(file_, item.where,
                    text(tau) + " is beyond the run; expected at most tau_max = " + text(longest));
      for (const double sample_every : source.list<double>("sample_every"))
        if (!is_multiple(tau, sample_every))
          throw fault(file_, item.where,
                      text(tau) + " falls between samples; expected a multiple of sample_every = " +
                          text(sample_every));
    };
    if (std::any_of(names.begin(), names.end(), is_profile)) belongs(source["profiles_every"]);
    std::set<double> waiting_times;
    for (const Placed& item : items(source["observables"])) {
      const auto waiting = waiting_time(item.value.get<std::string>());
      if (!waiting) continue;
      belongs({.where = item.where, .value = *waiting});
      if (waiting_times.insert(*waiting).second && waiting_times.size() > most_waiting_times)
        throw fault(file_, item.where,
                    shown(item.value) + " is one waiting time too many; expected at most " +
                        std::to_string(most_waiting_times));
    }
    if (std::none_of(names.begin(), names.end(), is_field)) return;
    const auto moments = source.find("fields_at");
    if (!moments)
      throw fault(file_, source.where(),
                  "has no \"fields_at\", and lists fields among its observables; expected " +
                      description("fields_at"));
    for (const Placed& item : items(*moments)) belongs(item);
  }

  // Moments lie within the run, and collisions lie between them.
  void has_moments(const Source& source, const std::vector<double>& tau_max,
                   const std::string& key) const {
    const auto placed = source.find(key);
    if (!placed) return;
    const double longest = *std::max_element(tau_max.begin(), tau_max.end());
    const bool has_axes = placed->value.is_object() &&
                          (placed->value.contains("tau") || placed->value.contains("time"));
    if (!has_axes) return on_axis_of_tau(source, *placed, longest);
    for (const char* of_tau_alone : {"log", "from"})
      if (placed->value.contains(of_tau_alone))
        throw fault(file_, placed->where / of_tau_alone,
                    "stands beside \"tau\" or \"time\"; expected it within one of them, as in "
                    "{\"tau\": {\"log\": 20}}");
    if (placed->value.contains("tau"))
      on_axis_of_tau(source, {placed->where / "tau", placed->value["tau"]}, longest);
  }

  // A target is something every run measures, and its pilot runs are enough to judge from.
  void reachable(const Source& source, const std::vector<double>& tau_max) const {
    const auto target = source.find("target");
    if (!target) return;
    const Placed pilots = source["seeds"];
    const double count = pilots.value.is_number() ? pilots.value.get<double>()
                                                  : static_cast<double>(pilots.value.size());
    if (count < static_cast<double>(fewest_pilots))
      throw fault(file_, pilots.where,
                  shown(pilots.value) + " are too few pilot runs for a target; expected at least " +
                      std::to_string(fewest_pilots) + " seeds");
    const auto names = source.observables();
    for (const auto& [quantity, wish] : target->value.items()) {
      const Pointer where = target->where / quantity;
      const std::string observable = quantity[0] == 'a' ? "laguerre" : "temperature";
      if (!std::binary_search(names.begin(), names.end(), observable))
        throw fault(
            file_, where,
            "is not measured; expected \"" + observable + "\" among the observables of this grid");
      if (quantity[0] != 'a') cools_by_haff(source, where);
      if (quantity[0] != 'a') starts_by_haff(source, where);
      if (wish.contains("tau")) within_run(source, where / "tau", wish["tau"], tau_max);
    }
  }

  // A plan holds all of its jobs at once.
  void is_not_too_much(const std::vector<Source>& sources) const {
    double jobs = 0;
    for (const Source& source : sources) {
      double product = std::max<double>(1, static_cast<double>(source.e().size())) *
                       count_expanded(source["effects"].value);
      for (const char* key : {"d", "n", "N", "start", "equilibrate", "sample_every"})
        product *= static_cast<double>(items(source[key]).size());
      const Placed seeds = source["seeds"];
      product *= seeds.value.is_number() ? seeds.value.get<double>()
                                         : static_cast<double>(seeds.value.size());
      jobs += product;
      if (jobs > most_jobs)
        throw fault(file_, source.where(),
                    "makes " + rounded(jobs) + " jobs in all; expected at most " +
                        rounded(most_jobs) + " in one plan");
    }
  }

 private:
  // Realizations that start from one state differ by what their effects draw at random.
  void tells_seeds_apart(const Source& source, const Placed& start) const {
    for (const Json& one : expanded(source["effects"].value))
      if (!one.contains("shuffle") && !one.contains("thermostat"))
        throw fault(file_, source["seeds"].where,
                    shown(source["seeds"].value) +
                        " makes realizations that are all the same: they "
                        "start from " +
                        shown(start.value) + ", and nothing in them is random; expected one seed");
  }

  void on_axis_of_tau(const Source& source, const Placed& moments, double longest) const {
    const auto within_run = [&](const Placed& item) {
      if (item.value.get<double>() > longest)
        throw fault(
            file_, item.where,
            shown(item.value) + " is beyond the run; expected at most tau_max = " + text(longest));
    };
    if (moments.value.is_object()) {
      if (!moments.value.contains("log"))
        throw fault(file_, moments.where,
                    "has no \"log\"; expected so many moments a decade, as in {\"log\": 20}");
      if (moments.value.contains("from"))
        within_run({moments.where / "from", moments.value["from"]});
      return;
    }
    auto listed = items(moments);
    for (const Placed& item : listed) within_run(item);
    std::ranges::sort(listed, {}, [](const Placed& item) { return item.value.get<double>(); });
    for (const double N : source.list<double>("N"))
      for (std::size_t k = 1; k < listed.size(); ++k) {
        const double before = listed[k - 1].value.get<double>(),
                     now = listed[k].value.get<double>();
        if (std::ceil(now * N / 2) == std::ceil(before * N / 2))
          throw fault(file_, listed[k].where,
                      text(now) + " is the same collision of " + text(N) + " particles as " +
                          text(before) + "; expected 2/N = " + rounded(2 / N) +
                          " between two moments");
      }
  }

  // gamma_ratio and tau_c compare with Haff's law.
  void cools_by_haff(const Source& source, const Pointer& where) const {
    const auto e = source.e();
    if (e.empty() || std::count(e.begin(), e.end(), 1.0) > 0)
      throw fault(file_, where, "does not exist without a constant e below 1");
    for (const Json& one : expanded(source["effects"].value))
      if (const auto effect = beyond_haffs_law(Effects(one.dump())))
        throw fault(
            file_, where,
            "does not exist with " + *effect +
                ", which changes Haff's law; expected a grid without it, or another target");
  }

  void starts_by_haff(const Source& source, const Pointer& where) const {
    for (const Placed& start : items(source["start"])) {
      const std::string text = start.value.dump();
      for (const char* name : {"shear wave", "two temperatures"})
        if (text.find(name) != std::string::npos)
          throw fault(file_, where,
                      "does not exist where a gas starts as " + shown(start.value) +
                          ": Haff's law is of a uniform one; expected another start or target");
    }
  }

  void within_run(const Source& source, const Pointer& where, const Json& window,
                  const std::vector<double>& tau_max) const {
    const double from = window[0].get<double>(), to = window[1].get<double>();
    const double shortest = *std::min_element(tau_max.begin(), tau_max.end());
    if (to > shortest)
      throw fault(
          file_, where / 1,
          shown(window[1]) + " is beyond the run; expected at most tau_max = " + text(shortest));
    for (const double sample_every : source.list<double>("sample_every"))
      if (to - from < sample_every)
        throw fault(file_, where,
                    shown(window) +
                        " holds no interval between samples; expected a window of at "
                        "least sample_every = " +
                        text(sample_every));
  }

  // Both are rounded: what differs by less than this is the same place. [relative]
  static bool is_multiple(double tau, double interval) {
    constexpr double rounding = 1e-9;
    return std::abs(tau / interval - std::round(tau / interval)) <=
           rounding * std::max(1.0, tau / interval);
  }

  void has_both_species(const Source& source, const Placed& effects) const {
    for (const Placed& mixture : asked(effects, "mixture"))
      for (const Placed& fraction : items(mixture, "fraction"))
        for (const double N : source.list<double>("N"))
          if (const double second = std::round(fraction.value.get<double>() * N);
              second < 1 || second > N - 1)
            throw fault(
                file_, fraction.where,
                shown(fraction.value) + " of " + text(N) +
                    " particles leaves a species without any; expected at least one of each");
  }

  void fits_in_memory(const Placed& particles, double N) const {
    const double bytes = N * memory_.bytes_per_particle;
    if (bytes > memory_.bytes || N >= most_particles)
      throw fault(file_, particles.where,
                  shown(particles.value) + " particles need " + gigabytes(bytes) +
                      "; expected at most the " + gigabytes(memory_.bytes) +
                      " of this machine, and N below 2^28");
  }

  // No gas is denser than close packing, and none is so dense that it cannot be started.
  void can_be_packed(const Source& source) const {
    std::vector<Mixture> mixtures;
    for (const Json& one : expanded(source["effects"].value)) mixtures.push_back(mixture_in(one));
    std::sort(mixtures.begin(), mixtures.end());
    mixtures.erase(std::unique(mixtures.begin(), mixtures.end()), mixtures.end());
    for (const int d : source.list<int>("d"))
      for (const Placed& density : items(source["n"]))
        for (const Mixture& mixture : mixtures) {
          const double n = density.value.get<double>();
          const double packing = packing_fraction(d, n, mixture);
          if (packing >= close_packing(d))
            throw fault(file_, density.where,
                        shown(density.value) + " is too dense: " + (d == 2 ? "disks" : "spheres") +
                            " would fill " + rounded(packing) +
                            " of their box; expected less than close packing, " +
                            (d == 2 ? "pi/sqrt(12) = 0.907" : "pi/sqrt(18) = 0.740") +
                            ", n below " + rounded(n * close_packing(d) / packing));
          can_be_started(source, d, n, packing, mixture);
        }
  }

  void can_be_started(const Source& source, int d, double n, double packing,
                      const Mixture& mixture) const {
    if (!cannot_start_) return;
    for (const Placed& particles : items(source["N"])) {
      const auto N = static_cast<std::uint32_t>(particles.value.get<double>());
      const bool is_mixed = mixture.fraction > 0 && mixture.diameter_ratio < 1;
      for (const Placed& start : items(source["start"])) {
        if (start.value.is_object() && start.value.contains("file")) continue;  // it is prepared
        if (const auto why = cannot_start_({d, n, N, packing, is_mixed, start.value == "crystal"}))
          throw fault(file_, particles.where, shown(particles.value) + " " + *why);
      }
    }
  }

  void fits_in_box(const Placed& particles, double N, double n, int d) const {
    if (N / n >= std::pow(smallest_box, d)) return;
    throw fault(file_, particles.where,
                shown(particles.value) + (d == 2 ? " disks" : " particles") + " at n = " + text(n) +
                    " have a box of " + rounded(N / n) + " sigma^" + std::to_string(d) +
                    "; expected a side of at least " + text(smallest_box) +
                    " sigma, N >= " + text(std::ceil(std::pow(smallest_box, d) * n)));
  }

  void suffices_for_observables(const Source& source, const Placed& particles, double N, double n,
                                int d) const {
    for (const Placed& observable : items(source["observables"])) {
      const auto name = observable.value.get<std::string>();
      const double least = find_observable(name)->widest_refused_box;
      if (N / n > std::pow(least, d)) continue;
      throw fault(file_, observable.where,
                  shown(observable.value) + " needs a box wider than " + text(least) +
                      " sigma, which " + shown(particles.value) + " particles at n = " + text(n) +
                      " do not fill; expected N above " + rounded(std::pow(least, d) * n));
    }
  }

  // A constant e, or a law that gives every collision its own.
  void has_one_restitution(const Source& source, const Effects& effects) const {
    const auto e = source.find("e");
    const auto law = law_without_e(effects);
    if (e && law)
      throw fault(file_, e->where,
                  shown(e->value) + " does not go together with the " + *law +
                      " law, which gives every collision an e of its own; expected one of the two");
    if (!e && !law)
      throw fault(
          file_, source.where(),
          "has no \"e\"" +
              std::string(!source.where().empty() ? ", and there is none beside \"grids\"" : "") +
              "; expected " + description("e"));
  }

  void loses_energy(const Source& source) const {
    const auto e = source.find("e");
    if (!e) return;
    for (const Placed& item : items(*e))
      if (item.value.get<double>() == 1)
        throw fault(file_, item.where,
                    "1 and a thermostat do not go together: an elastic gas would grow hotter "
                    "without end; expected e < 1, or roughness with beta between -1 and 1");
  }

  void collides_between_shuffles(const Source& source, const Placed& effects) const {
    for (const Placed& shuffle : asked(effects, "shuffle"))
      for (const Placed& every : items(shuffle, "every"))
        for (const double N : source.list<double>("N"))
          if (every.value.get<double>() * N < 2)
            throw fault(file_, every.where,
                        shown(every.value) + " is less than one collision of " + text(N) +
                            " particles; expected at least 2/N = " + rounded(2 / N));
  }

  void collides_between_samples(const Source& source, double N, double sample_every) const {
    if (sample_every * N >= 2) return;
    throw fault(file_, source["sample_every"].where,
                text(sample_every) + " is less than one collision of " + text(N) +
                    " particles; expected at least 2/N = " + rounded(2 / N));
  }

  double restitution(const Pointer& where, const std::string& key) const {
    double e = 0;
    const char* end = key.data() + key.size();
    const auto read = std::from_chars(key.data(), end, e);
    if (read.ec != std::errc() || read.ptr != end)
      throw fault(file_, where / key, "is not a number; expected an e of this grid");
    return shortest_decimal(e);
  }

  std::vector<double> matched(const Placed& map, const std::vector<double>& e) const {
    std::vector<std::optional<double>> found(e.size());
    for (const auto& [key, value] : map.value.items()) {
      const auto same = std::find(e.begin(), e.end(), restitution(map.where, key));
      if (same == e.end()) continue;  // another grid's: see no_strays
      auto& tau_max = found[static_cast<std::size_t>(same - e.begin())];
      if (tau_max)
        throw fault(file_, map.where / key,
                    "is the second entry for e = " + text(*same) + "; expected one");
      tau_max = value.get<double>();
    }
    std::vector<double> tau_max;
    for (std::size_t i = 0; i < e.size(); ++i) {
      if (!found[i])
        throw fault(file_, map.where,
                    "has no entry for e = " + text(e[i]) + "; expected one for each e of the grid");
      tau_max.push_back(*found[i]);
    }
    return tau_max;
  }

  static std::string listed(const std::vector<double>& numbers) {
    std::string all;
    for (const double number : numbers) all += (all.empty() ? "" : ", ") + text(number);
    return all;
  }

  const std::string& file_;
  const Memory& memory_;
  const Refusal& cannot_start_;
};

}  // namespace

ExaminedGrid examine(const Json& document, const std::string& file, const Memory& memory,
                     const Refusal& cannot_start) {
  const Examiner examiner(file, memory, cannot_start);
  examiner.no_repeats(document, Pointer());
  ExaminedGrid grid{.sources = sources(document), .tau_max = {}};
  for (const Source& source : grid.sources) {
    examiner.complete(source);
    examiner.can_be_counted(source);
    examiner.go_together(source);
    examiner.can_start(source);
  }
  examiner.no_strays(grid.sources);
  for (const Source& source : grid.sources) {
    examiner.fits(source);
    auto tau_max = examiner.tau_max(source);
    examiner.sampled(source, tau_max);
    examiner.can_count_collisions(source, tau_max);
    examiner.in_step(source, tau_max);
    for (const char* key : {"sample_at", "snapshots_at"})
      examiner.has_moments(source, tau_max, key);
    examiner.reachable(source, tau_max);
    grid.tau_max.push_back(std::move(tau_max));
  }
  examiner.is_not_too_much(grid.sources);
  return grid;
}

}  // namespace haff::schema
