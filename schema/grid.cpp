#include "schema/grid.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>

#include "schema/document.hpp"
#include "schema/effects.hpp"
#include "schema/job.hpp"
#include "schema/rules.hpp"

namespace haff::schema {

namespace {

// Disks that touch six others each. [sigma^-2]
constexpr double densest_disks = 2 / std::numbers::sqrt3;

// Below this side of the box a sphere would meet another one and its image at once. [sigma]
constexpr double smallest_box = 2;

// What the engine can number in one word together with a particle's cell.
constexpr double most_particles = 0x1p28;

// ---- the file ---------------------------------------------------------------------------------

std::string contents(const std::filesystem::path& path) try {
  std::ifstream stream(path, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  return {std::istreambuf_iterator<char>(stream), {}};
} catch (const std::ios_base::failure&) {
  throw GridError(path.string() + ": cannot be read: " + std::strerror(errno));
}

// ---- one grid among its defaults --------------------------------------------------------------

// A value and where in the file it stands.
struct Placed {
  Pointer where;
  Json value;
};

// A scalar, or what a list holds, each with its place.
std::vector<Placed> items(const Placed& placed) {
  if (!placed.value.is_array()) return {placed};
  std::vector<Placed> list;
  for (std::size_t i = 0; i < placed.value.size(); ++i)
    list.push_back({placed.where / i, placed.value[i]});
  return list;
}

// An effect wherever it stands among the effects of a grid, each without a list around it.
std::vector<Placed> asked(const Placed& effects, const std::string& effect) {
  std::vector<Placed> list;
  for (const Placed& one : items(effects))
    if (one.value.contains(effect))
      for (Placed& choice : items({one.where / effect, one.value[effect]}))
        list.push_back(std::move(choice));
  return list;
}

// What its key holds.
std::vector<Placed> items(const Placed& effect, const std::string& key) {
  return items({effect.where / key, effect.value[key]});
}

// A grid of the document: its own keys, else those beside "grids", else the schema's defaults.
class Source {
 public:
  Source(const Json& document, Pointer where) : document_(document), where_(std::move(where)) {}

  const Pointer& where() const { return where_; }

  std::optional<Placed> find(const std::string& key) const {
    for (const Pointer& place : {where_ / key, Pointer() / key})
      if (document_.contains(place)) return Placed{place, document_.at(place)};
    if (Json value = default_value(key); !value.is_null()) return Placed{where_ / key, value};
    return std::nullopt;
  }

  Placed operator[](const std::string& key) const { return find(key).value(); }

  std::vector<double> e() const { return find("e") ? list<double>("e") : std::vector<double>(); }

  template <class Number>
  std::vector<Number> list(const std::string& key) const {
    std::vector<Number> numbers;
    for (const Placed& item : items((*this)[key]))
      numbers.push_back(static_cast<Number>(item.value.get<double>() + 0.0));  // -0 is 0
    return numbers;
  }

 private:
  const Json& document_;
  Pointer where_;
};

std::vector<Source> sources(const Json& document) {
  if (!document.contains("grids")) return {Source(document, Pointer())};
  std::vector<Source> list;
  for (std::size_t i = 0; i < document["grids"].size(); ++i)
    list.emplace_back(document, Pointer() / "grids" / i);
  return list;
}

std::vector<std::string> observables(const Source& source) {
  std::vector<std::string> names;
  for (const Placed& item : items(source["observables"]))
    names.push_back(item.value.get<std::string>());
  std::sort(names.begin(), names.end());
  return names;
}

// Whatever holds a list, at any depth, becomes several without one: the product of all lists.
// Numbers are written in one way, so that equal effects have equal texts.
std::vector<Json> expanded(const Json& value) {
  if (value.is_number()) return {value.get<double>() + 0.0};
  std::vector<Json> all;
  if (value.is_array()) {
    for (const Json& item : value)
      for (Json& one : expanded(item)) all.push_back(std::move(one));
    return all;
  }
  if (!value.is_object()) return {value};
  all.push_back(Json::object());
  for (const auto& [key, member] : value.items()) {
    std::vector<Json> product;
    for (const Json& choice : expanded(member))
      for (Json one : all) {
        one[key] = choice;
        product.push_back(std::move(one));
      }
    all = std::move(product);
  }
  return all;
}

// ---- rules that a JSON schema cannot express --------------------------------------------------

// The shortest text that reads back as the same number: 0.8, 32000.
std::string text(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string rounded(double value) {  // to 3 digits
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 3);
  return {digits.data(), end.ptr};
}

std::string gigabytes(double bytes) {
  return rounded(bytes / 1e9) + " GB";
}

// Checks one file; every function throws GridError.
class Examiner {
 public:
  Examiner(const std::string& file, const Memory& memory) : file_(file), memory_(memory) {}

  // No list holds a value twice, however it is written.
  void no_repeats(const Json& value, const Pointer& where) const {
    if (value.is_object())
      for (const auto& [key, member] : value.items()) no_repeats(member, where / key);
    if (!value.is_array()) return;
    for (std::size_t i = 0; i < value.size(); ++i) {
      no_repeats(value[i], where / i);
      const auto first = std::find(value.begin(), value.end(), value[i]) - value.begin();
      if (static_cast<std::size_t>(first) < i && value[i].is_primitive())
        throw fault(file_, where / i,
                    shown(value[i]) + " is already at " +
                        (where / static_cast<std::size_t>(first)).to_string() +
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

  void fits(const Source& source) const {
    const auto dimensions = source.list<int>("d");
    if (std::find(dimensions.begin(), dimensions.end(), 2) != dimensions.end()) suits_disks(source);
    for (const Placed& particles : items(source["N"])) {
      const double N = particles.value.get<double>();
      fits_in_memory(particles, N);
      for (const int d : dimensions)
        for (const double n : source.list<double>("n")) fits_in_box(particles, N, n, d);
      for (const double sample_every : source.list<double>("sample_every"))
        collides_between_samples(source, N, sample_every);
    }
  }

  void go_together(const Source& source) const {
    const Placed effects = source["effects"];
    for (const Placed& listed : items(effects))
      for (const Json& one : expanded(listed.value)) {
        if (const auto why = nonsense(one)) throw fault(file_, listed.where, *why);
        has_one_restitution(source, one);
        if (one.contains("thermostat") && !lose_energy_at_e_1(one)) loses_energy(source);
      }
    collides_between_shuffles(source, effects);
    has_both_species(source, effects);
    for (const Placed& observable : items(source["observables"])) {
      const auto name = observable.value.get<std::string>();
      if (!asked(effects, "mixture").empty() && (is_profile(name) || is_field(name)))
        throw fault(file_, observable.where,
                    shown(observable.value) +
                        " is of equal spheres; with a mixture expected \"temperature\" or "
                        "\"laguerre\"");
    }
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
    }
  }

  // Profiles and fields belong to samples within the run.
  void in_step(const Source& source, const std::vector<double>& tau_max) const {
    const auto names = observables(source);
    const double longest = *std::max_element(tau_max.begin(), tau_max.end());
    const auto belongs = [&](const Placed& item) {
      const double tau = item.value.get<double>();
      if (tau > longest)
        throw fault(
            file_, item.where,
            shown(item.value) + " is beyond the run; expected at most tau_max = " + text(longest));
      for (const double sample_every : source.list<double>("sample_every"))
        if (!is_multiple(tau, sample_every))
          throw fault(file_, item.where,
                      shown(item.value) +
                          " falls between samples; expected a multiple of sample_every = " +
                          text(sample_every));
    };
    if (std::any_of(names.begin(), names.end(), is_profile)) belongs(source["profiles_every"]);
    if (std::none_of(names.begin(), names.end(), is_field)) return;
    const auto moments = source.find("fields_at");
    if (!moments)
      throw fault(file_, source.where(),
                  "has no \"fields_at\", and lists fields among its observables; expected " +
                      description("fields_at"));
    for (const Placed& item : items(*moments)) belongs(item);
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
    const auto names = observables(source);
    for (const auto& [quantity, wish] : target->value.items()) {
      const Pointer where = target->where / quantity;
      const std::string observable = quantity[0] == 'a' ? "laguerre" : "temperature";
      if (!std::binary_search(names.begin(), names.end(), observable))
        throw fault(
            file_, where,
            "is not measured; expected \"" + observable + "\" among the observables of this grid");
      if (quantity[0] != 'a') cools_by_haff(source, where);
      if (wish.contains("tau")) within_run(source, where / "tau", wish["tau"], tau_max);
    }
  }

 private:
  // gamma_ratio and tau_c compare with Haff's law.
  void cools_by_haff(const Source& source, const Pointer& where) const {
    const auto e = source.e();
    if (e.empty() || std::count(e.begin(), e.end(), 1.0) > 0)
      throw fault(file_, where, "does not exist without a constant e below 1");
    for (const Json& one : expanded(source["effects"].value))
      if (const auto effect = beyond_haffs_law(one))
        throw fault(
            file_, where,
            "does not exist with " + *effect +
                ", which changes Haff's law; expected a grid without it, or another target");
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

  void suits_disks(const Source& source) const {
    for (const Placed& density : items(source["n"]))
      if (density.value.get<double>() >= densest_disks)
        throw fault(file_, density.where,
                    shown(density.value) + " is too dense for disks (d = 2); expected n below " +
                        "2/sqrt(3) = 1.1547 (close packing)");
  }

  void fits_in_box(const Placed& particles, double N, double n, int d) const {
    if (N / n >= std::pow(smallest_box, d)) return;
    const double side = d == 2 ? std::sqrt(N / n) : std::cbrt(N / n);
    throw fault(file_, particles.where,
                shown(particles.value) + (d == 2 ? " disks" : " particles") + " at n = " + text(n) +
                    " make a box of side L = " + rounded(side) +
                    " sigma; expected L >= " + text(smallest_box) +
                    " sigma, N >= " + text(std::ceil(std::pow(smallest_box, d) * n)));
  }

  // A constant e, or a law that gives every collision its own.
  void has_one_restitution(const Source& source, const Json& effects) const {
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
    return e;
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
};

// ---- the grid ---------------------------------------------------------------------------------

std::vector<std::uint64_t> seeds(const Placed& placed) {
  std::vector<std::uint64_t> list;
  if (placed.value.is_number()) {
    const auto count = static_cast<std::uint64_t>(placed.value.get<double>());
    for (std::uint64_t seed = 1; seed <= count; ++seed) list.push_back(seed);
  } else {
    for (const Json& seed : placed.value)
      list.push_back(static_cast<std::uint64_t>(seed.get<double>()));
  }
  return list;
}

std::vector<Target> targets(const Source& source) {
  const auto placed = source.find("target");
  if (!placed) return {};
  std::vector<Target> all;
  for (const auto& [quantity, wish] : placed->value.items()) {
    Target target{.series = {}, .quantity = quantity, .se = wish["se"].get<double>()};
    if (wish.contains("tau")) {
      target.tau_from = wish["tau"][0].get<double>();
      target.tau_to = wish["tau"][1].get<double>();
    }
    all.push_back(std::move(target));
  }
  return all;
}

std::vector<std::string> effects(const Placed& placed) {
  std::vector<std::string> texts;
  for (Json& one : expanded(placed.value)) {
    // What is so without being asked for is no effect.
    if (one.value("/restitution/law"_json_pointer, "") == "constant") one.erase("restitution");
    std::string text = one.dump();
    if (std::find(texts.begin(), texts.end(), text) == texts.end())
      texts.push_back(std::move(text));
  }
  return texts;
}

SubGrid sub_grid(const Source& source, std::vector<double> tau_max) {
  SubGrid grid{.d = source.list<int>("d"),
               .e = source.e(),
               .n = source.list<double>("n"),
               .particles = source.list<std::uint32_t>("N"),
               .seeds = seeds(source["seeds"]),
               .tau_max = std::move(tau_max),
               .sample_every = source.list<double>("sample_every"),
               .equilibrate = source.list<double>("equilibrate"),
               .checkpoint_every = source["checkpoint_every"].value.get<double>(),
               .observables = observables(source),
               .profiles_every = std::nullopt,
               .fields_at = {},
               .effects = effects(source["effects"]),
               .targets = targets(source)};
  // Kept where they decide what is measured: elsewhere two grids that differ in them are the same.
  const auto& names = grid.observables;
  if (std::any_of(names.begin(), names.end(), is_profile))
    grid.profiles_every = source["profiles_every"].value.get<double>();
  if (std::any_of(names.begin(), names.end(), is_field)) {
    grid.fields_at = source.list<double>("fields_at");
    std::sort(grid.fields_at.begin(), grid.fields_at.end());
  }
  return grid;
}

}  // namespace

Grid parse_grid(std::string_view text, const std::string& file, const Memory& memory) {
  const Json document = read_document(text, file);
  check_rules(document, file);

  const Examiner examiner(file, memory);
  examiner.no_repeats(document, Pointer());
  const auto all = sources(document);
  for (const Source& source : all) {
    examiner.complete(source);
    examiner.go_together(source);
  }
  examiner.no_strays(all);

  Grid grid{.name = document.value("name", ""), .grids = {}};
  for (const Source& source : all) {
    examiner.fits(source);
    auto tau_max = examiner.tau_max(source);
    examiner.sampled(source, tau_max);
    examiner.in_step(source, tau_max);
    examiner.reachable(source, tau_max);
    grid.grids.push_back(sub_grid(source, std::move(tau_max)));
  }
  return grid;
}

Grid read_grid(const std::filesystem::path& path, const Memory& memory) {
  return parse_grid(contents(path), path.string(), memory);
}

}  // namespace haff::schema
