// Whether evolution is worth its cost: perception alone, before a hand that goes over a table on a scripted
// path for five minutes, in other light from 100 s on. Four arms see the same pictures; what they are judged
// by is what there truly was to be seen, which none of them learns. No clock decides: the same seeds give the
// same numbers, whatever else the machine does.
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "attention_evolution_unit.hpp"
#include "base/text_table.hpp"
#include "benchmarks/evolution/arms.hpp"
#include "benchmarks/harness.hpp"

namespace flexrf::bench {
namespace {

// Weights, rules and path were tuned on seeds below 100.
constexpr std::uint64_t first_seed = 1001;
constexpr std::size_t seeds_in_all = 20;
// Of every so many one run has an arm more, as that takes longest.
constexpr std::size_t from_random_every = 4;

struct Outcome {
  Tally hand_tuned;
  Tally random;
  Tally mutation;
  Tally evolution;
  Tally from_random;  ///< evolution that began with the random members; cost 0: was not run
};

/// As attention_evolution's table has them, but what counts is what the arms are judged by: an obstacle is
/// worth as much as a part.
user::EvolutionRules rules_of_table() {
  const user::AttentionEvolutionRuntime of;
  user::EvolutionRules rules;
  rules.generation_frames = of.generation_frames;
  rules.probation_frames = of.probation_frames;
  rules.probation_floor = of.probation_floor;
  rules.wanted = usual_members;
  rules.cost_cap = of.cost_cap;
  rules.mutation = of.mutation;
  rules.tournament = of.tournament;
  rules.memory = of.memory;
  rules.obstacle_worth = 1;
  rules.least_overlap = of.least_overlap;
  return rules;
}

Outcome run(std::uint64_t seed, bool is_from_random) {
  const auto view = std::make_unique<SharedView>();
  view->begin(seed);
  user::RandomSource random(seed);
  std::array<user::Genes, usual_members> any{};
  for (user::Genes& genes : any) genes = any_genes(random);
  std::array<user::Genes, usual_members> tuned{};
  tuned.fill(genes_of_table());

  // All members of the hand-tuned arm would do the same: one stands for them.
  const auto hand_tuned = std::make_unique<FrozenArm>(*view, std::span(tuned).first(1));
  const auto frozen = std::make_unique<FrozenArm>(*view, any);
  const auto mutation = std::make_unique<ChangingArm>(*view, tuned, rules_of_table(), Judge::coin, seed);
  const auto evolution =
      std::make_unique<ChangingArm>(*view, tuned, rules_of_table(), Judge::recogniser, seed);
  std::unique_ptr<ChangingArm> from_random;
  if (is_from_random)
    from_random = std::make_unique<ChangingArm>(*view, any, rules_of_table(), Judge::recogniser, seed);

  Outcome outcome;
  Time now{std::chrono::seconds(1)};
  for (std::uint64_t picture = 1; picture <= pictures_of_a_run; ++picture) {
    now += picture_period;
    view->next(now);
    const bool is_judged = picture >= judged_from;
    evolution->step(picture, is_judged);
    mutation->step(picture, is_judged);
    if (from_random) from_random->step(picture, is_judged);
    if (!is_judged) continue;
    hand_tuned->look();
    frozen->look();
    hand_tuned->population().judge(view->seen(), outcome.hand_tuned);
    frozen->population().judge(view->seen(), outcome.random);
    mutation->population().judge(view->seen(), outcome.mutation);
    evolution->population().judge(view->seen(), outcome.evolution);
    if (from_random) from_random->population().judge(view->seen(), outcome.from_random);
  }
  return outcome;
}

std::vector<Outcome> run_all(std::size_t seeds) {
  std::vector<Outcome> outcomes(seeds);
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back([&] {
      for (std::size_t at = next++; at < seeds; at = next++)
        outcomes[at] = run(first_seed + at, (at + 1) % from_random_every == 0);
    });
  threads.clear();  // waits for them
  return outcomes;
}

/// Of Student's distribution, two-sided, for 1 to 19 degrees of freedom.
double quantile_of_student(std::size_t degrees) {
  constexpr std::array<double, 19> quantiles{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365,
                                             2.306,  2.262, 2.228, 2.201, 2.179, 2.160, 2.145,
                                             2.131,  2.120, 2.110, 2.101, 2.093};
  return quantiles[std::min(degrees, quantiles.size()) - 1];
}

/// Geometric mean of paired ratios with its 95 % interval, from their logarithms.
Estimate geometric_mean(const std::vector<double>& ratios) {
  const auto count = static_cast<double>(ratios.size());
  double sum = 0;
  for (const double ratio : ratios) sum += std::log(ratio);
  const double mean = sum / count;
  double squares = 0;
  for (const double ratio : ratios) squares += std::pow(std::log(ratio) - mean, 2);
  if (ratios.size() < 2) return {std::exp(mean), std::exp(mean), std::exp(mean)};
  const double half = quantile_of_student(ratios.size() - 1) * std::sqrt(squares / (count - 1) / count);
  return {std::exp(mean), std::exp(mean - half), std::exp(mean + half)};
}

/// One row for the mean, one for the interval's lower end: both have goals.
void add_judged(Report& report, const std::string& what, const std::vector<double>& ratios, double goal,
                double least) {
  const Estimate mean = geometric_mean(ratios);
  const std::string note =
      text("geometric mean of %zu; 95 %% interval %.3f - %.3f", ratios.size(), mean.low, mean.high);
  Row row{what, "", {mean.median, mean.median, mean.median}, goal, true, note};
  row.at_least = true;
  report.add(row);
  Row lower{what + ", lower end of the interval", "", {mean.low, mean.low, mean.low}, least, true, ""};
  lower.at_least = true;
  report.add(lower);
}

void add_shown(Report& report, const std::string& what, const std::vector<double>& ratios) {
  if (ratios.empty()) return;
  report.add({what, "", geometric_mean(ratios), 0, false, text("geometric mean of %zu", ratios.size())});
}

int measure(int argument_count, char** arguments) {
  Report report("evolution", argument_count, arguments);
  const std::vector<Outcome> outcomes = run_all(report.choose<std::size_t>(seeds_in_all, 2));

  std::vector<double> to_random, to_hand, recall, mutation_to_random, mutation_to_hand, hand_to_random,
      other_to_random, other_to_hand;
  TextTable table{{"seed", "hand-tuned", "random", "mutation", "evolution", "evolution / random",
                   "evolution / hand-tuned", "recall: hand-tuned", "random", "mutation", "evolution",
                   "from random"}};
  std::uint64_t seed = first_seed;
  for (const Outcome& one : outcomes) {
    to_random.push_back(one.evolution.per_cost() / one.random.per_cost());
    to_hand.push_back(one.evolution.per_cost() / one.hand_tuned.per_cost());
    recall.push_back(one.evolution.recall() / one.hand_tuned.recall());
    mutation_to_random.push_back(one.mutation.per_cost() / one.random.per_cost());
    mutation_to_hand.push_back(one.mutation.per_cost() / one.hand_tuned.per_cost());
    hand_to_random.push_back(one.hand_tuned.per_cost() / one.random.per_cost());
    const bool has_other = one.from_random.cost > 0;
    if (has_other) {
      other_to_random.push_back(one.from_random.per_cost() / one.random.per_cost());
      other_to_hand.push_back(one.from_random.per_cost() / one.hand_tuned.per_cost());
    }
    table.add({text("%llu", static_cast<unsigned long long>(seed++)), text("%.1f", one.hand_tuned.per_cost()),
               text("%.1f", one.random.per_cost()), text("%.1f", one.mutation.per_cost()),
               text("%.1f", one.evolution.per_cost()), text("%.2f", to_random.back()),
               text("%.3f", to_hand.back()), text("%.2f", one.hand_tuned.recall()),
               text("%.2f", one.random.recall()), text("%.2f", one.mutation.recall()),
               text("%.2f", one.evolution.recall()),
               has_other ? text("%.1f", one.from_random.per_cost()) : std::string()});
  }
  std::printf("distinct objects for a million values of declared cost, from 160 s on:\n%s",
              table.text("  ").c_str());
  add_judged(report, "evolution against random frozen", to_random, 1.5, 1.2);
  add_judged(report, "evolution against hand-tuned", to_hand, 1.0, 0.9);
  Row kept{"evolution's recall against hand-tuned's", "", geometric_mean(recall), 0.9, true, ""};
  kept.value.low = kept.value.high = kept.value.median;
  kept.at_least = true;
  report.add(kept);
  add_shown(report, "hand-tuned against random frozen", hand_to_random);
  add_shown(report, "mutation without selection against random frozen", mutation_to_random);
  add_shown(report, "mutation without selection against hand-tuned", mutation_to_hand);
  add_shown(report, "evolution begun with the random members against random frozen", other_to_random);
  add_shown(report, "evolution begun with the random members against hand-tuned", other_to_hand);
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::measure(argument_count, arguments);
}
