// For tests of Evolution: a population that finds what its weights say, and a cell that grants each wish.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "units/vision/evolution.hpp"

namespace flexrf::user {

inline std::array<GeneRange, gene_count> ranges_of_tests() {
  std::array<GeneRange, gene_count> all;
  all.fill({-1, 1, false});
  all[gene_spacing] = {0.3, 1.0, false};
  all[gene_smallest] = {16, 48, false};
  all[gene_selectivity] = {0, 1, false};
  all[gene_regions] = {1, 8, true};
  return all;
}

inline Genes ordinary() {
  Genes genes{};
  genes[gene_spacing] = 0.5;
  genes[gene_smallest] = 24;
  genes[gene_selectivity] = 0.3;
  genes[gene_regions] = 4;
  return genes;
}

/// A population whose members find as much as their weight of colour says, and a cell that grants each wish.
struct EvolutionWorld {
  Evolution evolution;
  EvolutionRules rules;
  std::vector<Wish> granted;
  std::vector<double> fitness_of_retired;
  struct Birth {
    Genes child;
    Genes parent;
  };
  std::vector<Birth> births;
  std::uint64_t frame = 0;
  bool may_change = true;
  bool judges = true;
  bool spares_the_best = true;
  double dearest = 0;

  explicit EvolutionWorld(std::uint64_t seed = 7) {
    evolution.begin(seed, ranges_of_tests());
    rules.generation_frames = rules.probation_frames = 60;
    rules.probation_floor = 0.5;
  }
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
        births.push_back({wish.genes, evolution.member(wish.parent).genes});
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
          other.standing() >= evolution.member(member).standing())
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

inline std::unique_ptr<EvolutionWorld> eight_members(std::uint64_t seed = 7) {
  auto world = std::make_unique<EvolutionWorld>(seed);
  for (std::size_t i = 0; i < 8; ++i) world->add(i, 0.1 * static_cast<double>(i) - 0.2);
  return world;
}

}  // namespace flexrf::user
