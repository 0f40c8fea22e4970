// flexrf-doctor: says what this machine has and lacks for real time, and how to mend it. Changes nothing.

#include <cstdio>
#include <string>

#include "base/json_writer.hpp"
#include "base/standard_descriptors.hpp"
#include "runtime/realtime/doctor/checks.hpp"
#include "runtime/realtime/machine_file.hpp"

namespace {

using flexrf::doctor::Finding;
using flexrf::doctor::Verdict;

constexpr const char* usage =
    "flexrf-doctor [--json] [--root DIR]\n"
    "Says what this machine has and lacks for real time, and how to mend it. Changes nothing.\n"
    "  --json      the same as JSON\n"
    "  --root DIR  looks at DIR/proc, DIR/sys, DIR/etc, DIR/dev in place of the machine's\n"
    "Exit code: 0; 3 when real-time threads cannot be started at all; 1 wrong usage.\n";

void print_text(const std::vector<Finding>& findings) {
  int lacking = 0;
  for (const Finding& finding : findings) {
    std::printf("%-8s %s: %s\n", name_of(finding.verdict), finding.check.c_str(), finding.found.c_str());
    if (finding.verdict == Verdict::ok) continue;
    ++lacking;
    std::printf("           means: %s\n           mend:  %s\n", finding.meaning.c_str(),
                finding.remedy.c_str());
  }
  if (lacking == 0)
    std::puts("Nothing is lacking.");
  else
    std::printf("Lacking: %d of %zu.\n", lacking, findings.size());
}

void print_json(const std::vector<Finding>& findings) {
  flexrf::JsonWriter writer;
  writer.begin_array();
  for (const Finding& finding : findings) {
    writer.begin_object();
    writer.member("verdict", name_of(finding.verdict));
    writer.member("check", finding.check);
    writer.member("found", finding.found);
    writer.member("meaning", finding.meaning);
    writer.member("remedy", finding.remedy);
    writer.end_object();
  }
  writer.end_array();
  std::fputs(writer.take().c_str(), stdout);
}

}  // namespace

int main(int argument_count, char** arguments) {
  flexrf::hold_standard_descriptors();
  bool as_json = false;
  std::string root;
  for (int i = 1; i < argument_count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--json") {
      as_json = true;
    } else if (argument == "--root" && i + 1 < argument_count) {
      root = arguments[++i];
    } else if (argument == "--help") {
      std::fputs(usage, stdout);
      return 0;
    } else {
      std::fprintf(stderr, "flexrf-doctor: unexpected '%s'\n%s", argument.c_str(), usage);
      return 1;
    }
  }
  const std::vector<Finding> findings =
      flexrf::doctor::examine(flexrf::doctor::SystemFiles(root), flexrf::MachineFile::default_path);
  as_json ? print_json(findings) : print_text(findings);
  for (const Finding& finding : findings)
    if (finding.verdict == Verdict::missing) return 3;
  return 0;
}
