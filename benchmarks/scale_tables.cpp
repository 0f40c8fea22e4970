#include "benchmarks/scale_tables.hpp"

#include <filesystem>
#include <fstream>

#include "benchmarks/harness.hpp"

namespace flexrf::bench {
namespace {

constexpr int kinds = 5;

bool write(const std::filesystem::path& file, const std::string& contents) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  std::ofstream stream{file};
  stream << contents;
  stream.close();
  return static_cast<bool>(stream);
}

std::string type_table(int kind) {
  return text(R"(summary = "What units of kind %d pass on."

[field.value]
type = "f64"
shape = [%d]
unit = "m"
summary = "A value."

[field.count]
type = "u32"
summary = "A count."
)",
              kind, kind + 1);
}

std::string unit_table(int kind, int outputs) {
  std::string table = text(R"(summary = "A stage of kind %d."

[input.before]
type = "Item%d"
summary = "From the stage before."
)",
                           kind, (kind + kinds - 1) % kinds);
  for (int output = 0; output < outputs; ++output) {
    table += text("\n[output.out_%d]\ntype = \"Item%d\"\nsummary = \"Output %d.\"\n", output, kind, output);
  }
  return table + R"(
[configuration.offset]
type = "f64"
unit = "m"
default = 0.5
summary = "Added to the value."

[runtime.gain]
type = "f64"
unit = "1"
range = [0.0, 10.0]
default = 1.0
summary = "Multiplies the value."

[feedback.steps]
type = "u64"
summary = "Steps so far."
)";
}

std::string unit_header(int kind, int outputs) {
  std::string header = text(R"(#pragma once

#include "stage_%d_unit.hpp"

namespace flexrf::user {

class Stage%d final : public Stage%dUnit {
 public:
  void step(const Tick&) override {
    Item%d item{};
    if (const auto last = before.latest()) item.count = last->count + 1;
    item.value[0] = configuration.offset * runtime.gain;
)",
                            kind, kind, kind, kind);
  for (int output = 0; output < outputs; ++output) header += text("    out_%d.publish(item);\n", output);
  return header + "    ++feedback.steps;\n  }\n};\n\n}  // namespace flexrf::user\n";
}

std::string application_table(int units, int outputs) {
  std::string table = "summary = \"Many units of few types.\"\nmemory_budget = \"64 MiB\"\n";
  std::string names;
  for (int unit = 0; unit < units; ++unit) {
    table += text("\n[unit.u%d]\ntype = \"stage_%d\"\nin.before = \"s%d_0\"\n", unit, unit % kinds,
                  (unit + units - 1) % units);
    for (int output = 0; output < outputs; ++output) {
      table += text("out.out_%d = \"s%d_%d\"\n", output, unit, output);
    }
    table += "budget = \"1 us\"\n";
    names += text("%s\"u%d\"", unit == 0 ? "" : ", ", unit);
  }
  return table +
         "\n[thread.control]\ntrigger = { period = \"10 ms\" }\npriority = 40\nrole = \"control\"\nunits = "
         "[" +
         names + "]\n";
}

}  // namespace

bool write_scale_tables(const std::string& folder, int units, int outputs) {
  const std::filesystem::path root{folder};
  bool written = write(root / "scale.toml", application_table(units, outputs));
  written = write(root / "CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(scale LANGUAGES CXX)\n"
                  "find_package(FlexRF REQUIRED)\nflexrf_add_application(NAME scale)\n") &&
            written;
  for (int kind = 0; kind < kinds; ++kind) {
    const std::string stage = text("stage_%d", kind);
    written = write(root / "types" / text("item_%d.toml", kind), type_table(kind)) && written;
    written = write(root / "units" / stage / (stage + ".toml"), unit_table(kind, outputs)) && written;
    written = write(root / "units" / stage / (stage + ".hpp"), unit_header(kind, outputs)) && written;
  }
  return written;
}

}  // namespace flexrf::bench
