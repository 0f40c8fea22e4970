// --config FILE over several starts: written, restored, damaged, wrong.
#include <algorithm>
#include <cstdio>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

const std::string application = place::application;

Ending start(const Folder& folder) {
  write_file(folder / "keys", "0.5 d\n0.6 d\n");
  return run(folder, {application, "--virtual-time", "60s", "--keys", "keys", "--config", "cell.xml",
                      "--report", "report"});
}

double step_in_force(const Folder& folder) {
  return Report(folder / "report").last("jog.values").at("step");
}

/// As an engineer does it by hand.
void edit(const Folder& folder, const std::string& from, const std::string& to,
          const char* file = "cell.xml") {
  std::string text = contents_of(folder / file);
  const std::size_t place = text.find(from);
  CHECK(place != std::string::npos);
  text.replace(place, from.size(), to);
  const std::size_t sum = text.find("checksum=\"", text.find("<flexrf ")) + 10;
  text.replace(sum, text.find('"', sum) - sum, "edited");
  write_file(folder / file, text);
}

std::string line_of(const Folder& folder, const std::string& word) {
  const std::string text = contents_of(folder / "cell.xml");
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(word));
  return std::to_string(1 + std::count(text.begin(), end, '\n'));
}

/// What a person has set: the values that the tables have, so that each has a place in the file.
void begin_with_a_file(const Folder& folder) {
  write_file(folder / "cell.xml",
             "<flexrf checksum=\"edited\">\n  <unit name=\"jog\">\n    <runtime>\n"
             "      <step unit=\"m\">0.01</step>\n      <turn unit=\"rad\">0.05</turn>\n"
             "    </runtime>\n  </unit>\n</flexrf>\n");
  CHECK_EQUAL(start(folder).exit_code, 0);
  std::remove((folder / "cell.xml.previous").c_str());
}

void values_are_restored_at_the_next_start_and_nothing_else_is_written() {
  const Folder folder;
  const Ending first = start(folder);
  CHECK_EQUAL(first.exit_code, 0);
  CHECK_CONTAINS(first.errors, "cell.xml: there is no such file yet");
  CHECK_EQUAL(contents_of(folder / "cell.xml"), std::string{});
  begin_with_a_file(folder);
  edit(folder, ">0.01</step>", ">0.02</step>");
  CHECK_EQUAL(start(folder).exit_code, 0);
  CHECK_EQUAL(step_in_force(folder), 0.02);
  // Twice two centimetres.
  const double way = Report(folder / "report").last("tool_pose").at("position").at(1);
  CHECK(way > -0.041 && way < -0.039);
  const std::string text = contents_of(folder / "cell.xml");
  CHECK_CONTAINS(text, "<step unit=\"m\">0.02</step>");
  // What was edited has its checksum again.
  CHECK_EQUAL(text.find("\"edited\"", text.find("<flexrf ")), std::string::npos);
  // What nobody set is not in it, so that the tables' values take effect.
  CHECK_EQUAL(text.find("<device"), std::string::npos);
  CHECK_EQUAL(text.find("<configuration>"), std::string::npos);
}

void a_damaged_file_is_cited_and_the_previous_one_used() {
  const Folder folder;
  begin_with_a_file(folder);
  edit(folder, ">0.01</step>", ">0.02</step>");
  CHECK_EQUAL(start(folder).exit_code, 0);
  edit(folder, ">0.02</step>", ">0.03</step>");
  CHECK_EQUAL(start(folder).exit_code, 0);
  // The copy before it has what was there before: 0.02, or the edit that led to it.
  const std::string previous = contents_of(folder / "cell.xml.previous");
  const std::string text = contents_of(folder / "cell.xml");
  write_file(folder / "cell.xml", text.substr(0, text.size() / 2));
  const Ending ending = start(folder);
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK_CONTAINS(ending.errors, "cell.xml:");
  CHECK_CONTAINS(ending.errors, ": error: ");
  CHECK_CONTAINS(ending.errors, "cell.xml.previous");
  CHECK_CONTAINS(previous, ">" + nlohmann::json(step_in_force(folder)).dump() + "</step>");
}

void a_changed_value_without_its_checksum_is_damage() {
  const Folder folder;
  begin_with_a_file(folder);
  std::string text = contents_of(folder / "cell.xml");
  text.replace(text.find(">0.01</step>"), 12, ">0.05</step>");
  write_file(folder / "cell.xml", text);
  const Ending ending = start(folder);
  // There is no copy before it: the file is refused rather than half believed.
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors, "checksum");
  CHECK_CONTAINS(ending.errors, "nothing was started");
}

void a_value_out_of_range_is_refused_with_its_place() {
  const Folder folder;
  begin_with_a_file(folder);
  edit(folder, ">0.01</step>", ">0.5</step>");
  edit(folder, "<turn unit=\"rad\">0.05</turn>", "<tern unit=\"rad\">0.05</tern>");
  const std::string before = contents_of(folder / "cell.xml");
  const Ending ending = start(folder);
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors, "cell.xml:" + line_of(folder, ">0.5</step>") + ":");
  CHECK_CONTAINS(ending.errors, "step");
  CHECK_CONTAINS(ending.errors, "0.001");
  CHECK_CONTAINS(ending.errors, "0.1");
  CHECK_CONTAINS(ending.errors, "cell.xml:" + line_of(folder, "<tern") + ":");
  CHECK_CONTAINS(ending.errors, "did you mean 'turn'?");
  CHECK_CONTAINS(ending.errors, "nothing was started");
  // It is the engineer's to put right.
  CHECK(contents_of(folder / "cell.xml") == before);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(values_are_restored_at_the_next_start_and_nothing_else_is_written),
      CONTAINED_TEST(a_damaged_file_is_cited_and_the_previous_one_used),
      CONTAINED_TEST(a_changed_value_without_its_checksum_is_damage),
      CONTAINED_TEST(a_value_out_of_range_is_refused_with_its_place),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
