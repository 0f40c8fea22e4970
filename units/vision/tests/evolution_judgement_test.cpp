// What Evolution makes of verdicts: what counts for a member, and what against it.
#include <cmath>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/vision/evolution.hpp"
#include "units/vision/tests/evolution_world.hpp"

namespace flexrf::evolution_judgement_test {
namespace {

using namespace flexrf::user;

bool what_nobody_took_counts_neither_way() {
  const auto world = eight_members();
  world->run(50);
  const double before = world->evolution.member(6).fitness();
  const std::uint32_t frames = world->evolution.member(6).frames;
  world->judges = false;
  world->rules.generation_frames = 100000;
  world->run(50);
  return world->evolution.member(6).fitness() == before && world->evolution.member(6).frames == frames;
}

bool one_object_counts_once_a_picture() {
  const auto world = std::make_unique<EvolutionWorld>();
  world->add(0, 0);
  Evolution& evolution = world->evolution;
  evolution.note_picture(0, 0, 1, 100);
  for (int i = 0; i < 3; ++i) {
    evolution.note_judged(0, 0, 1, 0);
    evolution.note_sighting(0, 0, 1, {{0.4 + 0.002 * i, 0.1}, true}, world->rules);
  }
  const bool once = evolution.member(0).objects == 1;
  evolution.note_sighting(0, 0, 1, {{0.5, 0.1}, true}, world->rules);
  evolution.note_sighting(0, 0, 1, {{0.5, 0.2}, false}, world->rules);
  const bool others = std::abs(evolution.member(0).objects - 2.25) < 1e-12;
  // Of a picture that is not known, of one that was there before, and of more than there can be.
  evolution.note_sighting(0, 0, 2, {{0.1, 0.1}, true}, world->rules);
  evolution.note_sighting(0, 5, 1, {{0.1, 0.1}, true}, world->rules);
  for (int i = 0; i < 100; ++i) evolution.note_sighting(0, 0, 1, {{0.1 * i, 3}, true}, world->rules);
  return once && others && evolution.member(0).objects <= most_regions && evolution.member(0).frames == 1;
}

/// A region of 60 x 60 pixels at (100, 100), and a thing of this size in its middle.
VisionVerdict verdict_on(int width, int height, double x) {
  VisionVerdict verdict{};
  verdict.region.frame = 1;
  verdict.region.left = verdict.region.top = 100;
  verdict.region.width = verdict.region.height = 60;
  verdict.verdict = VisualClass::target;
  verdict.position = {x, 0};
  verdict.left = static_cast<std::uint16_t>(130 - width / 2);
  verdict.top = static_cast<std::uint16_t>(130 - height / 2);
  verdict.width = static_cast<std::uint16_t>(width);
  verdict.height = static_cast<std::uint16_t>(height);
  verdict.parts = 1;
  return verdict;
}

/// Objects that one verdict brings to a member.
double objects_by(const VisionVerdict& verdict) {
  const auto world = std::make_unique<EvolutionWorld>();
  world->add(0, 0);
  world->evolution.note_picture(0, 0, 1, 100);
  world->evolution.note_verdict(verdict, world->rules);
  return world->evolution.member(0).objects;
}

bool a_region_holds_what_it_fits() {
  VisionVerdict obstacle = verdict_on(60, 60, 0);
  obstacle.verdict = VisualClass::obstacle;
  VisionVerdict nothing = verdict_on(60, 60, 0);
  nothing.verdict = VisualClass::nothing;
  // Intersection over union: 0.56, 0.44, 0.59, 0.40.
  return objects_by(verdict_on(60, 60, 0)) == 1 && objects_by(verdict_on(44, 46, 0)) == 1 &&
         objects_by(verdict_on(40, 40, 0)) == 0 && objects_by(verdict_on(78, 78, 0)) == 1 &&
         objects_by(verdict_on(96, 94, 0)) == 0 && objects_by(obstacle) == 0.25 && objects_by(nothing) == 0 &&
         objects_by(VisionVerdict{}) == 0;
}

/// Whether it was measured or known already, and however many things were in it.
bool a_region_costs_its_pixels() {
  const auto world = std::make_unique<EvolutionWorld>();
  world->add(0, 0);
  world->evolution.note_picture(0, 0, 1, 100);
  VisionVerdict first = verdict_on(60, 60, 0);
  first.pixels = 8100;
  first.parts = 2;
  VisionVerdict second = verdict_on(60, 60, 0.1);
  second.part = 1;
  second.parts = 2;
  VisionVerdict known = verdict_on(60, 60, 0);
  known.repeated = true;
  for (const VisionVerdict& verdict : {first, second, known})
    world->evolution.note_verdict(verdict, world->rules);
  VisionVerdict of_nobody = first;
  of_nobody.region.member = no_member;
  world->evolution.note_verdict(of_nobody, world->rules);
  return world->evolution.member(0).objects == 2 &&
         world->evolution.member(0).cost == values_of_features + 100 + 2 * (values_per_region + 3600);
}

/// Two find the same, but one of them was there only while there was much to be found.
bool members_are_compared_in_the_same_pictures() {
  const auto world = std::make_unique<EvolutionWorld>();
  Evolution& evolution = world->evolution;
  world->rules.generation_frames = 100000;
  for (std::size_t member = 0; member < 2; ++member) world->add(member, 0);
  for (std::uint64_t frame = 1; frame <= 100; ++frame) {
    const std::size_t there = frame < 50 ? 1 : 4;
    for (std::size_t member = 0; member < (frame < 50 ? 1U : 2U); ++member) {
      evolution.note_picture(member, 0, frame, 0);
      evolution.note_judged(member, 0, frame, 0);
      for (std::size_t i = 0; i < there; ++i)
        evolution.note_sighting(member, 0, frame, {{0.1 * static_cast<double>(i), 0}, true}, world->rules);
    }
    evolution.next_picture(world->rules, false);
  }
  const Evolution::Member& early = evolution.member(0);
  const Evolution::Member& late = evolution.member(1);
  return late.fitness() > 1.3 * early.fitness() && std::abs(late.standing() - 1) < 1e-9 &&
         std::abs(early.standing() - 1) < 1e-9;
}

/// Verdicts that come some pictures late count all the same, in the picture that they are of.
bool late_verdicts_count() {
  const auto world = std::make_unique<EvolutionWorld>();
  Evolution& evolution = world->evolution;
  for (std::size_t member = 0; member < 2; ++member) world->add(member, 0);
  for (std::uint64_t frame = 1; frame <= 30; ++frame) {
    for (std::size_t member = 0; member < 2; ++member) evolution.note_picture(member, 0, frame, 0);
    for (std::size_t member = 0; frame > 3 && member < 2; ++member) {
      evolution.note_judged(member, 0, frame - 3, 0);
      if (member == 1) evolution.note_sighting(member, 0, frame - 3, {{0, 0}, true}, world->rules);
    }
    evolution.next_picture(world->rules, false);
  }
  return evolution.member(0).standing() == 0 && std::abs(evolution.member(1).standing() - 2) < 1e-9;
}

/// As when a person has retired all others.
bool without_trusted_members_children_are_compared_with_each_other() {
  const auto world = std::make_unique<EvolutionWorld>();
  for (std::size_t member = 0; member < 3; ++member) {
    Genes genes = ordinary();
    genes[gene_colour] = 0.5;
    world->evolution.note_member(member, true, 5 + static_cast<std::uint32_t>(member), true, genes);
  }
  world->run(80);
  return world->count(WishKind::trust) == 3;
}

bool a_new_member_in_an_old_place_begins_anew() {
  const auto world = eight_members();
  world->run(50);
  world->evolution.note_member(6, false, 0, false, {});
  world->evolution.note_member(6, true, 30, true, ordinary());
  world->evolution.note_judged(6, 0, world->frame, 100);  // late, of the one before
  return world->evolution.member(6).frames == 0 && world->evolution.member(6).cost == 0 &&
         world->evolution.new_identity() == 31;
}

void judgement(void**) {
  assert_true(what_nobody_took_counts_neither_way());
  assert_true(one_object_counts_once_a_picture());
  assert_true(a_region_holds_what_it_fits());
  assert_true(a_region_costs_its_pixels());
}
void standing(void**) {
  assert_true(members_are_compared_in_the_same_pictures());
  assert_true(late_verdicts_count());
  assert_true(without_trusted_members_children_are_compared_with_each_other());
}
void places(void**) {
  assert_true(a_new_member_in_an_old_place_begins_anew());
}
}  // namespace
}  // namespace flexrf::evolution_judgement_test

int main() {
  using namespace flexrf::evolution_judgement_test;
  const CMUnitTest tests[] = {cmocka_unit_test(judgement), cmocka_unit_test(standing),
                              cmocka_unit_test(places)};
  return cmocka_run_group_tests_name("judgement of evolution", tests, nullptr, nullptr);
}
