// bench_summary FOLDER NAME...: one table of what the benchmarks wrote into FOLDER/NAME.json. Prints it, and
// writes FOLDER/results.json and, for the documentation, FOLDER/results.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/text_table.hpp"
#include "benchmarks/harness.hpp"

namespace flexrf::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Three significant digits, as far as they are there.
std::string number(double value) {
  const double size = std::fabs(value);
  if (size >= 100 || size == std::floor(size)) return text("%.0f", value);
  return text(size >= 10 ? "%.1f" : size >= 1 ? "%.2f" : "%.3f", value);
}

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? number(value) : number(value) + " " + unit;
}

struct Line {
  std::string what, ours, floor, measured, interval, goal, met;
};

Line line_of(const Json& row) {
  Line line;
  const auto unit = row.value("unit", "");
  const auto low = row.value("low", 0.0);
  const auto high = row.value("high", 0.0);
  line.what = row.value("what", "");
  line.ours = row.value("ours", "");
  // Nanoseconds of one machine say little on another: multiples of its exchange and load stand beside them.
  if (const auto note = row.value("note", ""); note.find(" exchanges, ") != std::string::npos)
    line.ours = note;
  line.floor = row.value("floor", "");
  line.measured = with_unit(row.value("median", 0.0), unit);
  if (number(low) != number(high)) line.interval = number(low) + " - " + number(high);
  if (row.contains("goal")) {
    line.goal = (row.value("at_least", false) ? ">= " : "<= ") + with_unit(row.value("goal", 0.0), unit);
    line.met = row.value("met", false) ? "met" : "missed";
  }
  return line;
}

/// What the rows were measured on: one line, unless they stem from different machines or days.
std::vector<std::string> conditions_of(const Json& results) {
  std::vector<std::string> lines;
  for (const Json& result : results) {
    const auto machine = result.value("machine", "");
    std::string line = result.value("date", "") + ", " + machine.substr(0, machine.rfind(", load"));
    if (result.value("quick", false)) line += ", short blocks (FLEXRF_BENCH_SHORT)";
    if (!result.value("settled", true))
      line += ", threads not pinned or not SCHED_FIFO: the right is missing";
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

std::string markdown(const std::vector<std::string>& conditions, const std::vector<Line>& lines,
                     const std::vector<std::string>& remarks) {
  std::string result;
  for (const std::string& line : conditions) result += line + "\n\n";
  for (const bool judged : {true, false}) {
    if (!judged) result += "\nBeside these, without a goal:\n\n";
    result += judged ? "| what | ours | floor | ratio or value | 95 % interval | goal | |\n| --- | --- | --- "
                       "| --- | --- | --- | --- |\n"
                     : "| what | value | 95 % interval |\n| --- | --- | --- |\n";
    for (const Line& line : lines) {
      if (line.goal.empty() == judged) continue;
      result += judged ? "| " + line.what + " | " + line.ours + " | " + line.floor + " | " + line.measured +
                             " | " + line.interval + " | " + line.goal + " | " + line.met + " |\n"
                       : "| " + line.what + " | " + line.measured + " | " + line.interval + " |\n";
    }
  }
  if (!remarks.empty()) result += "\nOf these, one by one:\n\n";
  for (const std::string& remark : remarks) result += "- " + remark + "\n";
  return result;
}

std::string plain(const std::vector<std::string>& conditions, const std::vector<Line>& lines) {
  std::string result;
  for (const std::string& line : conditions) result += line + "\n";
  TextTable table{{"<what", "ours", "floor", "ratio or value", "95 % interval", "goal", "<"}};
  for (const Line& line : lines) {
    table.add({line.what, line.ours, line.floor, line.measured, line.interval, line.goal, line.met});
  }
  return result + table.text("  ");
}

bool write(const std::string& file, const std::string& contents) {
  std::ofstream stream{file};
  stream << contents;
  stream.close();
  if (!stream) std::fprintf(stderr, "bench_summary: cannot write '%s'\n", file.c_str());
  return static_cast<bool>(stream);
}

int run(int argument_count, char** arguments) {
  if (argument_count < 3) {
    std::fprintf(stderr, "usage: bench_summary FOLDER NAME...\n");
    return 1;
  }
  const std::string folder = arguments[1];
  Json results = Json::array();
  std::vector<Line> lines;
  std::vector<std::string> remarks;
  for (int i = 2; i < argument_count; ++i) {
    std::ifstream file{folder + "/" + arguments[i] + ".json"};
    const Json result = file ? Json::parse(file, nullptr, false) : Json{};
    if (!result.contains("rows")) {
      lines.push_back({std::string{arguments[i]} + ": no result", "", "", "", "", "", ""});
      continue;
    }
    for (const Json& row : result["rows"]) lines.push_back(line_of(row));
    for (const Json& remark : result.value("remarks", Json::array())) remarks.push_back(remark);
    results.push_back(result);
  }
  const std::vector<std::string> conditions = conditions_of(results);
  std::fputs(plain(conditions, lines).c_str(), stdout);
  const bool written = write(folder + "/results.json", results.dump(2) + "\n");
  return write(folder + "/results.md", markdown(conditions, lines, remarks)) && written ? 0 : 1;
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
