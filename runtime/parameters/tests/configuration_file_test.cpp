#include "runtime/parameters/configuration_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>

#include "runtime/parameters/configuration_document.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/parameters/tests/sample_component.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::configuration_file_test {
namespace {

constexpr const char* other_drivers[] = {"real", "mock"};

// Static, because a failing assertion jumps over destructors.
struct World {
  sample::SampleComponent unit;
  sample::SampleComponent device;
  std::vector<ConfigurationComponent> components;
  ConfigurationIdentity identity{"cell", 0x1234, {}};
  ConfigurationReport report;
  SetMarks marks[4];  // of the unit's configuration and runtime parameters, of the device's
  std::string folder;
  std::string file;
};
World* world;

/// As if somebody had set every value.
void mark_all() {
  for (SetMarks* marks : {&world->marks[0], &world->marks[2]}) {
    *marks = SetMarks(sizeof(sample::Configuration));
    marks->mark(0, marks->size());
  }
  for (SetMarks* marks : {&world->marks[1], &world->marks[3]}) {
    *marks = SetMarks(sizeof(sample::Runtime));
    marks->mark(0, marks->size());
  }
}

// With the padding between the fields, so that memory can be compared.
void reset_values() {
  for (sample::SampleComponent* component : {&world->unit, &world->device}) {
    std::memcpy(&component->configuration, &sample::default_configuration, sizeof(sample::Configuration));
    std::memcpy(&component->runtime, &sample::default_runtime, sizeof(sample::Runtime));
  }
}

int begin(void**) {
  world = new World;
  char folder[] = "/tmp/flexrf-configuration-XXXXXX";
  if (mkdtemp(folder) == nullptr) return -1;
  world->folder = folder;
  reset_values();
  world->file = world->folder + "/config.xml";
  world->components.push_back({"unit",
                               "jog",
                               "",
                               {},
                               &sample::component_type,
                               &world->unit.configuration,
                               &world->unit.runtime,
                               &world->marks[0],
                               &world->marks[1]});
  world->components.push_back({"device", "arm", "simulated", other_drivers, &sample::component_type,
                               &world->device.configuration, &world->device.runtime, &world->marks[2],
                               &world->marks[3]});
  mark_all();
  return 0;
}

int end(void**) {
  std::filesystem::remove_all(world->folder);
  delete world;
  return 0;
}

ConfigurationSource load() {
  world->report = load_configuration(world->file, world->identity, world->components);
  return world->report.source;
}
bool save() {
  return save_configuration(world->file, world->identity, world->components).is_ok();
}
void write(const std::string& text, const char* suffix = "") {
  FILE* file = std::fopen((world->file + suffix).c_str(), "w");
  if (file == nullptr) std::abort();
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
}
std::string contents(const char* suffix = "") {
  Result<std::string> text = read_file(world->file + suffix);
  return text ? *text : "";
}
bool exists(const char* suffix) {
  return std::filesystem::exists(world->file + suffix);
}
void replace(const char* from, const char* to) {
  std::string text = contents();
  text.replace(text.find(from), std::strlen(from), to);
  write(text);
}
template <class T>
bool has_same_bytes(const T& one, const T& other) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&one);
  return std::equal(bytes, bytes + sizeof(T), reinterpret_cast<const std::byte*>(&other));
}
bool has_unchanged_values() {
  return has_same_bytes(world->unit.configuration, sample::default_configuration) &&
         has_same_bytes(world->unit.runtime, sample::default_runtime);
}

/// Line `index` without the folder's name.
void expect_line(const std::vector<std::string>& lines, std::size_t index, const char* expected) {
  static char line[1024];
  if (index >= lines.size()) {
    for (const std::string& other : lines) print_message("%s\n", other.c_str());
    fail_msg("no line %zu: %s", index, expected);
  }
  std::snprintf(line, sizeof(line), "%s", lines[index].c_str());
  for (char* at = std::strstr(line, world->folder.c_str()); at != nullptr;
       at = std::strstr(at, world->folder.c_str()))
    std::memmove(at, at + world->folder.size() + 1, std::strlen(at) - world->folder.size());
  assert_string_equal(line, expected);
}
void expect_problem(std::size_t index, const char* expected) {
  expect_line(world->report.problems, index, expected);
}
void expect_notice(std::size_t index, const char* expected) {
  expect_line(world->report.notices, index, expected);
}

void without_a_file_the_tables_hold(void**) {
  assert_int_equal(load(), ConfigurationSource::tables);
  assert_true(has_unchanged_values());
  assert_int_equal(world->report.problems.size(), 0);
  assert_int_equal(world->report.notices.size(), 1);
  expect_notice(
      0,
      "config.xml: there is no such file yet: the values of the tables hold; it is written when somebody has "
      "set one");
  mark_all();
  assert_true(save());
  assert_int_equal(load(), ConfigurationSource::file);
  assert_int_equal(world->report.notices.size(), 0);
}

/// The offset of a field in the sample's runtime parameters or configuration.
#define OFFSET(Struct, field) offsetof(sample::Struct, field), sizeof(sample::Struct::field)

void nothing_is_written_where_nothing_is_set(void**) {
  for (SetMarks& marks : world->marks) marks.clear(0, marks.size());
  world->unit.runtime.step = 0.02;
  assert_true(save());
  assert_false(exists(""));
}

void the_file_holds_what_was_set_and_nothing_else(void**) {
  for (SetMarks& marks : world->marks) marks.clear(0, marks.size());
  world->marks[1].mark(OFFSET(Runtime, step));  // the value of the tables, but somebody chose it
  world->marks[1].mark(offsetof(sample::Runtime, gains) + sizeof(float), sizeof(float));
  world->marks[1].mark(offsetof(sample::Runtime, limits) + offsetof(sample::Limits, high), sizeof(float));
  world->marks[0].mark(offsetof(sample::Configuration, limits) + sizeof(sample::Limits), sizeof(double));
  assert_true(save());
  static std::string text;
  text = contents();
  text = text.substr(text.find("  <unit"));
  assert_string_equal(text.c_str(),
                      "  <unit name=\"jog\">\n"
                      "    <configuration>\n"
                      "      <limits index=\"1\">\n"
                      "        <low unit=\"m\">2</low>\n"
                      "      </limits>\n"
                      "    </configuration>\n"
                      "    <runtime>\n"
                      "      <step unit=\"m\">0.01</step>\n"
                      "      <gains>1 2 3</gains>\n"
                      "      <limits>\n"
                      "        <high unit=\"m\">1</high>\n"
                      "      </limits>\n"
                      "    </runtime>\n"
                      "  </unit>\n"
                      "</flexrf>\n");
  // The tables' values change: what was set stays, the rest follows.
  reset_values();
  world->unit.runtime.step = 0.05;
  world->unit.runtime.small = 11;
  world->unit.runtime.limits.low = -2;
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(world->unit.runtime.step == 0.01);
  assert_int_equal(world->unit.runtime.small, 11);
  assert_true(world->unit.runtime.limits.low == -2);
  // What the file gives counts as set, and is kept by the next save.
  assert_true(world->marks[1].any(OFFSET(Runtime, step)));
  assert_false(world->marks[1].any(OFFSET(Runtime, small)));
  static std::string again;
  assert_true(save());
  again = contents();
  assert_string_equal(again.substr(again.find("  <unit")).c_str(), text.c_str());
}

/// Far more than the time of a test, were the place of each line or the name of each component sought anew.
void a_large_file_is_read_in_linear_time(void**) {
  static std::vector<sample::SampleComponent> units(2000);
  static std::vector<std::string> names(units.size());
  world->components.clear();
  for (std::size_t i = 0; i < units.size(); ++i) {
    names[i] = "a_unit_with_a_long_name_" + std::to_string(i);
    world->components.push_back({"unit",
                                 names[i].c_str(),
                                 "",
                                 {},
                                 &sample::component_type,
                                 &units[i].configuration,
                                 &units[i].runtime});
  }
  static std::string text;
  text = "<flexrf>\n";
  for (const std::string& name : names)
    text += "  <unit name=\"" + name + "\"><runtime><small>9</small></runtime></unit>\n";
  write(text + "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::file);
  assert_int_equal(units.back().runtime.small, 9);

  constexpr int strangers = 250'000;
  for (int i = 0; i < strangers; ++i)
    text += "  <unit name=\"a_unit_with_a_long_name_x" + std::to_string(i) + "\"/>\n";
  write(text + "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  assert_int_equal(world->report.problems.size(), 51);
  expect_problem(0,
                 "config.xml:2002:3: error: there is no unit 'a_unit_with_a_long_name_x0'; did you mean "
                 "'a_unit_with_a_long_name_0'?");
  expect_problem(50, "config.xml: and 249950 further errors");
}

void what_a_killed_process_left_does_not_disturb(void**) {
  assert_true(save());
  assert_int_equal(mkfifo((world->file + ".new").c_str(), 0600), 0);
  world->unit.runtime.step = 0.02;
  assert_true(save());
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(world->unit.runtime.step == 0.02);
  assert_false(exists(".new"));
}

void nothing_is_written_that_could_not_be_read_again(void**) {
  assert_true(replace_file(world->file, "small").is_ok());
  static std::string text;
  text.assign((std::size_t{16} << 20) + 1, 'x');
  const Status status = replace_file(world->file, text);
  assert_int_equal(status.code(), StatusCode::out_of_range);
  assert_string_equal(contents().c_str(), "small");
}

void a_lost_file_falls_back_to_the_previous(void**) {
  world->unit.runtime.step = 0.02;
  assert_true(save());
  world->unit.runtime.step = 0.03;
  assert_true(save());
  std::filesystem::remove(world->file);
  reset_values();
  assert_int_equal(load(), ConfigurationSource::previous);
  assert_true(world->unit.runtime.step == 0.02);
  assert_int_equal(world->report.problems.size(), 0);
  expect_notice(
      0,
      "config.xml: there is no such file (remove its copy too to start with the tables' values): the "
      "previous copy 'config.xml.previous' is used in its place");
  // Saving writes the file and leaves the copy.
  assert_true(save());
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(contents(".previous").find("0.02") != std::string::npos);
  // A copy that is no good: nobody knows what the cell was tuned to.
  std::filesystem::remove(world->file);
  write("<flexrf", ".previous");
  reset_values();
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml.previous:1:7: error: damaged: Error parsing start element tag");
  expect_problem(1,
                 "config.xml: error: there is no such file, and 'config.xml.previous' cannot be used in its "
                 "place: repair that, or remove it to start with the values of the tables");
  assert_true(has_unchanged_values());
}

void what_is_saved_is_loaded(void**) {
  static sample::Configuration configuration;
  std::memcpy(&configuration, &sample::default_configuration, sizeof(configuration));
  configuration.length = 1.0 / 3;
  configuration.rotation[5] = -0.1;
  configuration.limits[1].low = 5;
  configuration.limits[1].high = 6;
  std::strcpy(configuration.title, "a <b> & \"c\"");
  std::memcpy(&world->unit.configuration, &configuration, sizeof(configuration));
  world->unit.runtime.step = 0.0123;
  world->unit.runtime.mode = 2;
  world->unit.runtime.limits = {-7, 8};
  world->unit.runtime.scratch = 99;
  world->unit.runtime.go = 3;
  world->device.runtime.small = 77;
  assert_true(save());
  assert_false(exists(".previous"));
  assert_false(exists(".new"));
  reset_values();
  assert_int_equal(load(), ConfigurationSource::file);
  assert_int_equal(world->report.problems.size(), 0);
  assert_int_equal(world->report.notices.size(), 0);
  assert_memory_equal(&world->unit.configuration, &configuration, sizeof(configuration));
  assert_true(world->unit.runtime.step == 0.0123);
  assert_int_equal(world->unit.runtime.mode, 2);
  assert_true(world->unit.runtime.limits.low == -7);
  assert_int_equal(world->device.runtime.small, 77);
  // Not kept in files: what is not persistent, and presses.
  assert_true(world->unit.runtime.scratch == 0.5);
  assert_int_equal(world->unit.runtime.go, 0);
}

void the_file_is_for_people_to_read(void**) {
  world->components.pop_back();
  assert_true(save());
  static char text[4096];
  std::snprintf(text, sizeof(text), "%s", contents().c_str());
  char* checksum = std::strstr(text, "checksum=\"") + std::strlen("checksum=\"");
  checksum = std::strstr(checksum, "checksum=\"") + std::strlen("checksum=\"");
  std::memcpy(checksum, "................", 16);
  assert_string_equal(
      text,
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<!-- Values only, in the units shown. After an edit by hand write checksum=\"edited\" below. -->\n"
      "<flexrf application=\"cell\" format=\"1\" descriptor=\"0000000000001234\" "
      "checksum=\"................\">\n"
      "  <unit name=\"jog\">\n"
      "    <configuration>\n"
      "      <length unit=\"m\">2</length>\n"
      "      <rows>3</rows>\n"
      "      <title>home</title>\n"
      "      <rotation unit=\"rad\">1 3 -2; 2 -1 -3</rotation>\n"
      "      <limits index=\"0\">\n"
      "        <low unit=\"m\">0</low>\n"
      "        <high unit=\"m\">1</high>\n"
      "      </limits>\n"
      "      <limits index=\"1\">\n"
      "        <low unit=\"m\">2</low>\n"
      "        <high unit=\"m\">3</high>\n"
      "      </limits>\n"
      "    </configuration>\n"
      "    <runtime>\n"
      "      <step unit=\"m\">0.01</step>\n"
      "      <gains>1 2 3</gains>\n"
      "      <mode>manual</mode>\n"
      "      <enabled>false</enabled>\n"
      "      <small>-5</small>\n"
      "      <large>7</large>\n"
      "      <limits>\n"
      "        <low unit=\"m\">-1</low>\n"
      "        <high unit=\"m\">1</high>\n"
      "      </limits>\n"
      "    </runtime>\n"
      "  </unit>\n"
      "</flexrf>\n");
}

void saving_keeps_the_former_file_and_its_permissions(void**) {
  assert_true(save());
  assert_int_equal(chmod(world->file.c_str(), 0600), 0);
  assert_true(save());
  assert_false(exists(".previous"));  // nothing had changed
  world->unit.runtime.step = 0.02;
  assert_true(save());
  assert_true(exists(".previous"));
  struct stat status {};
  assert_int_equal(stat(world->file.c_str(), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0600);
  world->unit.runtime.step = 0.03;
  assert_true(save());
  write(contents(".previous"));
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(world->unit.runtime.step == 0.02);
}

void a_failed_save_leaves_the_file(void**) {
  assert_true(save());
  assert_int_equal(mkdir((world->file + ".new").c_str(), 0700), 0);
  world->unit.runtime.step = 0.02;
  assert_false(save());
  reset_values();
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(world->unit.runtime.step == 0.01);
}

void a_damaged_file_falls_back_to_the_previous(void**) {
  world->unit.runtime.step = 0.02;
  assert_true(save());
  world->unit.runtime.step = 0.03;
  assert_true(save());
  // Every truncation is seen, and never half a file is taken.
  const std::size_t size = contents().size();
  static std::string whole_text;
  whole_text = contents();
  for (std::size_t length = 0; length + 1 < size; length += 7) {
    write(whole_text.substr(0, length));
    reset_values();
    assert_int_equal(load(), ConfigurationSource::previous);
    assert_true(world->unit.runtime.step == 0.02);
  }
  write(whole_text);
  replace("0.03", "0.04");
  reset_values();
  assert_int_equal(load(), ConfigurationSource::previous);
  assert_true(world->unit.runtime.step == 0.02);
  expect_problem(
      0,
      "config.xml:3:1: error: damaged, or edited by hand: the checksum does not match. If you edited it, "
      "write checksum=\"edited\"");
  expect_notice(0, "config.xml: the previous copy 'config.xml.previous' is used in its place");
  // Saving now loses neither the good copy nor the edit.
  assert_true(save());
  assert_true(contents(".damaged").find("0.04") != std::string::npos);
  assert_true(contents(".previous").find("0.02") != std::string::npos);
}

// Nothing of a file is passed over: neither the second of two, nor what stands beside the elements.
void what_would_be_passed_over_is_refused(void**) {
  write(
      "<flexrf>\n"
      "  <unit name=\"jog\">\n"
      "    <runtime><step>0.02</step></runtime>\n"
      "    <runtime><step>0.03</step></runtime>\n"
      "    and more\n"
      "    <configuration><limits index=\"0\"><low>0</low>x<low>1</low></limits></configuration>\n"
      "  </unit>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  std::size_t line = 0;
  expect_problem(line++, "config.xml:4:5: error: <runtime> of unit 'jog' is given twice");
  expect_problem(line++, "config.xml:4:40: error: text between the sections of unit 'jog'");
  expect_problem(line++, "config.xml:6:49: error: text between the members of 'jog.limits[0]'");
  expect_problem(line++, "config.xml:6:51: error: 'jog.limits[0].low' is given twice");
  assert_true(has_unchanged_values());
  write("<flexrf>\n</flexrf>\n<!-- a comment -->\nand more\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:3:18: error: damaged: text outside of the outermost element");
  write("and more <flexrf/>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:1:1: error: damaged: text outside of the outermost element");
  write("<!-- nothing else -->\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:1:1: error: damaged: there is no element in it");
  write("<!-- before --><flexrf>\n  <unit name=\"jog\">\n  </unit>\n</flexrf>\n<!-- behind -->\n");
  assert_int_equal(load(), ConfigurationSource::file);
}

/// What is one, however it is written: of two the second would win without a word.
void what_is_given_twice_is_refused(void**) {
  static constexpr Rename renames[] = {{"jog.stride", "jog.step"}};
  world->identity.renames = renames;
  write(
      "<flexrf>\n"
      "  <unit name=\"jog\" name=\"other\">\n"
      "    <runtime><stride>0.02</stride><step>0.03</step></runtime>\n"
      "    <configuration>\n"
      "      <limits index=\"1\"><low>0</low></limits>\n"
      "      <limits index=\"01\"><low>1</low></limits>\n"
      "      <limits index=\"-18446744073709551616\"><low>1</low></limits>\n"
      "    </configuration>\n"
      "  </unit>\n"
      "  <device name=\"arm\" driver=\"real\"/>\n"
      "  <device name=\"arm\" driver=\"mock\"/>\n"
      "  <device name=\"arm\" driver=\"real\"/>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  std::size_t line = 0;
  expect_problem(line++, "config.xml:2:3: error: attribute 'name' of <unit> is given twice");
  expect_problem(line++, "config.xml:3:35: error: 'jog.step' is given twice");
  expect_problem(line++, "config.xml:6:7: error: 'jog.limits' is given twice");
  expect_problem(line++, "config.xml:7:7: error: 'jog.limits' wants index=\"0\" to \"1\"");
  expect_problem(line++, "config.xml:12:3: error: device 'arm' with driver 'real' is given twice");
  assert_true(has_unchanged_values());
}

void a_syntax_error_has_line_and_column(void**) {
  write("<flexrf>\n  <unit name=\"jog\">\n    <runtime><step>0.02</stpe></runtime>\n  </unit>\n</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:3:26: error: damaged: Start-end tags mismatch");
  expect_problem(
      1,
      "config.xml: error: there is no previous copy 'config.xml.previous': repair the file, or remove it to "
      "start with the values of the tables");
  write("<flexrf/>\n<flexrf/>\n");
  write("<flexrf", ".previous");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:2:1: error: damaged: a second document begins here");
  expect_problem(1, "config.xml.previous:1:7: error: damaged: Error parsing start element tag");
  expect_problem(
      2,
      "config.xml: error: nor can 'config.xml.previous' be used: repair the file, or remove both to "
      "start with the values of the tables");
  assert_true(has_unchanged_values());
}

void an_edited_file_is_taken_with_a_notice(void**) {
  write(
      "<flexrf checksum=\"edited\">\n  <unit name=\"jog\"><runtime><step "
      "unit=\"m\">0.05</step></runtime></unit>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::file);
  expect_notice(0, "config.xml:1:1: edited by hand: taken without a checksum");
  assert_true(world->unit.runtime.step == 0.05);
  assert_true(world->unit.configuration.length == 2);
  // Saving completes it.
  assert_true(save());
  assert_int_equal(load(), ConfigurationSource::file);
  assert_int_equal(world->report.notices.size(), 0);
}

void all_that_does_not_fit_is_named_at_once_and_nothing_is_taken(void**) {
  write(
      "<flexrf>\n"
      "  <unit name=\"jog\">\n"
      "    <runtime>\n"
      "      <small>4</small>\n"
      "      <step>0.5</step>\n"
      "      <gians>1 2 3</gians>\n"
      "      <gains>1 2 30</gains>\n"
      "      <mode>manuel</mode>\n"
      "      <limits><lo>1</lo><high>nan</high></limits>\n"
      "      <scratch>1</scratch>\n"
      "      <go>1</go>\n"
      "      <small>5</small>\n"
      "    </runtime>\n"
      "    <configuration>\n"
      "      <length unit=\"mm\">2</length>\n"
      "      <limits index=\"2\"/>\n"
      "      <rows colour=\"red\">two</rows>\n"
      "      <title>far too long a title</title>\n"
      "      <rotation>1 <b/></rotation>\n"
      "    </configuration>\n"
      "    <runtme/>\n"
      "  </unit>\n"
      "  <unit name=\"jogg\"/>\n"
      "  <unit name=\"arm\"/>\n"
      "  <device name=\"arm\" driver=\"reel\"/>\n"
      "  <devise/>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::refused);
  std::size_t line = 0;
  expect_problem(line++, "config.xml:5:7: error: jog.step: 0.5 m lies outside 0.001 to 0.1 m");
  expect_problem(line++,
                 "config.xml:6:7: error: 'jog' has no runtime parameter 'gians'; did you mean 'gains'?");
  expect_problem(line++, "config.xml:7:7: error: jog.gains, value 3: 30 lies outside 0 to 10");
  expect_problem(line++, "config.xml:8:7: error: jog.mode: 'manuel' is no Mode; did you mean 'manual'?");
  expect_problem(line++, "config.xml:9:15: error: 'jog.limits' has no member 'lo'; did you mean 'low'?");
  expect_problem(line++, "config.xml:9:25: error: jog.limits.high: nan is not a finite number");
  expect_problem(line++, "config.xml:10:7: error: 'jog.scratch' is not kept in files");
  expect_problem(line++, "config.xml:11:7: error: 'jog.go' is not kept in files");
  expect_problem(line++, "config.xml:12:7: error: 'jog.small' is given twice");
  expect_problem(line++,
                 "config.xml:15:7: error: 'jog.length' is given in 'mm', but its unit of measure is 'm'");
  expect_problem(line++, "config.xml:16:7: error: 'jog.limits' wants index=\"0\" to \"1\"");
  expect_problem(line++, "config.xml:17:7: error: <rows> has no attribute 'colour'");
  expect_problem(line++, "config.xml:17:7: error: jog.rows: 'two' is not an integer");
  expect_problem(line++, "config.xml:18:7: error: jog.title: 20 bytes of text, but there is room for 16");
  expect_problem(line++, "config.xml:19:19: error: <b> within a single value");
  expect_problem(
      line++,
      "config.xml:21:5: error: <runtme> is neither <configuration> nor <runtime>; did you mean 'runtime'?");
  expect_problem(line++, "config.xml:23:3: error: there is no unit 'jogg'; did you mean 'jog'?");
  expect_problem(line++, "config.xml:24:3: error: there is no unit 'arm'");
  expect_problem(line++, "config.xml:25:3: error: device 'arm' has no driver 'reel'; did you mean 'real'?");
  expect_problem(line++,
                 "config.xml:26:3: error: <devise> is neither <unit> nor <device>; did you mean 'device'?");
  assert_int_equal(world->report.problems.size(), line);
  assert_true(has_unchanged_values());
}

void a_file_of_another_application_is_refused(void**) {
  write("<flexrf application=\"press\"/>");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:1:1: error: this file is of the application 'press', not of 'cell'");
  write("<html/>");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml:1:1: error: the outermost element is <html>, not <flexrf>");
  write("<flexrf format=\"9\"/>");
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(
      0, "config.xml:1:1: error: format 9 was written by a newer FlexRF; this one reads formats up to 1");
}

void of_other_tables_what_fits_is_taken_under_its_new_name(void**) {
  static constexpr Rename renames[] = {
      {"jogger", "jog"}, {"jogger.stride", "jog.step"}, {"jog.tall", "jog.length"}};
  world->identity.renames = renames;
  write(
      "<flexrf descriptor=\"999\">\n"
      "  <unit name=\"jogger\">\n"
      "    <runtime><stride>0.05</stride><small>1000</small><gone>1</gone></runtime>\n"
      "    <configuration><tall>4</tall></configuration>\n"
      "  </unit>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::file);
  assert_true(world->unit.runtime.step == 0.05);
  assert_true(world->unit.configuration.length == 4);
  assert_int_equal(world->unit.runtime.small, -5);
  expect_notice(
      0, "config.xml:1:1: written for other tables of this application: values that still fit are taken");
  expect_notice(1, "config.xml:1:1: edited by hand: taken without a checksum");
  expect_notice(2, "config.xml:3:35: left out: jog.small: 1000 does not fit its type");
  expect_notice(3, "config.xml:3:54: left out: 'jog' has no runtime parameter 'gone'");
  assert_int_equal(world->report.notices.size(), 4);
}

void values_of_another_driver_are_neither_read_nor_lost(void**) {
  write(
      "<flexrf>\n"
      "  <device name=\"arm\" driver=\"real\"><configuration><port>7</port></configuration></device>\n"
      "  <device name=\"arm\" driver=\"simulated\"><runtime><small>9</small></runtime></device>\n"
      "</flexrf>\n");
  assert_int_equal(load(), ConfigurationSource::file);
  assert_int_equal(world->device.runtime.small, 9);
  assert_true(save());
  assert_true(contents().find("<port>7</port>") != std::string::npos);
  assert_int_equal(load(), ConfigurationSource::file);
}

void a_file_that_cannot_be_read_is_not_taken_for_absent(void**) {
  assert_int_equal(mkdir(world->file.c_str(), 0700), 0);
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml: error: cannot read 'config.xml': it is a folder, not a file");
  assert_int_equal(rmdir(world->file.c_str()), 0);
  // Nobody writes to it: this would wait for ever.
  assert_int_equal(mkfifo(world->file.c_str(), 0600), 0);
  assert_int_equal(load(), ConfigurationSource::refused);
  expect_problem(0, "config.xml: error: cannot read 'config.xml': it is a pipe, not a file");
}

void older_formats_are_brought_up_step_by_step(void**) {
  static constexpr FormatStep steps[] = {
      {1, [](pugi::xml_node root) { root.child("unit").set_name("part"); }},
      {2, [](pugi::xml_node root) { root.child("part").append_attribute("kind").set_value("unit"); }}};
  static pugi::xml_document document;
  assert_true(static_cast<bool>(document.load_string("<flexrf format='1'><unit/></flexrf>")));
  assert_true(upgrade_format(document.document_element(), 3, steps).is_ok());
  assert_string_equal(document.document_element().attribute("format").value(), "3");
  assert_string_equal(document.document_element().child("part").attribute("kind").value(), "unit");
  assert_true(upgrade_format(document.document_element(), 3, steps).is_ok());
  assert_false(upgrade_format(document.document_element(), 2, steps).is_ok());
  document.document_element().attribute("format").set_value(0);
  assert_false(upgrade_format(document.document_element(), 3, steps).is_ok());
}

}  // namespace
}  // namespace flexrf::configuration_file_test

int main() {
  using namespace flexrf::configuration_file_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(without_a_file_the_tables_hold, begin, end),
      cmocka_unit_test_setup_teardown(what_is_saved_is_loaded, begin, end),
      cmocka_unit_test_setup_teardown(what_a_killed_process_left_does_not_disturb, begin, end),
      cmocka_unit_test_setup_teardown(nothing_is_written_that_could_not_be_read_again, begin, end),
      cmocka_unit_test_setup_teardown(a_large_file_is_read_in_linear_time, begin, end),
      cmocka_unit_test_setup_teardown(the_file_holds_what_was_set_and_nothing_else, begin, end),
      cmocka_unit_test_setup_teardown(nothing_is_written_where_nothing_is_set, begin, end),
      cmocka_unit_test_setup_teardown(the_file_is_for_people_to_read, begin, end),
      cmocka_unit_test_setup_teardown(saving_keeps_the_former_file_and_its_permissions, begin, end),
      cmocka_unit_test_setup_teardown(a_failed_save_leaves_the_file, begin, end),
      cmocka_unit_test_setup_teardown(a_damaged_file_falls_back_to_the_previous, begin, end),
      cmocka_unit_test_setup_teardown(a_lost_file_falls_back_to_the_previous, begin, end),
      cmocka_unit_test_setup_teardown(what_would_be_passed_over_is_refused, begin, end),
      cmocka_unit_test_setup_teardown(what_is_given_twice_is_refused, begin, end),
      cmocka_unit_test_setup_teardown(a_syntax_error_has_line_and_column, begin, end),
      cmocka_unit_test_setup_teardown(an_edited_file_is_taken_with_a_notice, begin, end),
      cmocka_unit_test_setup_teardown(all_that_does_not_fit_is_named_at_once_and_nothing_is_taken, begin,
                                      end),
      cmocka_unit_test_setup_teardown(a_file_of_another_application_is_refused, begin, end),
      cmocka_unit_test_setup_teardown(of_other_tables_what_fits_is_taken_under_its_new_name, begin, end),
      cmocka_unit_test_setup_teardown(values_of_another_driver_are_neither_read_nor_lost, begin, end),
      cmocka_unit_test_setup_teardown(a_file_that_cannot_be_read_is_not_taken_for_absent, begin, end),
      cmocka_unit_test(older_formats_are_brought_up_step_by_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
