// Values of a driver's own, beside its interface's: where they lie, who is told of them, and how they are
// kept.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>

#include "base/quantity_text.hpp"
#include "drivers/metering_station/metering_station.hpp"
#include "drivers/mock_station/mock_station.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/face/change.hpp"
#include "runtime/face/component_values.hpp"
#include "tests/generator/in_a_process.hpp"

// CMocka's macros would change what the headers above declare.
#include "tests/cmocka.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace {

using namespace flexrf;
using namespace flexrf::user;
const Application& cell = flexrf::application::application;

const SlotRecord& slot_named(const char* name) {
  for (const SlotRecord& one : cell.slots)
    if (std::strcmp(one.name, name) == 0) return one;
  std::abort();
}

const DeviceRecord& station() {
  for (const DeviceRecord& one : cell.devices)
    if (std::strcmp(one.name, "station") == 0) return one;
  std::abort();
}

Options options(const char* driver, const std::string& file = "") {
  Options made;
  made.hardware = {{"station", driver}};
  made.virtual_time = std::chrono::seconds{1};
  made.configuration_file = file;
  made.audit_file = "off";
  made.digest = true;
  return made;
}

/// What was published last in a device's slot; empty: nothing.
std::string last_in(const char* slot) {
  SlotReader& observer = *slot_named(slot).observer;
  if (observer.newest() == nullptr) return "";
  return {reinterpret_cast<const char*>(observer.payload()), slot_named(slot).control->type()->size};
}

template <class Values>
Values as(const std::string& bytes) {
  Values values{};
  if (bytes.size() == sizeof(values)) std::memcpy(static_cast<void*>(&values), bytes.data(), sizeof(values));
  return values;
}

class Folder {
 public:
  Folder() {
    char name[] = "/tmp/flexrf_driver_values_XXXXXX";
    folder_ = ::mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(folder_); }
  std::string file() const { return folder_ + "/config.xml"; }
  void write(const std::string& devices) const {
    std::ofstream(file()) << "<flexrf application=\"generated_cell\" format=\"1\" checksum=\"edited\">"
                          << devices << "</flexrf>\n";
  }
  std::string read() const {
    std::ifstream stream(file());
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

 private:
  std::string folder_;
};

bool holds(const std::string& text, const char* part) {
  if (text.find(part) != std::string::npos) return true;
  print_error("'%s' is not in: %s\n", part, text.c_str());
  return false;
}

// ---- where they lie

void what_a_driver_has_of_its_interface_comes_first(void**) {
  MeteringStation metering;
  const ParameterMemory memory = metering.parameter_memory();
  auto& all = *static_cast<MeteringStationFeedback*>(memory.feedback);
  auto& shared = *static_cast<StationFeedback*>(memory.feedback);
  assert_ptr_equal(&all.transfers, &shared.transfers);
  Station& station = metering;
  station.count_transfer();
  assert_int_equal(all.transfers, 1);
  all.online = true;
  assert_true(shared.online);
  // What writes the interface's as a whole leaves the driver's alone, also where the former ends in padding.
  all.overflows = 7;
  all.metered = true;
  station.forget();
  assert_int_equal(all.transfers, 0);
  assert_int_equal(all.overflows, 7);
  assert_true(all.metered);
  static_cast<MeteringStationRuntime*>(memory.runtime)->setpoint = 2;
  static_cast<MeteringStationRuntime*>(memory.runtime)->trim = 0.5;
  assert_true(station.output() == 2.5);
}

void its_type_begins_as_its_interfaces(void**) {
  const ComponentType& own = *station().drivers[1].type;
  const ComponentType& common = *station().drivers[0].type;
  for (const auto& [all, first, count] :
       {std::tuple{&own.runtime, &common.runtime, 4}, {&own.feedback, &common.feedback, 5}}) {
    assert_int_equal(all->parameters.size(), count);
    for (std::size_t i = 0; i < first->parameters.size(); ++i) {
      assert_string_equal(all->parameters[i].field->name, first->parameters[i].field->name);
      assert_int_equal(all->parameters[i].field->offset, first->parameters[i].field->offset);
    }
    assert_true(all->parameters[first->parameters.size()].field->offset >= first->type->size);
  }
  assert_int_equal(own.feedback.type->size, sizeof(MeteringStationFeedback));
  assert_int_equal(common.feedback.type->size, sizeof(StationFeedback));
  const auto& initial = *static_cast<const MeteringStationRuntime*>(station().drivers[1].runtime);
  assert_true(initial.setpoint == 5.0 && initial.trim == 0.5 && !initial.settles);
  assert_int_equal(own.runtime.parameters[3].needs.size(), 2);  // of its own, and of its interface's
}

void both_may_refuse(void**) {
  MeteringStation metering;
  MeteringStationRuntime proposed;
  proposed.setpoint = 6.5;
  assert_string_equal(metering.accept_runtime(&proposed).cause(), "at 6.5 V its line rings");
  proposed.setpoint = 9.5;
  proposed.trim = 0.75;
  assert_string_equal(metering.accept_runtime(&proposed).cause(), "with its trim it puts out more than 10 V");
  proposed.trim = 0.25;
  assert_true(metering.accept_runtime(&proposed).is_ok());
}

// ---- who is told of them

std::string seen_with(const char* driver, const std::string& file = "") {
  return in_a_process([&] {
    Executive executive(cell, options(driver, file));
    if (const Status status = executive.prepare(); !status) return std::string(status.cause());
    const RunSummary summary = executive.run();
    const auto feedback = as<MeteringStationFeedback>(last_in("station.feedback"));
    const auto values = as<MeteringStationRuntime>(last_in("station.values"));
    return std::string(slot_named("station.feedback").control->type()->name) + " of " +
           std::to_string(last_in("station.feedback").size()) + ", sum " +
           std::to_string(feedback.sum / feedback.transfers) + ", trim " + std::to_string(values.trim) +
           ", digest " + hexadecimal_text(summary.digest.value_or(0));
  });
}

void its_slots_carry_what_the_chosen_driver_has(void**) {
  static std::string seen;
  seen = seen_with("metering");
  assert_true(holds(seen, "MeteringStationFeedback of 24, sum 5.5"));
  assert_true(holds(seen, "trim 0.5"));
  seen = seen_with("mock");
  assert_true(holds(seen, "StationFeedback of 8,"));
}

// Of the sum nothing else tells.
void the_digest_counts_them(void**) {
  static std::string first, again, other;
  static const Folder folder;
  folder.write(
      "<device name=\"station\" driver=\"metering\"><runtime><settles>true</settles></runtime></device>");
  first = seen_with("metering");
  again = seen_with("metering");
  other = seen_with("metering", folder.file());
  assert_string_equal(first.c_str(), again.c_str());
  assert_string_not_equal(first.substr(first.find("digest")).c_str(),
                          other.substr(other.find("digest")).c_str());
}

std::string refusal_of(const char* driver, const char* text) {
  return in_a_process([&] {
    Executive executive(cell, options(driver));
    if (const Status status = executive.prepare(); !status) return std::string(status.cause());
    const Directory directory(executive.cell());
    JsonReader reader;
    ParameterRequest request;
    Role role = Role::viewer;
    const auto refusal = add_values(directory.entry(station().index), *reader.object(text), request, role);
    if (!refusal) return std::string("taken");
    return std::to_string(static_cast<int>(refusal->kind())) + ": " + refusal->detail();
  });
}

void what_belongs_to_another_driver_is_refused_with_the_reason(void**) {
  static std::string told;
  told = refusal_of("metering", R"({"trim": 0.125})");
  assert_string_equal(told.c_str(), "taken");
  told = refusal_of("mock", R"({"trim": 0.125})");
  assert_int_equal(told.front() - '0', static_cast<int>(RefusalKind::wrong_state));
  assert_true(
      holds(told,
            "station.trim is not there: the driver is 'mock'; this belongs to 'metering'; a driver is "
            "chosen at the start, as --hardware station=metering"));
  told = refusal_of("mock", R"({"trimm": 0.125})");
  assert_int_equal(told.front() - '0', static_cast<int>(RefusalKind::not_found));
  told = refusal_of("metering", R"({"trim": 0.8})");  // of the narrower range
  assert_true(holds(told, "station.trim is refused"));
}

// ---- how they are kept

void they_are_kept_under_their_driver(void**) {
  static std::string told;
  static const Folder folder;
  folder.write(
      "<device name=\"station\" "
      "driver=\"metering\"><runtime><settles>true</settles><trim>0.25</trim></runtime>"
      "</device>");
  told = seen_with("metering", folder.file());
  // What it sets itself is in force, and what a person set stays in the file.
  assert_true(holds(told, "trim 0.125"));
  const std::string section = "<device name=\"station\" driver=\"metering\">";
  told = folder.read();
  assert_true(holds(told, section.c_str()) && holds(told, "<trim unit=\"V\">0.25</trim>"));
  // Another driver neither takes nor loses them.
  assert_true(holds(seen_with("mock", folder.file()), "StationFeedback of 8,"));
  told = folder.read();
  assert_true(holds(told, section.c_str()) && holds(told, "<trim unit=\"V\">0.25</trim>"));
}

void a_value_that_the_driver_has_not_is_told(void**) {
  static std::string told;
  static const Folder folder;
  folder.write("<device name=\"station\" driver=\"metering\"><runtime><trimm>0.5</trimm></runtime></device>");
  told = seen_with("metering", folder.file());
  assert_true(told.find("digest") == std::string::npos);
  folder.write("<device name=\"station\" driver=\"mock\"><runtime><trim>0.5</trim></runtime></device>");
  told = seen_with("mock", folder.file());
  assert_true(told.find("digest") == std::string::npos);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(what_a_driver_has_of_its_interface_comes_first),
                              cmocka_unit_test(its_type_begins_as_its_interfaces),
                              cmocka_unit_test(both_may_refuse),
                              cmocka_unit_test(its_slots_carry_what_the_chosen_driver_has),
                              cmocka_unit_test(the_digest_counts_them),
                              cmocka_unit_test(what_belongs_to_another_driver_is_refused_with_the_reason),
                              cmocka_unit_test(they_are_kept_under_their_driver),
                              cmocka_unit_test(a_value_that_the_driver_has_not_is_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
