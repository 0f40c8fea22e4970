// A configuration file that was saved when a unit and its parameter had other names.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::rename_test {
namespace {

/// What is in the file after a run that found the old names in it.
std::string saved_by_a_run(std::span<const Rename> renames) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("flexrf_rename_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "cell.xml";
  std::ofstream(file)
      << "<flexrf application=\"test_cell\" format=\"1\" descriptor=\"999\">\n"
         "  <unit name=\"maker\"><runtime><amplification>2.5</amplification></runtime></unit>\n"
         "</flexrf>\n";
  {
    ProducerAndConsumer cell;
    cell.renames = renames;
    Options options = in_virtual_time(std::chrono::milliseconds{10});
    options.configuration_file = file.string();
    Executive executive(cell.application(), options);
    run_to_the_end(executive);
  }
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::filesystem::remove_all(folder);
  return text;
}

void values_saved_under_old_names_are_kept() {
  static constexpr Rename renames[] = {{"maker", "producer"}, {"maker.amplification", "producer.gain"}};
  const std::string text = saved_by_a_run(renames);
  CHECK(text.find("name=\"producer\"") != std::string::npos);
  CHECK(text.find(">2.5</gain>") != std::string::npos);
  CHECK(text.find("maker") == std::string::npos);
}

void without_renames_they_are_left_out() {
  const std::string text = saved_by_a_run({});
  CHECK(text.find("checksum=") != std::string::npos);
  CHECK(text.find("2.5") == std::string::npos);
  CHECK(text.find("producer") == std::string::npos);
}

}  // namespace
}  // namespace flexrf::fixture::rename_test

int main() {
  using namespace flexrf::fixture::rename_test;
  const CMUnitTest tests[] = {CONTAINED_TEST(values_saved_under_old_names_are_kept),
                              CONTAINED_TEST(without_renames_they_are_left_out)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
