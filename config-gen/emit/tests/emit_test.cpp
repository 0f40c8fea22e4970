// The same tables give the same bytes, wherever they lie; literals and identifiers are what C++ reads back.
#include "config-gen/emit/emit.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <string_view>

#include "config-gen/emit/text.hpp"
#include "config-gen/model/target.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

namespace fs = std::filesystem;
using namespace flexrf::config_gen;

std::vector<GeneratedFile> generate(const fs::path& root, Target::Kind kind, const fs::path& file) {
  const fs::path tests = root / "tests/generator";
  const SearchPaths paths{
      {tests / "cell/types"}, {tests / "cell/units"}, {tests / "interfaces"}, {tests / "drivers"}, {}};
  Diagnostics diagnostics;
  Model model = read({kind, tests / file}, paths, diagnostics);
  check(model, diagnostics);
  std::vector<GeneratedFile> files;
  if (!diagnostics.failed()) files = emit(model, {kind, tests / file}, diagnostics);
  if (diagnostics.failed()) diagnostics.print(std::cerr);
  return files;
}

struct Case {
  Target::Kind kind;
  const char* file;
  std::size_t files;
};
constexpr Case cases[] = {{Target::Kind::types, "cell/types", 16},
                          {Target::Kind::types, "cell/types/", 16},
                          {Target::Kind::unit, "cell/units/source/source.toml", 4},
                          {Target::Kind::unit, "cell/units/lift/lift.toml", 4},
                          {Target::Kind::interface, "interfaces/station/station.toml", 3},
                          {Target::Kind::driver, "drivers/mock_station/mock_station.toml", 4},
                          {Target::Kind::driver, "drivers/metering_station/metering_station.toml", 4},
                          {Target::Kind::driver, "drivers/model_mover/model_mover.toml", 4},
                          {Target::Kind::application, "ports_cell/ports_cell.toml", 9},
                          {Target::Kind::application, "cell/generated_cell.toml", 9}};

// What goes wrong in one case, so that no assertion jumps over the files' destructors.
std::string difference_between_places(const Case& one) {
  const fs::path elsewhere = fs::temp_directory_path() / "flexrf_emit_test" / std::to_string(::getpid());
  fs::create_directories(elsewhere / "tests");
  fs::copy(fs::path(place::source_folder) / "tests/generator", elsewhere / "tests/generator",
           fs::copy_options::recursive);
  const auto here = generate(place::source_folder, one.kind, one.file);
  const auto there = generate(elsewhere, one.kind, one.file);
  fs::remove_all(elsewhere);
  if (here.size() != one.files) return std::to_string(here.size()) + " files";
  if (there.size() != one.files) return std::to_string(there.size()) + " files elsewhere";
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i].path != there[i].path || here[i].contents != there[i].contents) return here[i].path.string();
    if (here[i].contents.find(place::source_folder) != std::string::npos)
      return "an absolute path in " + here[i].path.string();
    if (here[i].path.is_absolute()) return here[i].path.string() + " is absolute";
  }
  return "";
}

void same_tables_same_bytes(void**) {
  static std::string difference;
  for (const Case& one : cases) {
    difference = difference_between_places(one);
    assert_string_equal(difference.c_str(), "");
  }
}

std::uint64_t hash_of_application() {
  const fs::path tests = fs::path(place::source_folder) / "tests/generator";
  const SearchPaths paths{
      {tests / "cell/types"}, {tests / "cell/units"}, {tests / "interfaces"}, {tests / "drivers"}, {}};
  Diagnostics diagnostics;
  Model model = read({Target::Kind::application, tests / "cell/generated_cell.toml"}, paths, diagnostics);
  const std::uint64_t before = descriptor_text(model).hash;
  model.units.front().name += "x";
  return before == descriptor_text(model).hash ? 0 : before;
}

void the_hash_follows_the_contents(void**) {
  assert_int_not_equal(hash_of_application(), 0);
}

bool text_is(const std::string& text, const char* wanted) {
  if (text == wanted) return true;
  print_error("%s instead of %s\n", text.c_str(), wanted);
  return false;
}

void literals(void**) {
  assert_true(text_is(string_literal("a \"b\" \\ \n\x01"
                                     "7 \xC2\xB5"),
                      "\"a \\\"b\\\" \\\\ \\n\\0017 \xC2\xB5\""));
  // What C++ once took for a backslash, and compilers warn of.
  assert_true(text_is(string_literal("?\?/???"), R"("?\?/?\?\?")"));
  assert_true(text_is(comment_text("what?\?/ "), "what?\?/ ."));
  assert_true(text_is(double_literal(1), "1.0"));
  assert_true(text_is(double_literal(0.1), "0.1"));
  assert_true(text_is(double_literal(1e-9), "1e-09"));
  assert_true(text_is(double_literal(-0.0), "-0.0"));
  assert_true(text_is(double_literal(std::numeric_limits<double>::infinity()),
                      "std::numeric_limits<double>::infinity()"));
  assert_true(text_is(float_literal(0.1), "0.1F"));
  assert_true(text_is(integer_literal(-1, Scalar::u64), "18446744073709551615U"));
  assert_true(text_is(integer_literal(std::numeric_limits<std::int64_t>::min(), Scalar::i64),
                      "(-9223372036854775807 - 1)"));
  assert_true(text_is(duration_literal(7'000'000), "Duration{7'000'000}"));
  assert_true(text_is(duration_literal(0), "Duration{}"));
  assert_true(text_is(grouped(12), "12"));
  assert_true(text_is(hash_text(0xAB), "00000000000000ab"));
  // The published vector of FNV-1a, 64 bits.
  assert_true(text_is(hash_text(fnv1a("foobar")), "85944171f73967e8"));
}

void identifiers_differ_as_names_do(void**) {
  Identifiers identifiers;
  assert_true(text_is(identifiers.of("axis[2].drive"), "axis_2_drive"));
  assert_true(text_is(identifiers.of("axis_2_drive"), "axis_2_drive_x2"));
  assert_true(text_is(identifiers.of("axis[2].drive"), "axis_2_drive"));
  assert_true(text_is(identifiers.of("keys@jog.keys"), "keys_for_jog_keys"));
  // Would be taken for a part of `jog`.
  assert_true(text_is(identifiers.of("jog_inputs"), "jog_inputs_"));
}

void paths_do_not_say_where_the_repository_lies(void**) {
  assert_true(text_is(short_path("/home/me/flexrf/units/jog/jog.toml"), "units/jog/jog.toml"));
  assert_true(text_is(short_path("jog.toml"), "jog.toml"));
}

std::string file_of_driver(const char* driver, const char* file) {
  const fs::path table = fs::path("drivers") / driver / (std::string(driver) + ".toml");
  for (const GeneratedFile& one : generate(place::source_folder, Target::Kind::driver, table))
    if (one.path == file) return one.contents;
  return "no file";
}

bool has(const std::string& text, const char* part) {
  if (text.find(part) != std::string::npos) return true;
  print_error("'%s' is not in: %s\n", part, text.c_str());
  return false;
}

void ports_of_a_driver_are_members_of_its_base(void**) {
  static std::string text;
  text = file_of_driver("model_mover", "model_mover_driver.hpp");
  assert_true(has(text, "  flexrf::Input<flexrf::user::WayMark> scene;  ///< What is around.\n"));
  assert_true(has(text, "  flexrf::Output<flexrf::user::WayMark> truth;  ///< Where it is.\n"));
  assert_true(has(text, "  flexrf::QueueOutput<flexrf::user::WayMark> calls;"));
  assert_true(has(text, "connect(const flexrf::DeviceBinding& binding) noexcept final;"));
  assert_true(has(text, "#include \"types/way_mark.hpp\"\n"));
  text = file_of_driver("model_mover", "model_mover_driver.cpp");
  assert_true(has(text,
                  "  flexrf::user::MoverInterface::connect(binding);\n"
                  "  scene.connect(binding.context, binding.input(0));\n"
                  "  kept.connect(binding.context, binding.input(1));\n"
                  "  missing.connect(binding.context, binding.input(2));\n"
                  "  truth.connect(binding.context, binding.output(0));\n"
                  "  calls.connect(binding.context, binding.queue_output(0));\n}\n"));
  assert_true(has(text, "    case 1: return kept.counters(member);\n"));
  text = file_of_driver("model_scenery", "model_scenery_driver.cpp");
  assert_true(has(text, "  calls.connect(binding.queue_input(0));\n"));
}

/// What the compiler is to check of a driver's guard, "" for nothing, where its table says this of it.
std::string checked_of(const char* driver, bool actuates) {
  const fs::path tests = fs::path(place::source_folder) / "tests/generator";
  const Target target{Target::Kind::driver, tests / "drivers" / driver / (std::string(driver) + ".toml")};
  const SearchPaths paths{{tests / "cell/types"}, {}, {tests / "interfaces"}, {tests / "drivers"}, {}};
  Diagnostics diagnostics;
  Model model = read(target, paths, diagnostics);
  for (Driver& one : model.drivers) one.actuates = actuates;
  std::string found = "no file";
  for (const GeneratedFile& file : emit(model, target, diagnostics)) {
    if (file.path != std::string(driver) + "_construct.cpp") continue;
    const std::size_t guard = file.contents.find("GuardedDriver<");
    if (guard == std::string::npos) return "";
    found = file.contents.substr(file.contents.rfind("static_assert", guard));
    found.resize(found.find(';'));
  }
  return found;
}

bool says(const std::string& text, const char* begin, const char* end) {
  if (text.starts_with(begin) && text.ends_with(end)) return true;
  print_error("%s instead of %s ... %s\n", text.c_str(), begin, end);
  return false;
}

/// A bus has what it carries do it.
void what_moves_has_to_have_the_guard_and_to_say_so(void**) {
  assert_true(says(checked_of("mock_station", true), "static_assert(flexrf::GuardedDriver<MockStation>,",
                   "Actuator<StationInterface> (hal/driver/actuator.hpp)\")"));
  assert_true(says(checked_of("mock_station", false), "static_assert(!flexrf::GuardedDriver<MockStation>,",
                   "its table has to say actuates = true\")"));
  assert_true(text_is(checked_of("mock_link", true), ""));
  assert_true(text_is(checked_of("mock_link", false), ""));
}

/// The cell's picture; `apart`: one member of its population `worker` runs in another thread than the others.
std::string picture_of_the_cell(bool apart) {
  const fs::path tests = fs::path(place::source_folder) / "tests/generator";
  const SearchPaths paths{
      {tests / "cell/types"}, {tests / "cell/units"}, {tests / "interfaces"}, {tests / "drivers"}, {}};
  Diagnostics diagnostics;
  Model model = read({Target::Kind::application, tests / "cell/generated_cell.toml"}, paths, diagnostics);
  check(model, diagnostics);
  if (apart) {
    const Index member = model.populations.front().first + 1;
    Unit& unit = model.units[member];
    std::erase(model.threads[*unit.thread].units, member);
    unit.thread = 0;
    model.threads[0].units.push_back(member);
  }
  return diagram_mermaid(model);
}

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

void a_population_is_drawn_as_one(void**) {
  static std::string text;
  text = picture_of_the_cell(false);
  assert_true(has(text, "(\"worker x 3\")\n"));
  assert_int_equal(count_of(text, "worker"), 1);
  assert_int_equal(count_of(text, "-->|\"places\"|"), 1);
  assert_int_equal(count_of(text, "==>|\"jobs\"|"), 1);
  // Where its members run matters when they do not run alike.
  text = picture_of_the_cell(true);
  assert_int_equal(count_of(text, "(\"worker["), 3);
  assert_int_equal(count_of(text, "-->|\"places["), 3);
  assert_int_equal(count_of(text, "==>|\"jobs\"|"), 3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(same_tables_same_bytes),
                              cmocka_unit_test(a_population_is_drawn_as_one),
                              cmocka_unit_test(the_hash_follows_the_contents),
                              cmocka_unit_test(literals),
                              cmocka_unit_test(identifiers_differ_as_names_do),
                              cmocka_unit_test(ports_of_a_driver_are_members_of_its_base),
                              cmocka_unit_test(what_moves_has_to_have_the_guard_and_to_say_so),
                              cmocka_unit_test(paths_do_not_say_where_the_repository_lies)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
