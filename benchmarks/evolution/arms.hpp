// The four arms: the same pictures, and populations that differ in who decides about their members.
#pragma once

#include "benchmarks/evolution/population.hpp"
#include "units/recognition/recognition.hpp"

namespace flexrf::bench {

/// As large as the tables' population.
inline constexpr std::size_t usual_members = 8;

/// Members that stay as they are.
class FrozenArm {
 public:
  FrozenArm(SharedView& view, std::span<const user::Genes> members);
  void look() { population_.look(); }
  const Population& population() const noexcept { return population_; }

 private:
  Population population_;
};

/// Who says what a region held.
enum class Judge : std::uint8_t {
  recogniser,  ///< the unit, which takes the members' jobs
  coin,        ///< nobody: births and deaths are as many, and have no reason
};

/// Members that come and go as Evolution wishes. What is true it never learns.
class ChangingArm {
 public:
  ChangingArm(SharedView& view, std::span<const user::Genes> members, const user::EvolutionRules& rules,
              Judge judge, std::uint64_t seed);
  /// The view's newest picture. Where a coin judges nobody needs to look at pictures whose regions nobody
  /// asks for.
  void step(std::uint64_t picture, bool is_judged);
  const Population& population() const noexcept { return population_; }
  const user::Evolution& evolution() const noexcept { return evolution_; }

 private:
  void tell_members(std::uint64_t picture);
  void recognise();
  void toss(std::uint64_t picture);
  void fulfil(const user::Wish& wish);

  user::JobBench jobs_;
  Population population_;
  user::Evolution evolution_;
  user::EvolutionRules rules_;
  Judge judge_;
  user::RandomSource coin_;
  UnitBench<user::Recognition> recogniser_;
  SlotBench<user::VisionVerdicts> verdicts_;
  std::uint64_t read_ = 0;
};

}  // namespace flexrf::bench
