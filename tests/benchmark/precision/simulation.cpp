#include "tests/benchmark/precision/simulation.hpp"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/synchronize.hpp"
#include "tests/benchmark/precision/event_loop.hpp"

namespace haff::single {
namespace {
constexpr std::size_t worth_prefetching = 20000;

double kinetic_energy(const HugeVector<Particle>& particles) {
  double sum = 0;
  for (const Particle& p : particles)
    for (const double v : p.velocity) sum += v * v;
  return 0.5 * sum / static_cast<double>(particles.size());
}

void advance(Particle& p, float now, const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float way = p.velocity[k] * ((now - p.time) * box.inverse);
    p.position[k] += static_cast<std::uint32_t>(
        _mm_cvtss_si32(_mm_set_ss((way - std::nearbyint(way)) * 0x1p32f)));
  }
  p.time = now;
}

std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  x = (x | (x << 2)) & 0x09249249;
  return x;
}
void sort_by_upper_half(std::vector<std::uint64_t>& numbers) {
  constexpr unsigned bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  std::vector<std::uint64_t> sorted(numbers.size());
  for (unsigned shift = 32; shift < 64; shift += bits) {
    const auto digit = [shift](std::uint64_t number) { return number >> shift & (digits - 1); };
    std::array<std::size_t, digits + 1> place{};
    for (const std::uint64_t number : numbers) ++place[digit(number) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const std::uint64_t number : numbers) sorted[place[digit(number)]++] = number;
    numbers.swap(sorted);
  }
}
void sort_in_space(Gas& gas) {
  auto& particles = gas.particles;
  std::vector<std::uint64_t> order(particles.size());
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const auto& x = particles[k].position;
    order[k] = (spread(x[0] >> 22) | spread(x[1] >> 22) << 1 | spread(x[2] >> 22) << 2) << 32 | k;
  }
  sort_by_upper_half(order);
  constexpr std::uint64_t index = 0xffffffff;
  for (std::size_t first = 0; first < particles.size(); ++first) {
    if ((order[first] & index) == first) continue;
    const Particle saved = particles[first];
    const std::uint32_t id = gas.ids[first];
    std::size_t hole = first;
    for (;;) {
      const std::size_t source = order[hole] & index;
      order[hole] = hole;
      if (source == first) break;
      particles[hole] = particles[source];
      gas.ids[hole] = gas.ids[source];
      hole = source;
    }
    particles[hole] = saved;
    gas.ids[hole] = id;
  }
}
}  // namespace

Simulation::Simulation(double e, const engine::State& start)
    : gas_(std::make_unique<Gas>(start)), e_(e) {
  Gas& gas = *gas_;
  for (std::size_t p = 0; p < gas.particles.size(); ++p) {
    Particle& to = gas.particles[p];
    for (std::size_t k = 0; k < 3; ++k) {
      to.position[k] = static_cast<std::uint32_t>(
          static_cast<std::uint64_t>(std::llrint(start.position[p][k] / gas.box.side * 0x1p32)));
      to.velocity[k] = static_cast<float>(start.velocity[p][k]);
    }
    to.time = 0;
    to.changes = 0;
  }
  gas.clock = engine::to_clock(start);
  gas.clock.invariants = {};
  gas.clock.energy = kinetic_energy(gas.particles);
  begin_period();
}
Simulation::~Simulation() = default;

void Simulation::begin_period() {
  Gas& gas = *gas_;
  const auto count = static_cast<double>(gas.particles.size());
  next_stop_ = engine::next_synchronization(gas.clock.collisions, gas.particles.size());
  gas.bricks.clear();
  const double rate = count * std::sqrt(2 * gas.clock.energy) * (1 + 4 * count / gas.box.volume());
  gas.calendar.restart(rate, count < worth_prefetching ? 0 : 12);
  for (std::uint32_t p = 0; p < gas.particles.size(); ++p) {
    gas.calendar[p].cell = gas.bricks.locate(gas.particles[p].position);
    gas.bricks.insert(p, gas.calendar[p].cell);
  }
  EventLoop<false>(gas, e_).predict_all();
}

void Simulation::synchronize() {
  Gas& gas = *gas_;
  engine::Clock& clock = gas.clock;
  const double energy = kinetic_energy(gas.particles);
  const double lost =
      (clock.taken + clock.tally.dissipated) / static_cast<double>(gas.particles.size());
  clock.invariants.energy_mismatch = std::max(
      clock.invariants.energy_mismatch, std::abs(clock.energy - energy - lost) / clock.energy);
  for (Particle& p : gas.particles) {
    advance(p, static_cast<float>(clock.now), gas.box);
    p.time = 0;
    p.changes = 0;
  }
  clock.before.dissipated += clock.tally.dissipated;
  clock.before.virial += clock.tally.virial;
  clock.tally = {};
  clock.taken = 0;
  clock.start = clock.time();
  clock.now = 0;
  std::array<double, 3> total{};
  for (const Particle& p : gas.particles)
    for (std::size_t k = 0; k < 3; ++k) total[k] += p.velocity[k];
  const auto count = static_cast<double>(gas.particles.size());
  for (Particle& p : gas.particles)
    for (std::size_t k = 0; k < 3; ++k)
      p.velocity[k] = static_cast<float>(p.velocity[k] - total[k] / count);
  clock.invariants.momentum_removed =
      std::max(clock.invariants.momentum_removed,
               std::sqrt((total[0] * total[0] + total[1] * total[1] + total[2] * total[2]) /
                         (count * 2 * kinetic_energy(gas.particles))));
  sort_in_space(gas);
  int doublings = 0;
  double left = kinetic_energy(gas.particles);
  for (; left < 0.25; left *= 4) ++doublings;
  if (doublings > 0) {
    const double factor = std::ldexp(1.0, doublings);
    for (Particle& p : gas.particles)
      for (float& v : p.velocity) v *= static_cast<float>(factor);
    clock.exponent += doublings;
    clock.before.virial *= factor;
    clock.before.dissipated *= factor * factor;
  }
  clock.energy = kinetic_energy(gas.particles);
  begin_period();
}

void Simulation::run_to(std::int64_t collisions) {
  while (gas_->clock.collisions < collisions) {
    const std::int64_t stop = std::min(collisions, next_stop_);
    if (gas_->particles.size() < worth_prefetching)
      EventLoop<false>(*gas_, e_).run(stop);
    else
      EventLoop<true>(*gas_, e_).run(stop);
    if (gas_->clock.collisions == next_stop_) synchronize();
  }
}

double Simulation::time() const {
  return gas_->clock.time();
}
int Simulation::exponent() const {
  return gas_->clock.exponent;
}
engine::Invariants Simulation::invariants() const {
  return gas_->clock.invariants;
}
engine::Events Simulation::events() const {
  return gas_->events;
}
double Simulation::latest() const {
  return gas_->latest;
}
engine::Tally Simulation::take_tally() {
  return engine::take_tally(gas_->clock);
}
double Simulation::energy() const {
  return std::ldexp(kinetic_energy(gas_->particles), -2 * exponent());
}
std::size_t Simulation::memory() const {
  return gas_->particles.capacity() * sizeof(Particle) + gas_->ids.capacity() * 4 +
         gas_->bricks.memory() + gas_->calendar.memory();
}
std::vector<engine::Vector> Simulation::velocities() const {
  std::vector<engine::Vector> all;
  for (const Particle& p : gas_->particles)
    all.push_back({p.velocity[0], p.velocity[1], p.velocity[2]});
  return all;
}
std::vector<engine::Vector> Simulation::positions() const {
  std::vector<engine::Vector> all;
  for (Particle p : gas_->particles) {
    advance(p, static_cast<float>(gas_->clock.now), gas_->box);
    engine::Vector x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = p.position[k] * 0x1p-32 * gas_->box.side;
    all.push_back(x);
  }
  return all;
}
}  // namespace haff::single
