// The generated application says what its tables say, and runs.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "drivers/mock_station/mock_station.hpp"
#include "places.hpp"
#include "runtime/core/digest.hpp"
#include "runtime/run/run_application.hpp"
#include "tests/cmocka.hpp"
#include "types/everything.hpp"
#include "types/named_as_helpers.hpp"
#include "types/picture.hpp"
#include "types/text_named_text.hpp"
#include "types/thumbnail.hpp"
#include "units/source/source.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace {

using namespace flexrf;
using namespace flexrf::user;
const Application& cell = flexrf::application::application;

template <class Row>
const Row& row(std::span<const Row> rows, const char* name) {
  for (const Row& one : rows) {
    if (std::strcmp(one.name, name) == 0) return one;
  }
  fail_msg("there is no %s", name);
  return rows.front();
}

const FieldDescriptor& field(const TypeDescriptor& type, const char* name) {
  return row(type.fields, name);
}

void tables_hold_every_row_in_order(void**) {
  const char* units[] = {"source",   "worker[0]",    "worker[1]",   "worker[2]",
                         "overview", "axis[0].lift", "axis[1].lift"};
  assert_int_equal(cell.units.size(), std::size(units));
  for (std::size_t i = 0; i < std::size(units); ++i) assert_string_equal(cell.units[i].name, units[i]);
  assert_int_equal(cell.populations.size(), 1);
  assert_int_equal(cell.populations[0].first_unit, 1);
  assert_int_equal(cell.populations[0].capacity, 3);
  assert_int_equal(cell.populations[0].active, 2);
  assert_int_equal(cell.units[3].member, 2);
  assert_true(row(cell.units, "overview").restart == RestartPolicy::once);
}

void what_units_and_devices_share_stands_in_their_records(void**) {
  const ComponentRecord& source = cell.component(0);
  assert_string_equal(source.kind, "unit");
  assert_int_equal(source.level, level_unit);
  assert_int_equal(source.population, no_index);
  const DeviceRecord& station = row(cell.devices, "station");
  assert_string_equal(station.kind, "device");
  const DeviceRecord& line = cell.devices[station.bus];
  assert_int_equal(station.level, level_carried + 1);
  assert_int_equal(line.level, level_carried);
  assert_int_equal(cell.devices[line.bus].level, level_base);
  assert_true(station.stop_timeout == station.initialise_timeout);
  assert_int_equal(station.population, no_index);
  for (ComponentIndex i = 0; i < cell.component_count(); ++i) assert_int_equal(cell.component(i).index, i);
  assert_ptr_equal(&cell.component(station.index), static_cast<const ComponentRecord*>(&station));
}

void a_thread_is_as_its_row_says(void**) {
  const ThreadRecord& control = row(cell.threads, "control");
  assert_true(control.trigger.kind == TriggerKind::period);
  assert_int_equal(control.trigger.period.count(), 5'000'000);
  assert_int_equal(control.trigger.phase.count(), 1'000'000);
  assert_int_equal(control.priority, 30);
  assert_true(control.overrun == OverrunPolicy::catch_up && control.limit.leaky);
  assert_int_equal(control.limit.limit, 5);
  assert_int_equal(control.budget.count(), 40'000);
  assert_int_equal(control.units.size(), 2);
  // Buses before what they carry.
  assert_int_equal(control.devices.size(), 3);
  assert_string_equal(cell.devices[control.devices[0]].name, "trunk");
  assert_string_equal(cell.devices[control.devices[1]].name, "line");
  assert_int_equal(reinterpret_cast<std::uintptr_t>(control.stack) % page, 0);
  assert_int_equal(control.stack_size, 256 * 1024 + page);
  const ThreadRecord& work = row(cell.threads, "work");
  assert_int_equal(work.trigger.sources.size(), 1);
  assert_non_null(work.trigger.sources[0].queue);
}

void a_queue_of_jobs_has_one_source_for_all(void**) {
  const QueueRecord& jobs = row(cell.queues, "jobs");
  assert_int_equal(jobs.capacity, 8);
  assert_int_equal(jobs.sinks.size(), 1);
  assert_int_equal(jobs.sources.size(), 3);
  assert_ptr_equal(jobs.sources[0], jobs.sources[2]);
  assert_string_equal(jobs.readers[1], "worker[1].jobs");
}

void inputs_find_their_readers(void**) {
  const UnitRecord& overview = row(cell.units, "overview");
  assert_int_equal(overview.binding.inputs.size(), 5);
  const InputBinding& places = overview.binding.inputs[0];
  assert_int_equal(places.count, 3);
  for (std::uint32_t i = 0; i < places.count; ++i) {
    const std::string name = "places[" + std::to_string(i) + "]";
    assert_ptr_equal(places.readers[i].slot(), row(cell.slots, name.c_str()).control);
  }
  const InputBinding& sample = overview.binding.inputs[1];
  const InputBinding& kept = overview.binding.inputs[2];
  assert_ptr_equal(sample.readers->slot(), kept.readers->slot());
  assert_ptr_not_equal(sample.readers, kept.readers);
  assert_int_equal(sample.max_age.count(), 20'000'000);
  assert_non_null(sample.readers->slot()->history());
  assert_int_equal(overview.binding.inputs[3].count, 0);
  assert_null(row(cell.slots, "picture").observer);
}

void values_of_the_tables_are_constants(void**) {
  const UnitRecord& source = row(cell.units, "source");
  const auto& configuration = *static_cast<const SourceConfiguration*>(source.configuration);
  assert_true(configuration.vector[2] == 3.0);
  assert_true(configuration.label_view() == "left \"belt\"");
  assert_true(configuration.first == Colour::green);
  assert_true(configuration.smallest == INT64_MIN);
  assert_true(static_cast<const SourceRuntime*>(source.runtime)->gain == 2.0F);
  assert_true(SourceConfiguration{}.vector[2] == 1e-9);
  const DeviceRecord& station = row(cell.devices, "station");
  const auto* bytes = static_cast<const char*>(station.drivers[0].configuration);
  assert_int_equal(bytes[0], 7);                  // the interface's field first
  assert_memory_equal(bytes + 1, "eight ch", 8);  // a full text has no zero at its end
  assert_int_equal(station.bus, 0);
}

void parameters_are_described(void**) {
  const ComponentType& type = *row(cell.units, "source").type;
  assert_int_equal(type.runtime.parameters.size(), 3);
  const ParameterDescriptor& gain = type.runtime.parameters[0];
  assert_string_equal(gain.field->name, "gain");
  assert_true(gain.has_range && gain.minimum == -2.0 && gain.maximum == 2.0);
  assert_true(gain.role == Role::engineer && !gain.persist);
  assert_string_equal(gain.label, "Gain of it");
  assert_true(type.runtime.parameters[1].field->scalar == Scalar::button);
  assert_true(type.runtime.parameters[2].field->scalar == Scalar::hold);
  assert_int_equal(row(cell.units, "axis[0].lift").type->ports.size(), 0);
}

void ports_say_through_which_a_person_operates_the_unit(void**) {
  const ComponentType& worker = *row(cell.units, "worker[0]").type;
  assert_int_equal(worker.ports.size(), 2);
  assert_string_equal(worker.ports[0].name, "jobs");
  assert_true(worker.ports[0].operated);
  assert_false(worker.ports[1].operated);
  for (const PortDescriptor& port : row(cell.units, "overview").type->ports)
    assert_true(port.operated == (port.direction == PortDescriptor::Direction::device));
  for (const PortDescriptor& port : row(cell.units, "source").type->ports) assert_false(port.operated);
}

void types_are_described(void**) {
  const TypeDescriptor& type = *descriptor_of<Everything>;
  assert_int_equal(type.size, sizeof(Everything));
  const FieldDescriptor& matrix = field(type, "matrix");
  assert_int_equal(matrix.dimensions, 2);
  assert_int_equal(matrix.shape[0], 3);
  assert_int_equal(matrix.shape[1], 2);
  assert_int_equal(matrix.count, 6);
  assert_int_equal(field(type, "name").count, 5);
  assert_ptr_equal(field(type, "colour").type, descriptor_of<Colour>);
  assert_string_equal(name_of(Colour::green), "green");
  assert_string_equal(name_of(static_cast<Colour>(9)), "?");
  assert_string_equal(descriptor_of<Colour>->values[2].summary, "Green, \"as grass\".");
  assert_true(descriptor_of<Picture>->is_image);
  assert_int_equal(field(*descriptor_of<Picture>, "data").shape[0], 80000);
}

// That they compile is half of it.
void fields_may_be_called_as_what_generated_code_calls(void**) {
  TextNamedText texts;
  texts.set_text("one");
  texts.set_name("two");
  assert_true(texts.text_view() == "one" && texts.name_view() == "two");
  NamedAsHelpers helpers;
  helpers.set_value("three");
  helpers.text_view = 1;
  assert_true(helpers.value_view() == "three");
  assert_int_equal(field(*descriptor_of<NamedAsHelpers>, "value").offset, offsetof(NamedAsHelpers, value));
  assert_int_equal(field(*descriptor_of<TextNamedText>, "text").count, 8);
}

void padding_is_not_significant(void**) {
  Everything one;
  Everything other;
  std::memset(static_cast<void*>(&one), 0x00, sizeof(one));
  std::memset(static_cast<void*>(&other), 0xFF, sizeof(other));
  for (Everything* all : {&one, &other}) {
    all->flag = true;
    all->tiny = -1;
    all->small = 2;
    all->number = 3;
    all->large = 4;
    all->single = 5;
    all->matrix_map().setConstant(6);
    all->row_map().setConstant(7);
    all->set_name("text");
    all->colour = Colour::red;
    for (Spot& spot : all->spots) {
      spot.x = 8;
      spot.seen = true;
    }
  }
  Digest first, second;
  first.add_fields(*descriptor_of<Everything>, &one);
  second.add_fields(*descriptor_of<Everything>, &other);
  assert_int_equal(first.value(), second.value());
  other.spots[1].seen = false;
  Digest third;
  third.add_fields(*descriptor_of<Everything>, &other);
  assert_int_not_equal(first.value(), third.value());
}

void former_names_are_told(void**) {
  assert_int_equal(cell.renames.size(), 2);
  assert_string_equal(cell.renames[0].from, "origin");
  assert_string_equal(cell.renames[0].to, "source");
  assert_string_equal(cell.renames[1].from, "source.direction");
  assert_string_equal(cell.renames[1].to, "source.vector");
}

const FieldDescriptor& data_of(const SlotRecord& slot) {
  return slot.control->type()->fields.back();
}

// [board-10] [board-11]
void items_are_as_large_as_their_slot_says(void**) {
  const SlotRecord& large = row(cell.slots, "picture");
  const SlotRecord& usual = row(cell.slots, "usual_picture");
  const TypeDescriptor& type = *large.control->type();
  assert_ptr_equal(usual.control->type(), descriptor_of<Picture>);
  assert_int_equal(data_of(usual).count, 80000);
  assert_int_equal(data_of(large).count, 90000);
  assert_int_equal(data_of(large).offset, 4096);
  assert_int_equal(type.size, 4096 + 90000);
  assert_int_equal(type.hash, descriptor_of<Picture>->hash);
  assert_int_equal(type.significant.back().size, 90000);
  assert_int_equal(reinterpret_cast<std::uintptr_t>(usual.control->payload(1)) % 4096, 0);
  for (std::uint8_t buffer = 0; buffer < 3; ++buffer) {
    const auto& picture =
        *static_cast<const Picture*>(static_cast<const void*>(large.control->payload(buffer)));
    assert_int_equal(picture.data().size(), 90000);
    assert_ptr_equal(picture.data().data(), large.control->payload(buffer) + 4096);
  }
  // What the unit filled to the last byte stays within its buffer, and a step's own pictures differ.
  const ItemHeader* const item = usual.observer->newest();
  assert_non_null(item);
  const auto& picture = *static_cast<const Picture*>(usual.observer->payload());
  assert_int_equal(picture.data().size(), 80000);
  assert_int_equal(picture.data()[79999], (item->sequence - 1) & 0xFF);
  static_assert(!std::is_copy_constructible_v<Picture> && !std::is_copy_assignable_v<Picture>);
}

void an_image_is_read_as_any_slot(void**) {
  const SlotRecord& slot = row(cell.slots, "thumbnail");
  assert_true(slot.control->type()->is_image);
  assert_non_null(slot.observer);
  const ItemHeader* item = slot.observer->newest();
  assert_non_null(item);
  const auto& thumbnail = *static_cast<const Thumbnail*>(slot.observer->payload());
  assert_int_equal(thumbnail.width, 16);
  assert_int_equal(thumbnail.height, 12);
  assert_int_equal(thumbnail.data[191], (item->sequence - 1) & 0xFF);
}

void the_panel_has_its_settings_and_files(void**) {
  const PanelRecord& panel = *cell.panel;
  assert_int_equal(panel.connections, 8);
  assert_int_equal(panel.local.size(), 2);
  assert_string_equal(panel.local[1], "fd00::20");
  assert_true(panel.session_timeout == std::chrono::minutes{30});
  assert_int_equal(panel.files.size(), 1);
  assert_true(panel.files[0].path == "widgets/spectrum.js");
  assert_true(panel.files[0].content_type == "text/javascript");
  static std::string file;
  std::ifstream stream(place::widget);
  file.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  assert_true(panel.files[0].bytes == file);
}

void ranges_that_rows_narrow_are_told(void**) {
  assert_int_equal(cell.ranges.size(), 3);
  assert_int_equal(cell.ranges[0].component, 0);
  assert_string_equal(cell.ranges[0].parameter, "gain");
  assert_true(cell.ranges[0].minimum == 0.0 && cell.ranges[0].maximum == 2.0);
  assert_int_equal(cell.ranges[1].component, cell.units.size() + 1);
  assert_true(cell.ranges[1].kind == ParameterKind::runtime);
  assert_true(cell.ranges[1].minimum == 1.0 && cell.ranges[1].maximum == 6.0);
  assert_string_equal(cell.ranges[2].parameter, "trim");  // of one driver alone
}

void text_equals(const nlohmann::json& json, const char* wanted) {
  static std::string text;
  text = json.get<std::string>();
  assert_string_equal(text.c_str(), wanted);
}

void the_descriptor_tells_what_a_page_needs(void**) {
  static nlohmann::json json;
  json = nlohmann::json::parse(cell.descriptor_json);
  assert_int_equal(json.at("panel").at("connections").get<int>(), 8);
  const auto& spectrum = json.at("widgets").at(0);
  assert_true(spectrum.at("custom").get<bool>());
  text_equals(spectrum.at("place"), "overview");
  text_equals(spectrum.at("slots").at("picture"), "thumbnail");
  assert_int_equal(spectrum.at("options").at("bars").get<int>(), 64);
  assert_true(spectrum.at("options").at("grid").get<bool>());
  const auto& gain = json.at("widgets").at(1);
  assert_false(gain.at("custom").get<bool>());
  text_equals(gain.at("place"), "source");
  text_equals(gain.at("parameters").at("value"), "source.gain");
  text_equals(spectrum.at("parameters").at("presses"), "source.feedback.presses");
  text_equals(spectrum.at("parameters").at("first"), "source.configuration.first");
  text_equals(gain.at("device"), "station");
  const auto& station = json.at("devices").at(1);
  text_equals(station.at("overrides").at(0).at("confirm"), "Really?");
  assert_true(station.at("overrides").at(0).at("range").at(1).get<double>() == 6.0);
  text_equals(station.at("values_slot"), "station.values");
  text_equals(station.at("feedback_slot"), "station.feedback");
  assert_true(station.at("drivers").at(1).at("runtime").at("trim").get<double>() == 0.5);
  assert_false(station.at("drivers").at(0).contains("runtime"));
  assert_false(json.at("drivers").at(1).contains("runtime"));
  const auto& metering = json.at("drivers").at(2);
  text_equals(metering.at("runtime").at("type"), "MeteringStationRuntime");
  text_equals(metering.at("runtime").at("parameters").at(0).at("name"), "setpoint");
  text_equals(metering.at("runtime").at("parameters").at(1).at("name"), "trim");
  text_equals(metering.at("feedback").at("parameters").at(4).at("name"), "sum");
  const auto slot = std::find_if(json.at("slots").begin(), json.at("slots").end(),
                                 [](const auto& one) { return one.at("name") == "station.feedback"; });
  text_equals(slot->at("type"), "StationFeedback");
  text_equals(slot->at("driver_types").at("metering"), "MeteringStationFeedback");
  text_equals(spectrum.at("parameters").at("sum"), "station.feedback.sum");
  assert_true(json.at("interfaces").at(1).contains("runtime") &&
              json.at("interfaces").at(1).contains("feedback"));
  text_equals(json.at("units").at(1).at("population"), "worker");
  static std::string images;
  images.clear();
  for (const auto& type : json.at("types"))
    if (type.value("image", false)) images += type.at("name").get<std::string>() + " ";
  assert_string_equal(images.c_str(), "Picture Thumbnail ");
}

void the_descriptor_is_embedded(void**) {
  std::ifstream stream(place::descriptor_json);
  const std::string file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  assert_string_equal(cell.descriptor_json, file.c_str());
  const auto json = nlohmann::json::parse(file);
  assert_int_equal(std::stoull(json.at("hash").get<std::string>(), nullptr, 16), cell.descriptor_hash);
  const auto& source = json.at("units").at(0);
  assert_string_equal(source.at("overrides").at(0).at("label").get<std::string>().c_str(), "Gain");
  assert_int_equal(json.at("units").at(4).at("inputs").at("places").size(), 3);
  assert_int_equal(json.at("slots").size(), cell.slots.size());
  assert_string_equal(
      json.at("devices").at(1).at("drivers").at(0).at("configuration").at("label").get<std::string>().c_str(),
      "eight ch");
}

void a_driver_reads_the_options_of_its_table(void**) {
  const DriverRecord& driver = row(cell.devices, "station").drivers[0];
  assert_int_equal(driver.options.size(), 7);
  const Option& gain = driver.options[2];
  assert_string_equal(gain.name, "--output-gain");
  assert_string_equal(gain.value, "NUMBER");
  assert_true(gain.kind == OptionKind::number && gain.least == 0.5 && gain.most == 2.0 && !gain.chooses);
  assert_string_equal(driver.options[1].value, "WORD");
  assert_true(driver.options[4].kind == OptionKind::file && driver.options[4].chooses);
  assert_string_equal(driver.options[4].summary, "What to put out, \"as it is\".");

  MockStation station;
  DeviceEnvironment environment;
  station.set_environment(&environment);
  assert_false(station.told().echo || station.told().output_gain || station.told().traces != nullptr);
  const GivenOption given[] = {{&driver.options[0], nullptr},
                               {&driver.options[2], "1.5"},
                               {&driver.options[3], "20ms"},
                               {&driver.options[6], "/tmp"}};
  environment.options = OptionValues{given};
  const auto told = station.told();
  assert_true(told.echo && told.output_gain == 1.5 && told.warm_up == std::chrono::milliseconds{20});
  assert_string_equal(told.traces, "/tmp");
  assert_null(told.samples);
}

void it_runs(void**) {
  const char* words[] = {"generated_cell", "--virtual-time", "1s"};
  assert_int_equal(run_application(cell, 3, const_cast<char**>(words)), 0);
  assert_in_range(row(cell.slots, "sample").control->published(), 190, 210);
  assert_in_range(row(cell.slots, "station.feedback").control->published(), 190, 210);
  const SlotRecord& seen = row(cell.slots, "overview.feedback");
  assert_non_null(seen.observer->latch(~std::uint64_t{0}));
  std::uint32_t values[2];
  std::memcpy(values, seen.observer->payload(), sizeof(values));
  assert_int_equal(values[0], 2);  // two of three workers are active
  assert_int_equal(values[1],
                   row(cell.slots, "sample").control->published() - 3);  // numbered from 0, two steps ago
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(tables_hold_every_row_in_order),
                              cmocka_unit_test(what_units_and_devices_share_stands_in_their_records),
                              cmocka_unit_test(a_thread_is_as_its_row_says),
                              cmocka_unit_test(a_queue_of_jobs_has_one_source_for_all),
                              cmocka_unit_test(inputs_find_their_readers),
                              cmocka_unit_test(values_of_the_tables_are_constants),
                              cmocka_unit_test(parameters_are_described),
                              cmocka_unit_test(ports_say_through_which_a_person_operates_the_unit),
                              cmocka_unit_test(types_are_described),
                              cmocka_unit_test(fields_may_be_called_as_what_generated_code_calls),
                              cmocka_unit_test(padding_is_not_significant),
                              cmocka_unit_test(former_names_are_told),
                              cmocka_unit_test(the_descriptor_is_embedded),
                              cmocka_unit_test(the_descriptor_tells_what_a_page_needs),
                              cmocka_unit_test(the_panel_has_its_settings_and_files),
                              cmocka_unit_test(ranges_that_rows_narrow_are_told),
                              cmocka_unit_test(a_driver_reads_the_options_of_its_table),
                              cmocka_unit_test(it_runs),
                              cmocka_unit_test(items_are_as_large_as_their_slot_says),
                              cmocka_unit_test(an_image_is_read_as_any_slot)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
