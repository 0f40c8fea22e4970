// The command line: what drivers and who observes declare is parsed, checked, listed and handed to them.
#include "runtime/executive/options.hpp"

#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "runtime/executive/driver_choice.hpp"
#include "runtime/executive/file_options.hpp"
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::options_test {
namespace {

using Cell = ProducerAndConsumer;

constexpr Option driver_options[] = {
    {.name = "--level",
     .kind = OptionKind::number,
     .value = "NUMBER",
     .summary = "How much.",
     .unit = "V",
     .least = 0,
     .most = 5},
    {.name = "--loud", .kind = OptionKind::flag, .value = nullptr, .summary = "Say so.", .chooses = true},
    {.name = "--recording", .kind = OptionKind::file, .value = "FILE", .summary = "What to play."},
    {.name = "--traces", .kind = OptionKind::folder, .value = "FOLDER", .summary = "Where traces go."},
    {.name = "--trace", .kind = OptionKind::output_file, .value = "FILE", .summary = "Where one goes."},
};

constexpr Option observer_options[] = {
    {.name = "--watch", .kind = OptionKind::text, .value = "NAME", .summary = "What to watch."}};
Result<bool> is_wanted(const Options& options) {
  const char* const what = options.values().text("--watch", "all");
  if (std::strcmp(what, "nothing") == 0)
    return Status::error(StatusCode::invalid_argument, "--watch nothing: leave it away");
  return std::strcmp(what, "all") == 0;
}
constexpr ObserverPart observer{"Watcher", observer_options, &is_wanted, nullptr};

/// Arguments that live as long as the options that are made of them.
class Words {
 public:
  Words(std::initializer_list<const char*> words) : texts_{"cell"} {
    texts_.insert(texts_.end(), words.begin(), words.end());
    for (std::string& text : texts_) pointers_.push_back(text.data());
  }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  Result<Options> parse(const Application& application, const ObserverPart* part = nullptr) {
    return parse_options(application, part, static_cast<int>(pointers_.size()), pointers_.data());
  }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

/// Whose actuator has a driver with options.
class CellWithOptions : public Cell {
 public:
  CellWithOptions() { device(actuator).options = driver_options; }
};

void check_refused(Words words, const char* cause, const ObserverPart* part = nullptr) {
  CellWithOptions cell;
  const Result<Options> options = words.parse(cell.application(), part);
  CHECK(!options);
  CHECK_CONTAINS(options.status().cause(), cause);
}

void a_driver_has_its_values_before_it_is_initialised() {
  CellWithOptions cell;
  Words words{"--level", "0.5", "--virtual-time", "1s", "--level=0.7", "--loud"};
  const Result<Options> options = words.parse(cell.application());
  CHECK(options);
  Executive executive(cell.application(), *options);
  CHECK(executive.prepare());
  const OptionValues values = cell.device_state(Cell::actuator).environment.options;
  CHECK(values.number("--level") == 0.7);
  CHECK(values.has("--loud"));
  CHECK(values.text("--recording") == nullptr);
}

void a_value_that_does_not_fit_is_refused() {
  check_refused({"--level", "6"}, "--level 6: give a number from 0 to 5, in V");
  check_refused({"--level"}, "--level needs a value: NUMBER");
  check_refused({"--level="}, "--level needs a value: NUMBER");
  check_refused({"--loud=yes"}, "--loud takes no value");
}

void the_nearest_of_all_is_suggested() {
  check_refused({"--leval", "1"}, "unknown argument `--leval`; did you mean `--level`?");
  check_refused({"--wacht", "x"}, "unknown argument `--wacht`; did you mean `--watch`?", &observer);
  check_refused({"--confg", "x"}, "unknown argument `--confg`; did you mean `--config`?");
}

void what_nobody_declares_is_unknown() {
  check_refused({"--watch", "x"}, "unknown argument `--watch`");
  Cell without;
  Words words{"--level", "1"};
  const Result<Options> options = words.parse(without.application());
  CHECK(!options);
  CHECK_CONTAINS(options.status().cause(), "unknown argument `--level`");
}

void who_observes_says_whether_he_is_wanted() {
  CellWithOptions cell;
  CHECK(Words{}.parse(cell.application(), &observer)->observed);
  CHECK(!Words{}.parse(cell.application())->observed);
  Words other{"--watch", "another"};
  CHECK(!other.parse(cell.application(), &observer)->observed);
  check_refused({"--watch", "nothing"}, "--watch nothing: leave it away", &observer);
}

void help_lists_each_group_once() {
  CellWithOptions cell;
  Application application = cell.application();
  const DeviceRecord two[] = {application.devices[0], application.devices[0]};
  application.devices = two;
  const std::string text = usage(application, &observer);
  const std::size_t own = text.find("\nApplication:\n  --hardware CHOICE ");
  const std::size_t watcher = text.find("\nWatcher:\n  --watch NAME ");
  const std::size_t driver = text.find("\nDriver `mock` of Actuator:\n  --level NUMBER ");
  CHECK(own != std::string::npos && watcher != std::string::npos && driver != std::string::npos);
  CHECK(own < watcher && watcher < driver);
  CHECK(text.find("--level", driver + 40) == std::string::npos);
}

/// Which driver the actuator has, as --drivers says it: "usual" without options, "other" with them.
std::string chosen_by(Words words) {
  CellWithOptions cell;
  Application application = cell.application();
  DeviceRecord device = application.devices[0];
  DriverRecord drivers[] = {device.drivers[0], device.drivers[0]};
  drivers[0].name = "usual";
  drivers[0].options = {};
  drivers[1].name = "other";
  device.drivers = drivers;
  application.devices = {&device, 1};
  const Result<Options> options = words.parse(application);
  CHECK(options);
  const auto chosen = choose_drivers(application, *options);
  CHECK(chosen);
  Executive executive(application, *options);
  CHECK(executive.prepare());
  CHECK(cell.device_state(Cell::actuator).driver == chosen->at(0));
  return hardware_text(application, *chosen);
}

void an_option_that_chooses_its_driver_yields_to_hardware() {
  CHECK_EQUAL(chosen_by({"--virtual-time", "1s"}), "actuator=usual");
  CHECK_EQUAL(chosen_by({"--virtual-time", "1s", "--level", "1"}), "actuator=usual");
  CHECK_EQUAL(chosen_by({"--virtual-time", "1s", "--loud"}), "actuator=other");
  CHECK_EQUAL(chosen_by({"--virtual-time", "1s", "--hardware", "actuator=usual", "--loud"}),
              "actuator=usual");
}

/// With a pipe, a folder and a file in it; the current one.
class Folder {
 public:
  Folder() {
    char name[] = "/tmp/flexrf_options_XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(path_);
    CHECK(mkfifo("pipe", 0600) == 0 && mkdir("folder", 0700) == 0);
    std::ofstream("file") << "content";
  }
  ~Folder() {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

 private:
  std::filesystem::path path_;
  std::filesystem::path before_;
};

std::string told_of(Words words) {
  CellWithOptions cell;
  const Result<Options> options = words.parse(cell.application());
  CHECK(options);
  return check_file_options(*options).cause();
}

void a_drivers_files_are_looked_at_before_the_start() {
  const Folder folder;
  CHECK_EQUAL(told_of({"--recording", "file", "--traces", "folder", "--trace", "folder/new"}), "");
  CHECK_EQUAL(told_of({"--recording", "pipe"}), "--recording pipe: it is a pipe; name a file");
  CHECK_EQUAL(told_of({"--recording", "folder"}), "--recording folder: it is a folder; name a file");
  CHECK_EQUAL(told_of({"--recording", "none"}), "--recording none: No such file or directory");
  CHECK_EQUAL(told_of({"--trace", "pipe"}), "--trace pipe: it is a pipe; name a file");
  CHECK_EQUAL(told_of({"--trace", "none/new"}), "--trace none/new: there is no folder 'none'; make it first");
  CHECK_EQUAL(told_of({"--traces", "none"}), "--traces none: there is no folder 'none'; make it first");
  CHECK_EQUAL(told_of({"--traces", "file"}), "--traces file: there is no folder 'file'; make it first");
}

void a_report_is_no_file_of_a_driver() {
  const Folder folder;
  CHECK_EQUAL(told_of({"--report", "./file", "--recording", "file"}),
              "--report ./file: this is the file of --recording; name another");
  CHECK_EQUAL(told_of({"--report", "new", "--trace", "new"}),
              "--report new: this is the file of --trace; name another");
}

}  // namespace
}  // namespace flexrf::fixture::options_test

int main() {
  using namespace flexrf::fixture::options_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_driver_has_its_values_before_it_is_initialised),
      CONTAINED_TEST(a_value_that_does_not_fit_is_refused),
      CONTAINED_TEST(the_nearest_of_all_is_suggested),
      CONTAINED_TEST(what_nobody_declares_is_unknown),
      CONTAINED_TEST(who_observes_says_whether_he_is_wanted),
      CONTAINED_TEST(help_lists_each_group_once),
      CONTAINED_TEST(an_option_that_chooses_its_driver_yields_to_hardware),
      CONTAINED_TEST(a_drivers_files_are_looked_at_before_the_start),
      CONTAINED_TEST(a_report_is_no_file_of_a_driver),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
