#include "benchmarks/evolution/arms.hpp"

#include <cstdio>
#include <cstdlib>

#include "units/vision/tests/known_parts.hpp"

namespace flexrf::bench {

FrozenArm::FrozenArm(SharedView& view, std::span<const user::Genes> members) : population_(view, {}) {
  for (std::size_t i = 0; i < members.size(); ++i) population_.set(i, members[i]);
}

ChangingArm::ChangingArm(SharedView& view, std::span<const user::Genes> members,
                         const user::EvolutionRules& rules, Judge judge, std::uint64_t seed)
    : population_(view, judge == Judge::recogniser ? jobs_.sinks() : std::span<QueueSink* const>{}),
      rules_(rules),
      judge_(judge),
      coin_(seed) {
  for (std::size_t i = 0; i < members.size(); ++i) population_.set(i, members[i]);
  evolution_.begin(seed, declared_ranges());
  InputBinding inputs[4] = {view.frames(), view.features_of_recognition(), view.tool_poses(), {}};
  QueueSource* sources[2] = {nullptr, jobs_.source()};
  SlotControl* outputs[1] = {&verdicts_.control()};
  UnitBinding binding;
  binding.context = &recogniser_.context();
  binding.inputs = inputs;
  binding.queue_inputs = sources;
  binding.outputs = outputs;
  recogniser_.unit().connect(binding);
  recogniser_.unit().set_name("recognition");
  static_cast<user::RecognitionConfiguration*>(recogniser_.unit().parameter_memory().configuration)
      ->catalogue = user::catalogue_of_tests();
  if (recogniser_.unit().initialise().is_ok()) return;
  std::fprintf(stderr, "evolution: recognition was not initialised\n");
  std::exit(1);
}

void ChangingArm::step(std::uint64_t picture, bool is_judged) {
  if (is_judged || judge_ == Judge::recogniser) population_.look();
  tell_members(picture);
  if (judge_ == Judge::recogniser)
    recognise();
  else
    toss(picture);
  fulfil(evolution_.next_picture(rules_, true));
}

void ChangingArm::tell_members(std::uint64_t picture) {
  for (std::size_t i = 0; i < Population::most; ++i) {
    if (!population_.is_active(i)) continue;
    const user::AttentionReport& report = population_.report(i);
    evolution_.note_member(i, true, report.identity, report.probation, report.genes);
    evolution_.note_picture(i, report.identity, picture, judge_ == Judge::recogniser ? report.pixels : 0);
  }
}

/// Until no job is left: at ten pictures a second eight recognisers have the time for all.
void ChangingArm::recognise() {
  recogniser_.runtime().jobs = 8;  // of at most 4 verdicts each: as many as are kept
  for (std::uint64_t done = 0;;) {
    recogniser_.step(std::chrono::milliseconds(1));
    const auto list = verdicts_.latest();
    if (list)
      for (; read_ < list->count; ++read_)
        evolution_.note_verdict(list->verdicts[read_ % list->verdicts.size()], rules_);
    if (recogniser_.feedback().done == done) return;
    done = recogniser_.feedback().done;
  }
}

/// Each member has found up to eight targets at the same cost.
void ChangingArm::toss(std::uint64_t picture) {
  for (std::size_t i = 0; i < Population::most; ++i) {
    if (!population_.is_active(i)) continue;
    const std::uint32_t identity = population_.report(i).identity;
    evolution_.note_judged(i, identity, picture, 0);
    const std::size_t count = coin_.below(user::most_regions + 1);
    for (std::size_t k = 0; k < count; ++k)
      evolution_.note_sighting(i, identity, picture, {{static_cast<double>(k), 0}, true}, rules_);
  }
}

void ChangingArm::fulfil(const user::Wish& wish) {
  switch (wish.kind) {
    case user::WishKind::retire:
      population_.retire(wish.member);
      evolution_.note_member(wish.member, false, evolution_.member(wish.member).identity, false, {});
      break;
    case user::WishKind::clone:
      population_.set(wish.member, wish.genes, wish.identity, true);
      evolution_.note_birth(wish);
      break;
    case user::WishKind::trust:
      population_.set(wish.member, evolution_.member(wish.member).genes,
                      evolution_.member(wish.member).identity, false);
      break;
    case user::WishKind::none:
      break;
  }
}

}  // namespace flexrf::bench
