// Tables changed at random: config-gen answers each with messages of bounded number, and neither crashes nor
// hangs.
//
//   config_gen_mutation_test [COUNT [FIRST]]    default: 1500 0; the same numbers make the same changes
#include <iostream>

#include "config-gen/tests/mutation_judge.hpp"
#include "config-gen/tests/numbered.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

Numbers numbers{0, 1500};

std::size_t wrong_answers() {
  const TableTree tree(place::repository);
  watch_for_crashes();  // here, for cmocka has handlers of its own while a test runs
  std::size_t wrong = 0, accepted = 0;
  constexpr std::size_t most_shown = 20;
  for (std::uint64_t number = numbers.first; number < numbers.first + numbers.count; ++number) {
    Dice dice(~number);
    // The large applications are half of it: the small cells are many.
    const std::size_t large = 6;
    const Cell& cell = tree.cells()[dice.one_in(2) ? dice.below(large) : dice.below(tree.cells().size())];
    const Mutation mutation(tree, cell, number, [](const std::filesystem::path&) { return true; });
    watch(number, mutation.description());
    const Judgement judgement = judge(cell);
    if (judgement.accepted) ++accepted;
    if (judgement.wrong.empty()) continue;
    if (++wrong <= most_shown)
      std::cerr << "mutation " << number << " of " << cell.table.string() << ": " << judgement.wrong << '\n'
                << mutation.description();
  }
  std::cout << numbers.count << " mutations, " << accepted << " accepted, " << wrong << " answered wrongly\n";
  return wrong;
}

void mutated_tables_are_answered(void**) {
  assert_int_equal(wrong_answers(), 0);
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen::tests;
  numbers.take(argument_count, arguments);
  const CMUnitTest tests[] = {cmocka_unit_test(mutated_tables_are_answered)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
