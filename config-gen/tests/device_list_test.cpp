// Devices that a list names are as those of rows in the table: to all that follows, and in groups.
#include <algorithm>
#include <cstring>
#include <iostream>
#include <variant>

#include "config-gen/read/parts.hpp"
#include "config-gen/tests/catalogue_case.hpp"
#include "config-gen/tests/find.hpp"
#include "config-gen/tests/tables.hpp"
#include "config-gen/tests/temporary_folder.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* rows_of_the_list = R"([device.stop_button]
interface = "DigitalLine"
drivers = ["simulated"]
on = "box"
configuration = { line = "ESTOP", active_low = true, levels = [0.5, 12], debounce = 0.02 }

[device.green_lamp]
interface = "DigitalLine"
drivers = ["simulated"]
on = "box"
configuration = { line = "7", direction = "output", debounce = 0.01 }
parameter.debounce = { label = "Filter time" }
)";

Files lines() {
  return files_in(fs::path(place::tests_folder) / "catalogue/base/lines");
}

Files without_list() {
  Files files = lines();
  std::string& table = files["cell.toml"];
  const std::size_t begin = table.find("[device_list.lines]");
  table.replace(begin, table.find("\n[unit.tower]") - begin, rows_of_the_list);
  files.erase("io_list.csv");
  return files;
}

class Cell {
 public:
  explicit Cell(const Files& files) {
    fs::copy(fs::path(place::tests_folder) / "base", folder_.path() / "base", fs::copy_options::recursive);
    fs::current_path(folder_.path());
    write_cell(files, "cell");
    diagnostics_ = judge_cell("cell", Stage::check, model_);
    if (diagnostics_.failed()) diagnostics_.print(std::cerr);
  }
  ~Cell() { fs::current_path("/"); }
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  const Model& model() const { return model_; }
  bool is_good() const { return diagnostics_.sorted().empty(); }
  std::vector<GeneratedFile> emitted() {
    return emit(model_, {Target::Kind::application, "cell/cell.toml"}, diagnostics_);
  }

 private:
  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  Model model_;
};

void all_that_is_made_is_the_same(void**) {
  std::vector<GeneratedFile> listed;
  {
    Cell cell(lines());
    assert_true(cell.is_good());
    listed = cell.emitted();
  }
  Cell cell(without_list());
  assert_true(cell.is_good());
  const std::vector<GeneratedFile> written = cell.emitted();
  assert_true(written.size() > 3);
  assert_int_equal(listed.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    assert_string_equal(listed[i].path.c_str(), written[i].path.c_str());
    assert_string_equal(listed[i].contents.c_str(), written[i].contents.c_str());
  }
}

// It says which units and drivers belong to the application, and which files that depends on.
void the_build_is_told_the_same(void**) {
  std::string written;
  {
    const Cell cell(without_list());
    written = list_parts(Target::Kind::application, "cell/cell.toml");
    assert_non_null(strstr(written.c_str(), "DigitalLine/simulated"));
  }
  const Cell cell(lines());
  assert_string_equal(list_parts(Target::Kind::application, "cell/cell.toml").c_str(),
                      (written + "list cell/io_list.csv\n").c_str());
  const auto& files = cell.model().files;
  assert_true(std::find(files.begin(), files.end(), fs::path("cell/io_list.csv")) != files.end());
}

void cells_are_read_as_their_parameter_asks(void**) {
  const Cell cell(lines());
  const auto value = [&](const char* device, std::size_t parameter) {
    return named(cell.model().devices, device).configuration[parameter];
  };
  assert_string_equal(std::get<std::string>(value("green_lamp", 0).value).c_str(), "7");
  assert_true(std::get<std::int64_t>(value("green_lamp", 1).value) == 1);
  assert_true(std::get<bool>(value("stop_button", 2).value));
  assert_true(std::get<double>(value("stop_button", 3).elements[1].value) == 12);
  assert_true(std::get<double>(value("stop_button", 4).value) == 0.02);
  // An empty cell: what the table says for all rows.
  assert_true(std::get<double>(value("green_lamp", 4).value) == 0.01);
}

// By a row as by a list; only what says so need not be there.
void a_device_need_not_be_there(void**) {
  Files written = without_list();
  std::string& table = written["cell.toml"];
  table.insert(table.find("[device.green_lamp]") - 1, "required = false\n");
  Files listed = lines();
  listed["io_list.csv"] = "name,line,direction,required\nstop_button,ESTOP,,false\ngreen_lamp,LAMP,output,\n";
  for (const Files& files : {written, listed}) {
    Cell cell(files);
    assert_true(cell.is_good());
    assert_false(named(cell.model().devices, "stop_button").required);
    assert_true(named(cell.model().devices, "green_lamp").required);
    std::size_t told = 0;
    for (const GeneratedFile& file : cell.emitted())
      if (file.contents.find(".required = false") != std::string::npos) ++told;
    assert_int_equal(told, 1);
  }
}

// Where the table names its list, in the list's order.
void devices_keep_the_order_of_the_table(void**) {
  Files files = lines();
  files["cell.toml"] +=
      "\n[device.last]\ninterface = \"DigitalLine\"\ndrivers = [\"simulated\"]\non = \"box\"\n";
  const Cell cell(files);
  const auto& devices = cell.model().devices;
  const char* const names[] = {"box", "stop_button", "green_lamp", "last"};
  assert_int_equal(devices.size(), std::size(names));
  for (std::size_t i = 0; i < std::size(names); ++i) assert_string_equal(devices[i].name.c_str(), names[i]);
}

void a_group_has_them_in_each_instance(void**) {
  Files files = lines();
  files["cell.toml"] =
      "summary = \"Two gates.\"\nmemory_budget = \"8 MiB\"\n[device.box]\ninterface = \"LineBox\"\ndrivers = "
      "[\"simulated\"]\n[group.gate]\ntable = \"gate\"\ncount = 2\n[thread.main]\ntrigger = { period = \"10 "
      "ms\" "
      "}\nunits = [\"gate[*].tower\"]\n";
  files["groups/gate.toml"] =
      "summary = \"One gate.\"\n[device_list.lines]\nfile = \"io_list.csv\"\ninterface = "
      "\"DigitalLine\"\ndrivers = "
      "[\"simulated\"]\non = \"box\"\n[unit.tower]\ntype = \"tower\"\ndevice.button = "
      "\"stop_button\"\ndevice.lamp = "
      "\"green_lamp\"\n";
  files["io_list.csv"] =
      "name,line,direction\r\nstop_button,GATE_${index}_STOP,\r\ngreen_lamp,LAMP,output\r\n";
  const Cell cell(files);
  assert_true(cell.is_good());
  const Model& model = cell.model();
  assert_int_equal(model.devices.size(), 5);
  const Device& button = named(model.devices, "gate[1].stop_button");
  assert_string_equal(std::get<std::string>(button.configuration[0].value).c_str(), "GATE_1_STOP");
  assert_true(named(model.units, "gate[1].tower").devices[1] ==
              index_of(model.devices, "gate[1].green_lamp"));
}

}  // namespace
}  // namespace flexrf::config_gen::tests

int main() {
  using namespace flexrf::config_gen::tests;
  const CMUnitTest tests[] = {cmocka_unit_test(all_that_is_made_is_the_same),
                              cmocka_unit_test(the_build_is_told_the_same),
                              cmocka_unit_test(cells_are_read_as_their_parameter_asks),
                              cmocka_unit_test(a_device_need_not_be_there),
                              cmocka_unit_test(devices_keep_the_order_of_the_table),
                              cmocka_unit_test(a_group_has_them_in_each_instance)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
