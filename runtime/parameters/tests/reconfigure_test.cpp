#include "runtime/parameters/reconfigure.hpp"

#include <cstdio>
#include <cstring>
#include <new>

#include "runtime/parameters/tests/sample_component.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::reconfigure_test {
namespace {

constexpr std::uint16_t count = 3;

// The executive, with a log of what it was asked and with failures to order. Owner 2 stands on 1 stands on 0.
class FakeHost : public ReconfigureHost {
 public:
  FakeHost() {
    components[0].set_name("bus");
    components[1].set_name("drive");
    components[2].set_name("axis");
  }
  Component* component(std::uint16_t index) override { return index < count ? &components[index] : nullptr; }
  bool is_initialised(std::uint16_t index) const override { return initialised[index]; }
  std::vector<std::uint16_t> owners_of(std::span<const std::uint16_t> changed) override {
    std::uint16_t lowest = count;
    for (const std::uint16_t index : changed) lowest = std::min(lowest, index);
    std::vector<std::uint16_t> owners;
    for (std::uint16_t index = count; index > lowest; --index)
      owners.push_back(static_cast<std::uint16_t>(index - 1));
    return owners;
  }
  Status stop(std::uint16_t owner) override {
    note("-", owner);
    if (owner == refuses_to_stop) return Status::error(StatusCode::timeout, "does not let go");
    initialised[owner] = false;
    return {};
  }
  Status initialise(std::uint16_t owner) override {
    note("+", owner);
    const double length = components[owner].configuration.length;
    if (length == refused_length)
      return Status::error(StatusCode::device_fault, "length %g does not fit", length);
    initialised[owner] = true;
    return {};
  }
  void fault(std::uint16_t owner, const Status& cause) override {
    note("!", owner);
    std::snprintf(fault_cause, sizeof(fault_cause), "%s", cause.cause());
  }

  sample::SampleComponent components[count];
  bool initialised[count] = {true, true, true};
  double refused_length = 0;
  std::uint16_t refuses_to_stop = count;
  char log[256] = {};
  char fault_cause[Status::cause_capacity] = {};

 private:
  void note(const char* act, std::uint16_t owner) {
    std::strcat(log, act);
    std::strcat(log, components[owner].name());
    std::strcat(log, " ");
  }
};

// Static, because a failing assertion jumps over destructors.
FakeHost* host;
ReconfigureResult result;
std::vector<ConfigurationChange> changes;

int begin(void**) {
  alignas(FakeHost) static std::byte memory[sizeof(FakeHost)];
  host = new (memory) FakeHost;
  result = {};
  changes.clear();
  return 0;
}

void change(std::uint16_t component, const char* parameter, const char* value) {
  changes.push_back({component, parameter, value});
}

void expect_cause(std::size_t index, const char* cause) {
  assert_true(index < result.causes.size());
  assert_string_equal(result.causes[index].c_str(), cause);
}

void all_owners_are_initialised_again_with_the_new_values(void**) {
  change(1, "length", "3");
  change(2, "rotation[1][2]", "0.5");
  change(2, "limits[1].high", "9");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::done);
  assert_int_equal(result.causes.size(), 0);
  assert_int_equal(result.owners.size(), 2);
  assert_string_equal(host->log, "-axis -drive +drive +axis ");
  assert_true(host->components[1].configuration.length == 3);
  assert_true(host->components[2].configuration.rotation[5] == 0.5);
  assert_true(host->components[2].configuration.limits[1].high == 9);
}

void a_change_that_does_not_fit_touches_nothing_and_all_are_named(void**) {
  change(0, "length", "3");
  change(1, "length", "30");
  change(2, "lenght", "3");
  change(2, "limits[2].low", "3");
  change(7, "length", "3");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::refused);
  assert_int_equal(result.causes.size(), 4);
  expect_cause(0, "drive: length: 30 m lies outside 0.1 to 10 m");
  expect_cause(1, "axis: no configuration parameter 'lenght'; did you mean 'length'?");
  expect_cause(2, "axis: index 2 of 'limits' lies outside 0 to 1");
  expect_cause(3, "there is no component number 7");
  assert_string_equal(host->log, "");
  assert_true(host->components[0].configuration.length == 2);
}

void what_changes_nothing_stops_nobody(void**) {
  change(1, "length", "2");
  change(1, "title", "home");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::done);
  assert_string_equal(host->log, "");
}

void an_owner_that_fails_rolls_all_back(void**) {
  host->refused_length = 5;
  change(0, "rows", "7");
  change(1, "length", "5");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::rolled_back);
  assert_int_equal(result.causes.size(), 1);
  expect_cause(0, "drive: initialise: length 5 does not fit");
  // The bus took the new values and must give them back; axis and drive only begin again.
  assert_string_equal(host->log, "-axis -drive -bus +bus +drive -bus +bus +drive +axis ");
  assert_int_equal(host->components[0].configuration.rows, 3);
  assert_true(host->components[1].configuration.length == 2);
  for (const bool initialised : host->initialised) assert_true(initialised);
}

void an_owner_that_does_not_take_the_old_values_is_in_fault_with_both_causes(void**) {
  host->components[1].configuration.length = 4;
  host->refused_length = 4;
  change(1, "length", "5");
  change(2, "length", "4");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::fault);
  expect_cause(0, "axis: initialise: length 4 does not fit");
  expect_cause(1, "drive: initialise with the old values: length 4 does not fit");
  assert_string_equal(host->log, "-axis -drive +drive +axis -drive +drive !drive +axis ");
  assert_string_equal(
      host->fault_cause,
      "drive: initialise with the old values: length 4 does not fit; before that, axis: initialise: "
      "length 4 does not fit");
  assert_true(host->components[1].configuration.length == 4);
  assert_true(host->components[2].configuration.length == 2);
  assert_true(host->initialised[2]);
}

void an_owner_that_does_not_stop_keeps_its_values(void**) {
  host->refuses_to_stop = 1;
  change(1, "length", "5");
  result = reconfigure(*host, changes);
  assert_int_equal(result.outcome, ReconfigureOutcome::fault);
  expect_cause(0, "drive: stop: does not let go");
  assert_string_equal(host->log, "-axis -drive !drive +axis ");
  assert_true(host->components[1].configuration.length == 2);
  assert_string_equal(host->fault_cause, "drive: stop: does not let go");
}

void a_plain_write_is_for_what_is_not_initialised(void**) {
  change(1, "length", "3");
  const Status refused = write_configuration(*host, changes[0]);
  assert_int_equal(refused.code(), StatusCode::not_permitted);
  assert_string_equal(
      refused.cause(),
      "'length' of drive is configuration, and drive is initialised: use reconfigure, which stops it "
      "and initialises it again");
  assert_true(host->components[1].configuration.length == 2);
  host->initialised[1] = false;
  assert_true(write_configuration(*host, changes[0]).is_ok());
  assert_true(host->components[1].configuration.length == 3);
  changes[0].value = "99";
  const Status out_of_range = write_configuration(*host, changes[0]);
  assert_string_equal(out_of_range.cause(), "drive: length: 99 m lies outside 0.1 to 10 m");
}

}  // namespace
}  // namespace flexrf::reconfigure_test

int main() {
  using namespace flexrf::reconfigure_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(all_owners_are_initialised_again_with_the_new_values, begin),
      cmocka_unit_test_setup(a_change_that_does_not_fit_touches_nothing_and_all_are_named, begin),
      cmocka_unit_test_setup(what_changes_nothing_stops_nobody, begin),
      cmocka_unit_test_setup(an_owner_that_fails_rolls_all_back, begin),
      cmocka_unit_test_setup(an_owner_that_does_not_take_the_old_values_is_in_fault_with_both_causes, begin),
      cmocka_unit_test_setup(an_owner_that_does_not_stop_keeps_its_values, begin),
      cmocka_unit_test_setup(a_plain_write_is_for_what_is_not_initialised, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
