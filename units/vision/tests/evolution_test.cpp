#include "units/vision/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::user;

std::array<GeneRange, gene_count> ranges() {
  std::array<GeneRange, gene_count> all;
  all.fill({-1, 1, false});
  all[gene_spacing] = {0.3, 1.0, false};
  all[gene_smallest] = {16, 48, false};
  all[gene_selectivity] = {0, 1, false};
  all[gene_regions] = {1, 8, true};
  return all;
}

Genes ordinary() {
  Genes genes{};
  genes[gene_spacing] = 0.5;
  genes[gene_smallest] = 24;
  genes[gene_selectivity] = 0.3;
  genes[gene_regions] = 4;
  return genes;
}

/// A population whose members find as much as their weight of colour says, and a cell that grants each wish.
struct World {
  Evolution evolution;
  EvolutionRules rules;
  std::vector<Wish> granted;
  std::vector<double> fitness_of_retired;
  std::uint64_t frame = 0;
  bool may_change = true;
  bool judges = true;
  bool spares_the_best = true;
  double dearest = 0;

  explicit World(std::uint64_t seed = 7) { evolution.begin(seed, ranges()); }
  void add(std::size_t member, double colour) {
    Genes genes = ordinary();
    genes[gene_colour] = colour;
    evolution.note_member(member, true, 0, false, genes);
  }
  static std::size_t objects_found(const Genes& genes) {
    return static_cast<std::size_t>(std::lround(4 * std::max(genes[gene_colour], 0.0)));
  }
  void judge(std::size_t member) {
    const Evolution::Member& one = evolution.member(member);
    evolution.note_picture(member, one.identity, frame, 20000);
    if (!judges) return;
    const std::size_t found = objects_found(one.genes);
    for (std::size_t region = 0; region < 4; ++region) {
      // The first two of the first ones are a little cheaper than their children.
      evolution.note_judged(member, one.identity, frame, one.identity == 0 && member < 2 ? 4000 : 5000);
      if (region < found)
        evolution.note_sighting(member, one.identity, frame, {{0.1 * static_cast<double>(region), 0}, true},
                                rules);
    }
  }
  void grant(const Wish& wish) {
    if (wish.kind == WishKind::none) return;
    const Evolution::Member one = evolution.member(wish.member);
    switch (wish.kind) {
      case WishKind::retire:
        fitness_of_retired.push_back(one.fitness());
        check_spared(wish.member);
        evolution.note_member(wish.member, false, one.identity, false, {});
        break;
      case WishKind::clone:
        evolution.note_birth(wish);
        break;
      case WishKind::trust:
        evolution.note_member(wish.member, true, one.identity, false, one.genes);
        break;
      case WishKind::none:
        break;
    }
    granted.push_back(wish);
  }
  /// At least two trusted members are better than, or as good as, one that goes.
  void check_spared(std::size_t member) {
    if (evolution.member(member).probation) return;
    int better = 0;
    for (std::size_t i = 0; i < most_members; ++i) {
      const Evolution::Member& other = evolution.member(i);
      if (i != member && other.active && !other.probation &&
          other.fitness() >= evolution.member(member).fitness())
        ++better;
    }
    spares_the_best = spares_the_best && better >= 2;
  }
  void run(int pictures) {
    for (int i = 0; i < pictures; ++i) {
      ++frame;
      for (std::size_t member = 0; member < most_members; ++member)
        if (evolution.member(member).active) judge(member);
      grant(evolution.next_picture(rules, may_change));
      dearest = std::max(dearest, evolution.declared_cost_of_all());
    }
  }
  std::size_t count(WishKind kind) const {
    return static_cast<std::size_t>(std::count_if(granted.begin(), granted.end(),
                                                  [kind](const Wish& wish) { return wish.kind == kind; }));
  }
  double mean_colour() const {
    double sum = 0;
    double members = 0;
    for (std::size_t i = 0; i < most_members; ++i) {
      if (!evolution.member(i).active || evolution.member(i).probation) continue;
      sum += evolution.member(i).genes[gene_colour];
      ++members;
    }
    return sum / members;
  }
};

std::unique_ptr<World> eight_members(std::uint64_t seed = 7) {
  auto world = std::make_unique<World>(seed);
  for (std::size_t i = 0; i < 8; ++i) world->add(i, 0.1 * static_cast<double>(i) - 0.2);
  return world;
}

bool the_better_survive() {
  const auto world = eight_members();
  const double before = world->mean_colour();
  world->run(60 * 80);
  return world->mean_colour() > before + 0.4 && world->spares_the_best && world->count(WishKind::retire) > 10;
}

bool the_two_best_stay() {
  const auto world = std::make_unique<World>();
  world->rules.mutation = 0;
  world->rules.wanted = 4;
  for (std::size_t i = 0; i < 4; ++i) world->add(i, i < 2 ? 1.0 : 0.3);
  world->run(60 * 40);
  return world->evolution.member(0).active && world->evolution.member(0).identity == 0 &&
         world->evolution.member(1).active && world->evolution.member(1).identity == 0 &&
         world->spares_the_best && world->count(WishKind::retire) > 0;
}

bool all_together_cost_no_more_than_allowed() {
  const auto world = eight_members();
  world->rules.wanted = 16;
  world->rules.cost_cap = 1.25 * world->evolution.declared_cost_of_all();
  world->run(60 * 100);
  return world->dearest <= world->rules.cost_cap && world->evolution.held_back() > 0 &&
         world->count(WishKind::clone) > 0;
}

/// A person made them dearer: the worst go until they are not.
bool a_cap_that_is_lowered_is_kept_to() {
  const auto world = eight_members();
  world->run(120);
  world->rules.cost_cap = 0.5 * world->evolution.declared_cost_of_all();
  world->run(60 * 20);
  return world->evolution.declared_cost_of_all() <= world->rules.cost_cap;
}

bool the_target_in_hand_protects_its_member() {
  const auto world = eight_members();
  world->evolution.note_target_in_hand(0, true);  // the worst of all
  world->run(60 * 60);
  return world->evolution.member(0).active && world->evolution.member(0).identity == 0 &&
         world->count(WishKind::retire) > 0 &&
         std::none_of(world->granted.begin(), world->granted.end(),
                      [](const Wish& wish) { return wish.member == 0; });
}

bool frozen_nothing_happens() {
  const auto world = eight_members();
  world->may_change = false;
  world->run(60 * 30);
  const bool still = world->granted.empty() && world->evolution.generation() == 30;
  world->may_change = true;
  world->run(60 * 3);
  return still && !world->granted.empty();
}

/// Of a child; it is trusted after 60 pictures and not before, or goes after 120.
bool probation_is_passed_or_not(double colour, WishKind expected, std::uint32_t least, std::uint32_t most) {
  const auto world = eight_members();
  world->rules.generation_frames = 100000;
  world->run(10);
  Wish birth;
  birth.kind = WishKind::clone;
  birth.member = 9;
  birth.parent = 7;
  birth.identity = world->evolution.new_identity();
  birth.genes = ordinary();
  birth.genes[gene_colour] = colour;
  world->grant(birth);
  const std::uint64_t born = world->frame;
  const bool is_new = world->evolution.member(9).probation && world->evolution.member(9).parent == 0;
  for (int i = 0; i < 300 && world->granted.size() < 2; ++i) world->run(1);
  if (!is_new || world->granted.size() < 2) return false;
  const Wish wish = world->granted[1];
  const std::uint64_t age = world->frame - born;
  return wish.kind == expected && wish.member == 9 && age >= least && age <= most;
}

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
  const auto world = std::make_unique<World>();
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

bool a_new_member_in_an_old_place_begins_anew() {
  const auto world = eight_members();
  world->run(50);
  world->evolution.note_member(6, false, 0, false, {});
  world->evolution.note_member(6, true, 30, true, ordinary());
  world->evolution.note_judged(6, 0, world->frame, 100);  // late, of the one before
  return world->evolution.member(6).frames == 0 && world->evolution.member(6).cost == 0 &&
         world->evolution.new_identity() == 31;
}

bool genes_stay_in_their_ranges_and_whole() {
  const auto world = eight_members();
  world->rules.mutation = 1;
  world->run(60 * 60);
  const auto all = ranges();
  for (const Wish& wish : world->granted) {
    if (wish.kind != WishKind::clone) continue;
    for (std::size_t i = 0; i < gene_count; ++i)
      if (!(wish.genes[i] >= all[i].lowest && wish.genes[i] <= all[i].highest)) return false;
    if (wish.genes[gene_regions] != std::round(wish.genes[gene_regions])) return false;
  }
  return world->count(WishKind::clone) > 10;
}

bool same_seeds_same_generations(std::uint64_t one, std::uint64_t other, bool same) {
  const auto first = eight_members(one);
  const auto second = eight_members(other);
  first->run(60 * 30);
  second->run(60 * 30);
  bool equal = first->granted.size() == second->granted.size();
  for (std::size_t i = 0; equal && i < first->granted.size(); ++i)
    equal = first->granted[i].kind == second->granted[i].kind &&
            first->granted[i].genes == second->granted[i].genes;
  return equal == same;
}

void survival(void**) {
  assert_true(the_better_survive());
}
void the_best(void**) {
  assert_true(the_two_best_stay());
}
void cost(void**) {
  assert_true(all_together_cost_no_more_than_allowed());
  assert_true(a_cap_that_is_lowered_is_kept_to());
}
void in_hand(void**) {
  assert_true(the_target_in_hand_protects_its_member());
}
void freezing(void**) {
  assert_true(frozen_nothing_happens());
}
void probation(void**) {
  assert_true(probation_is_passed_or_not(0.5, WishKind::trust, 60, 61));
  assert_true(probation_is_passed_or_not(-0.5, WishKind::retire, 120, 121));
}
void judgement(void**) {
  assert_true(what_nobody_took_counts_neither_way());
  assert_true(one_object_counts_once_a_picture());
}
void places(void**) {
  assert_true(a_new_member_in_an_old_place_begins_anew());
}
void genes(void**) {
  assert_true(genes_stay_in_their_ranges_and_whole());
}
void seeds(void**) {
  assert_true(same_seeds_same_generations(3, 3, true));
  assert_true(same_seeds_same_generations(3, 4, false));
}
void windows(void**) {
  for (int smallest = 16; smallest <= 48; ++smallest)
    for (int spacing = 30; spacing <= 100; ++spacing)
      assert_true(window_count(window_grids(smallest, 0.01 * spacing)) <= most_windows);
  assert_int_equal(member_number("attention[13]"), 13);
  assert_int_equal(member_number("attention"), 0);
  assert_int_equal(member_number("left.attention[2].x"), 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(survival),  cmocka_unit_test(the_best), cmocka_unit_test(cost),
      cmocka_unit_test(in_hand),   cmocka_unit_test(freezing), cmocka_unit_test(probation),
      cmocka_unit_test(judgement), cmocka_unit_test(places),   cmocka_unit_test(genes),
      cmocka_unit_test(seeds),     cmocka_unit_test(windows)};
  return cmocka_run_group_tests_name("evolution", tests, nullptr, nullptr);
}
