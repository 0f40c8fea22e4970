#include "runtime/realtime/machine_file.hpp"

#include <unistd.h>

#include <cstdlib>

#include "tests/cmocka.hpp"

namespace flexrf::machine_file_test {
namespace {

CpuSet cpus(const char* text) {
  return *CpuSet::parse(text);
}

void check_set(const CpuSet& set, const char* expected) {
  assert_string_equal(CpuText(set).text, expected);
}

void cpu_sets_are_read_and_written(void**) {
  check_set(cpus("0-2,5"), "0-2,5");
  check_set(cpus("3,1,2"), "1-3");
  check_set(cpus(" 0 , 7 \n"), "0,7");
  check_set(cpus(""), "");
  check_set(cpus("1023"), "1023");
  assert_true(cpus("\n").is_empty());
  assert_int_equal(cpus("4,9-11").count(), 4);
  assert_int_equal(cpus("4,9-11").lowest(), 4);
  assert_int_equal(cpus("4,9-11").highest(), 11);
  assert_int_equal(CpuSet().lowest(), -1);
  check_set(cpus("0-5").without(cpus("2-3")), "0-1,4-5");
  check_set(cpus("0-2").united_with(cpus("4")), "0-2,4");
  check_set(cpus("0-2").common_with(cpus("2-4")), "2");
  assert_true(cpus("1,2") == cpus("1-2"));
}

void broken_cpu_sets_are_refused(void**) {
  for (const char* const text : {"a", "1,", "1-", "2-1", "1024", "1;2", "-1", "99999999999"}) {
    const Result<CpuSet> set = CpuSet::parse(text);
    assert_false(static_cast<bool>(set));
    assert_int_equal(set.status().code(), StatusCode::invalid_argument);
  }
  assert_string_equal(CpuSet::parse("2-1").status().cause(),
                      "'2-1' is no list of CPUs such as 0-2,5: a range runs upwards");
}

struct Defaults {
  const char* allowed;
  const char* isolated;
  const char* control;
  const char* io;
  const char* any;
  const char* rest;
};

// [exec-38]
void default_roles(void**) {
  const Defaults cases[] = {
      {"0", "", "0", "0", "0", "0"},             // nothing to choose
      {"0-1", "", "1", "1", "1", "0"},           // everything else on 0, real time on 1
      {"0-3", "", "3", "2", "2-3", "0-1"},       // the last two
      {"0-7", "4-6", "6", "4", "4-6", "0-3,7"},  // what the kernel isolates
      {"0-3", "6", "3", "2", "2-3", "0-1"},      // isolated, but not ours
      {"2-3", "", "3", "3", "3", "2"},           // a process confined by its control group
  };
  for (const Defaults& expected : cases) {
    const MachineFile machine = MachineFile::by_default(cpus(expected.allowed), cpus(expected.isolated));
    check_set(machine.cpus_of(CpuRole::control), expected.control);
    check_set(machine.cpus_of(CpuRole::io), expected.io);
    check_set(machine.cpus_of(CpuRole::any), expected.any);
    check_set(machine.rest(machine.cpus_of(CpuRole::any)), expected.rest);
  }
}

// [exec-37]
void the_file_overrides_the_defaults(void**) {
  const auto machine = MachineFile::parse(
      "# roles of this cell's computer\n\ncontrol = 1\n  io=0   # beside the network card\n", "machine.conf",
      cpus("0-3"), {});
  assert_true(static_cast<bool>(machine));
  check_set(machine->cpus_of(CpuRole::control), "1");
  check_set(machine->cpus_of(CpuRole::io), "0");
  check_set(machine->cpus_of(CpuRole::any), "2-3");
  check_set(machine->rest(cpus("0-1")), "2-3");
  check_set(machine->rest(cpus("0-3")), "0-3");

  const auto quoted = MachineFile::parse("any = \"1-2\"\nrest = 0,3", "machine.conf", cpus("0-3"), {});
  assert_true(static_cast<bool>(quoted));
  check_set(quoted->cpus_of(CpuRole::any), "1-2");
  check_set(quoted->rest(cpus("0")), "0,3");
}

void broken_files_name_line_and_cause(void**) {
  const struct {
    const char* text;
    const char* cause;
  } cases[] = {
      {"control\n", "m:1: expected ROLE = CPUS, such as: control = 1"},
      {"io = 0\nvision = 1\n", "m:2: no role is called 'vision'; there are control, io, any and rest"},
      {"io = 0\n\nio = 1", "m:3: io was already given in line 1"},
      {"io = one", "m:1: 'one' is no list of CPUs such as 0-2,5: a number is expected"},
      {"io =  # none", "m:1: io needs at least one CPU"},
      {"io = 0-3", "m:1: CPU 2-3 is not there or not allowed to this process, which has 0-1"},
  };
  for (const auto& broken : cases) {
    const auto machine = MachineFile::parse(broken.text, "m", cpus("0-1"), {});
    assert_false(static_cast<bool>(machine));
    assert_string_equal(machine.status().cause(), broken.cause);
  }
}

void files_are_read(void**) {
  const auto absent = MachineFile::read("/nowhere/machine.conf", cpus("0"), {});
  assert_int_equal(absent.status().code(), StatusCode::not_found);
  assert_string_equal(absent.status().cause(),
                      "cannot read /nowhere/machine.conf: No such file or directory");
  assert_true(static_cast<bool>(MachineFile::of_this_machine("/nowhere/machine.conf")));

  char path[] = "/tmp/flexrf-machine-XXXXXX";
  const int file = mkstemp(path);
  assert_true(file >= 0);
  assert_int_equal(write(file, "control = 5\n", 12), 12);
  close(file);
  const auto machine = MachineFile::read(path, cpus("0-7"), {});
  const CpuSet isolated = isolated_cpus(path);  // not a list
  unlink(path);
  assert_true(static_cast<bool>(machine));
  check_set(machine->cpus_of(CpuRole::control), "5");
  assert_true(isolated.is_empty());
}

}  // namespace
}  // namespace flexrf::machine_file_test

int main() {
  using namespace flexrf::machine_file_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(cpu_sets_are_read_and_written),
      cmocka_unit_test(broken_cpu_sets_are_refused),
      cmocka_unit_test(default_roles),
      cmocka_unit_test(the_file_overrides_the_defaults),
      cmocka_unit_test(broken_files_name_line_and_cause),
      cmocka_unit_test(files_are_read),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
