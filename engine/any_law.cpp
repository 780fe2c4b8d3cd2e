#include "engine/any_law.hpp"

#include <utility>

#include "engine/laws.hpp"

namespace haff::engine {

template <class Law>
struct AnyLaw::Holder : Interface {
  explicit Holder(Law one) : law(std::move(one)) {}
  double restitution(const Impact& impact) const override { return law(impact); }
  void recall(const State& state) override { law.recall(state); }
  void store(State& state) const override { law.store(state); }
  void before_synchronization(std::span<const Particle> particles, double now) override {
    law.before_synchronization(particles, now);
  }
  void scale(int exponent) override { law.scale(exponent); }

  Law law;
};

AnyLaw::AnyLaw(const Model& model)
    : law_(with_law(model, []<class Law>(Law law) -> std::unique_ptr<Interface> {
        return std::make_unique<Holder<Law>>(std::move(law));
      })) {}

}  // namespace haff::engine
