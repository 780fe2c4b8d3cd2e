#include "engine/initial.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "engine/growth.hpp"
#include "engine/random.hpp"
#include "engine/simulation.hpp"
#include "engine/synchronize.hpp"

namespace haff::engine {
namespace {

// By Newton's method from above, where every step decreases until rounding stops it: std::cbrt is
// not correctly rounded, and its last bit would be the trajectory's.
double cube_root(double x) {
  double root = std::max(x, 1.0);
  for (;;) {
    const double next = root - (root - x / (root * root)) / 3;
    if (!(next < root)) return root;
    root = next;
  }
}

// Sites of a face-centred cubic lattice with `cells` cubic cells along an axis.
Vector lattice_site(std::uint64_t site, std::uint64_t cells, double spacing) {
  static constexpr Vector basis[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  const std::uint64_t cell = site / 4;
  const Vector& offset = basis[site % 4];
  const Vector corner{static_cast<double>(cell % cells), static_cast<double>(cell / cells % cells),
                      static_cast<double>(cell / (cells * cells))};
  Vector position;
  for (std::size_t k = 0; k < 3; ++k) position[k] = (corner[k] + offset[k] + 0.25) * spacing;
  return position;
}

std::uint64_t cells_along(std::uint32_t count) {
  std::uint64_t cells = 1;
  while (4 * cells * cells * cells < count) ++cells;
  return cells;
}

bool lattice_fits(std::uint32_t count, const Box& box) {
  return box.side / static_cast<double>(cells_along(count)) / std::sqrt(2.0) >= 1;
}

// A triangular lattice, stretched to fit a square: cells of two sites, the second in the middle.
struct Triangular {
  std::uint64_t columns = 0;
  std::uint64_t rows = 0;
  double width = 0;  // of a cell
  double height = 0;
  double distance = 0;  // of nearest neighbours
};

// With enough sites for so many disks, nearest neighbours as far apart as can be.
Triangular triangular(std::uint32_t count, const Box& box) {
  Triangular best;
  for (std::uint64_t columns = 1; (columns - 1) * (columns - 1) < count; ++columns) {
    const std::uint64_t rows = (count + 2 * columns - 1) / (2 * columns);
    const double width = box.side / static_cast<double>(columns);
    const double height = box.side / static_cast<double>(rows);
    const double diagonal = std::sqrt(width * width + height * height);
    const double distance = std::min({width, height, 0.5 * diagonal});
    if (distance > best.distance) best = {columns, rows, width, height, distance};
  }
  return best;
}

std::vector<Vector> triangular_positions(std::uint32_t count, const Triangular& lattice) {
  std::vector<Vector> positions(count);
  for (std::uint64_t k = 0; k < count; ++k) {  // vacant sites are spread evenly
    const std::uint64_t site = k * 2 * lattice.columns * lattice.rows / count;
    const std::uint64_t cell = site / 2;
    const double offset = site % 2 == 0 ? 0.25 : 0.75;
    positions[k] = {(static_cast<double>(cell % lattice.columns) + offset) * lattice.width,
                    (static_cast<double>(cell / lattice.columns) + offset) * lattice.height, 0};
  }
  return positions;
}

std::vector<Vector> lattice_positions(std::uint32_t count, const Box& box) {
  const std::uint64_t cells = cells_along(count);
  const std::uint64_t sites = 4 * cells * cells * cells;
  std::vector<Vector> positions(count);
  for (std::uint64_t k = 0; k < count; ++k)  // vacant sites are spread evenly
    positions[k] = lattice_site(k * sites / count, cells, box.side / static_cast<double>(cells));
  return positions;
}

template <class Masses>
void set_energy(std::vector<Particle>& particles, double energy, const Masses& masses) {
  const double factor = std::sqrt(energy / kinetic_energy(particles, masses));
  for (Particle& p : particles)
    for (double& v : p.velocity) v *= factor;
}

// All species at one temperature.
template <class Masses>
void draw_velocities(std::vector<Particle>& particles, std::uint64_t seed, int d,
                     const Masses& masses) {
  Random random(seed, Stream::velocities);
  for (Particle& p : particles)
    for (double& v : std::span(p.velocity).first(static_cast<std::size_t>(d)))
      v = random.normal() / std::sqrt(masses.of(p));
  remove_momentum(particles, masses);
  set_energy(particles, 1, masses);
}

// Who is where: species at random (R. Durstenfeld's shuffle).
void mix(std::vector<Particle>& particles, std::uint64_t seed) {
  Random random(seed, Stream::mixture);
  for (std::size_t k = particles.size() - 1; k > 0; --k)
    std::swap(particles[k].id, particles[random.below(k + 1)].id);
}

// Where the particles of a new gas are.
std::vector<Vector> initial_positions(std::uint32_t count, const Box& box, std::uint64_t seed) {
  if (box.d == 2) {
    const Triangular lattice = triangular(count, box);
    if (lattice.distance >= 1) return triangular_positions(count, lattice);
  } else if (lattice_fits(count, box)) {
    return lattice_positions(count, box);
  }
  return grown_positions(count, box, seed);
}

}  // namespace

State initial_state(double n, std::uint32_t count, std::uint64_t seed, int d,
                    const std::map<std::string, Parameters>& effects) {
  const Box box(d == 2 ? std::sqrt(count / n) : cube_root(count / n), d);
  const std::vector<Vector> positions = initial_positions(count, box, seed);
  std::vector<Particle> particles(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    particles[k].position = positions[k];
    particles[k].id = k;
  }
  const auto asked = effects.find("mixture");
  if (asked == effects.end()) {
    draw_velocities(particles, seed, d, EqualMasses{});
    sort_in_space(particles, box);
    return to_state(particles, Clock{}, box);
  }
  const Mixture mixture = mixture_of(asked->second, count);
  mix(particles, seed);
  draw_velocities(particles, seed, d, MixedMasses{mixture});
  sort_in_space(particles, box);
  State state = to_state(particles, Clock{}, box);
  note(mixture, state);
  return state;
}

State restarted(const State& state) {
  const Box box(state);
  std::vector<Particle> particles(state.id.size());
  copy_particles(state, particles);
  const auto mixture = mixture_in(state);
  if (!mixture) {
    set_energy(particles, 1, EqualMasses{});
    return to_state(particles, Clock{}, box);
  }
  set_energy(particles, 1, MixedMasses{*mixture});
  State start = to_state(particles, Clock{}, box);
  note(*mixture, start);
  return start;
}

}  // namespace haff::engine
