// Of tables changed at random those that config-gen accepts make C++ that a compiler accepts, too: names of
// the runtime, of the standard library and of C++ among them, and texts that C++ takes for something else.
// Classes that an author writes are made up here, for their own text is not what is judged.
//
//   config_gen_mutation_compile_test [COUNT [FIRST]]    default: 40 0
#include <iostream>

#include "config-gen/tests/generated_compiler.hpp"
#include "config-gen/tests/mutation_judge.hpp"
#include "config-gen/tests/numbered.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

Numbers numbers{0, 40};

std::size_t wrong_sources() {
  const TableTree tree(place::repository);
  GeneratedCompiler compiler(tree, {place::compiler, place::repository, place::eigen});
  compiler.precompile();
  std::size_t compiled = 0, wrong = 0;
  constexpr std::size_t large = 6, most_shown = 10;
  for (std::uint64_t number = numbers.first; compiled < numbers.count; ++number) {
    Dice dice(~number);
    const Cell& cell = tree.cells()[dice.below(large)];
    const Mutation mutation(tree, cell, number,
                            [&](const std::filesystem::path& file) { return !is_own(tree, file); });
    if (mutation.empty()) continue;
    const Judgement judgement = judge(cell);
    if (!judgement.accepted) continue;
    ++compiled;
    if (compiler.accepts(judgement, cell)) continue;
    if (++wrong <= most_shown)
      std::cerr << "mutation " << number << " of " << cell.table.string()
                << " is accepted and does not compile:\n"
                << mutation.description() << compiler.messages().substr(0, 2000) << '\n';
  }
  std::cout << compiled << " accepted mutations compiled, " << wrong << " not accepted by the compiler\n";
  return wrong;
}

void what_is_accepted_compiles(void**) {
  assert_int_equal(wrong_sources(), 0);
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen::tests;
  numbers.take_campaign(200);
  numbers.take(argument_count, arguments);
  const CMUnitTest tests[] = {cmocka_unit_test(what_is_accepted_compiles)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
