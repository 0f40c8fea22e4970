// What it does in a running cell is in tests/vision_cell.
#include "units/attention_evolution/attention_evolution.hpp"

#include <cstring>
#include <memory>
#include <string>

#include "runtime/executive/cell.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

/// A cell of which nothing is known but its populations, and no report is connected.
struct World {
  UnitBench<AttentionEvolution> bench;
  PopulationRecord population{"attention", 0, 3, 2};
  Application application{};
  Options options;
  std::unique_ptr<Cell> cell;
  CellAccess::Post post;
  InputBinding inputs[4]{};
  SlotControl* outputs[1] = {nullptr};

  explicit World(bool has_population) {
    application.name = "test";
    if (has_population) application.populations = {&population, 1};
    cell = std::make_unique<Cell>(application, options);
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    bench.unit().set_name("evolution");
    bench.unit().cell_access()->connect(*cell, post);
  }
  /// What initialise() says; empty: it went well.
  std::string refusal() { return bench.unit().initialise().cause(); }
};

bool an_unknown_population_is_refused_by_name() {
  const auto world = std::make_unique<World>(false);
  const std::string refusal = world->refusal();
  return refusal.find("no population 'attention'") != std::string::npos &&
         refusal.find("configuration.population") != std::string::npos;
}

bool members_without_reports_are_refused() {
  const auto world = std::make_unique<World>(true);
  return world->refusal().find("3 members and 0 reports") != std::string::npos;
}

void unknown(void**) {
  assert_true(an_unknown_population_is_refused_by_name());
}
void unconnected(void**) {
  assert_true(members_without_reports_are_refused());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(unknown), cmocka_unit_test(unconnected)};
  return cmocka_run_group_tests_name("attention evolution", tests, nullptr, nullptr);
}
