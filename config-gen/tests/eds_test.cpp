// EDS files as vendors write them: what is read of good ones, and what is said of bad ones. What a driver
// asks of them is in the catalogue.
#include "config-gen/read/eds.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "config-gen/read/eds_check.hpp"
#include "config-gen/tests/find.hpp"
#include "config-gen/tests/tables.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests::eds_test {
namespace {

struct Parsed {
  std::optional<Eds> eds;
  std::string messages;
};

Parsed parse(std::string_view text) {
  Diagnostics diagnostics;
  Parsed parsed;
  parsed.eds = parse_eds(text, "drive.eds", diagnostics);
  std::ostringstream out;
  diagnostics.print(out);
  parsed.messages = out.str();
  return parsed;
}

void a_variable(void**) {
  const Parsed parsed = parse(
      "[DeviceInfo]\nVendorNumber=0x1A\nProductNumber=17\n[607A]\nParameterName=Target position\n"
      "DataType=0x0004\nAccessType=RWW\nDefaultValue=-5\nLowLimit=0x80000000\nPDOMapping=1\n");
  assert_string_equal(parsed.messages.c_str(), "");
  const EdsVariable* target = parsed.eds->find(0x607A, 0);
  assert_non_null(target);
  assert_string_equal(target->name.c_str(), "Target position");
  assert_string_equal(target->access.c_str(), "rww");
  assert_int_equal(target->data_type->value, 4);
  assert_int_equal(target->value->value, -5);
  assert_int_equal(target->low->value, 0x80000000);
  assert_true(target->mappable);
  assert_int_equal(target->position.line, 4);
  assert_int_equal(target->access_position.line, 7);
  assert_int_equal(target->access_position.column, 12);
  assert_int_equal(parsed.eds->vendor->value, 0x1A);
  assert_int_equal(parsed.eds->product->value, 17);
  assert_null(parsed.eds->find(0x607A, 1));
  assert_null(parsed.eds->find(0x6064, 0));
}

void line_ends_capitals_and_comments(void**) {
  const Parsed parsed = parse(
      "\xEF\xBB\xBF; a comment\r\n# another\r\n\r\n[1018SUB0A]\r\n  DATATYPE = 0X7 ; u32\r\n accesstype=Ro "
      "\r\n"
      "PDOMAPPING=0x0\r\n[60ff]\r\nDataType=7");
  assert_string_equal(parsed.messages.c_str(), "");
  const EdsVariable* entry = parsed.eds->find(0x1018, 0x0A);
  assert_non_null(entry);
  assert_int_equal(entry->data_type->value, 7);
  assert_string_equal(entry->access.c_str(), "ro");
  assert_false(entry->mappable);
  assert_int_equal(parsed.eds->find(0x60FF, 0)->data_type->value, 7);
}

void numbers(void**) {
  const Parsed parsed = parse(
      "[2000]\nDataType=7\nDefaultValue=$NODEID+0x180\n[2001]\nDataType=7\nDefaultValue= 0x200 + $nodeid\n"
      "[2002]\nDataType=7\nDefaultValue=$NODEID\n[2003]\nDataType=7\nDefaultValue=$NODEID*2\n"
      "[2004]\nDataType=010\nDefaultValue=099\n[2005]\nDataType=9\nDefaultValue=Version 3\n");
  assert_string_equal(parsed.messages.c_str(), "");
  assert_true(parsed.eds->find(0x2000, 0)->value->of_node);
  assert_int_equal(parsed.eds->find(0x2000, 0)->value->value, 0x180);
  assert_true(parsed.eds->find(0x2001, 0)->value->of_node);
  assert_int_equal(parsed.eds->find(0x2001, 0)->value->value, 0x200);
  assert_true(parsed.eds->find(0x2002, 0)->value->of_node);
  assert_false(parsed.eds->find(0x2003, 0)->value.has_value());
  assert_int_equal(parsed.eds->find(0x2004, 0)->data_type->value, 8);
  assert_int_equal(parsed.eds->find(0x2004, 0)->value->value, 99);
  assert_false(parsed.eds->find(0x2005, 0)->value.has_value());
}

void a_key_that_is_there_twice(void**) {
  const Parsed parsed = parse("[6040]\nDataType=6\ndatatype=7\n[6041]\nDataType=6\n");
  assert_string_equal(parsed.messages.c_str(),
                      "drive.eds:3:1: warning: the key 'datatype' is there twice in its section\n"
                      "drive.eds:3:1: hint: the first counts\n");
  assert_int_equal(parsed.eds->find(0x6040, 0)->data_type->value, 6);
}

void compact_arrays_and_configured_values(void**) {
  const Parsed parsed = parse(
      "[1016]\nParameterName=Consumer\nObjectType=8\nCompactSubObj=3\nDataType=7\nAccessType=rw\n"
      "[1016sub2]\nDataType=6\nAccessType=ro\nDefaultValue=1\nParameterValue=2\n");
  assert_string_equal(parsed.messages.c_str(), "");
  assert_int_equal(parsed.eds->find(0x1016, 0)->data_type->value, 5);
  assert_string_equal(parsed.eds->find(0x1016, 3)->access.c_str(), "rw");
  assert_null(parsed.eds->find(0x1016, 4));
  assert_int_equal(parsed.eds->find(0x1016, 2)->data_type->value, 6);
  assert_int_equal(parsed.eds->find(0x1016, 2)->value->value, 2);
}

// What a tool has set: of a DCF, and of a compact object the values of its subindices.
void values_of_compact_objects_and_of_a_device(void**) {
  const Parsed parsed = parse(
      "[DeviceComissioning]\nNodeID=0x05\nBaudrate=500\n"
      "[1016]\nCompactSubObj=2\nDataType=7\nAccessType=rw\nDefaultValue=1\nObjFlags=0x3\n"
      "[1016Value]\nNrOfEntries=2\n2=0x7F01F4\n3=1\n[1016Name]\nNrOfEntries=1\n1=Master\n"
      "[2000]\nDataType=7\nParameterValue= ; not set\nDefaultValue=4\n"
      "[2001]\nDataType=7\nParameterValue=auto\nDefaultValue=4\nHighLimit=$NODEID*2\n");
  assert_string_equal(parsed.messages.c_str(),
                      "drive.eds:13:1: warning: the object '1016' has no subindex '3'\n"
                      "drive.eds:13:1: hint: the value is left out\n");
  assert_int_equal(parsed.eds->node->value, 5);
  assert_int_equal(parsed.eds->find(0x1016, 0)->value->value, 2);
  assert_int_equal(parsed.eds->find(0x1016, 1)->value->value, 1);
  assert_int_equal(parsed.eds->find(0x1016, 1)->flags->value, 3);
  assert_int_equal(parsed.eds->find(0x1016, 2)->value->value, 0x7F01F4);
  assert_int_equal(parsed.eds->find(0x2000, 0)->value->value, 4);
  assert_false(parsed.eds->find(0x2000, 0)->configured);
  const EdsVariable& odd = *parsed.eds->find(0x2001, 0);
  assert_true(odd.configured && !odd.value);
  assert_int_equal(odd.odd.size(), 2);
  assert_string_equal(odd.odd[0].text.c_str(), "auto");
  assert_string_equal(odd.odd[1].key.c_str(), "HighLimit");
}

void what_is_no_eds_file(void**) {
  const auto says = [](std::string_view text, const char* part) {
    const Parsed parsed = parse(text);
    return !parsed.eds && std::strstr(parsed.messages.c_str(), part) != nullptr;
  };
  using namespace std::string_view_literals;
  assert_true(says("", "drive.eds:1:1: error: this is no EDS file: it is empty"));
  assert_true(says(" \r\n\n", "it is empty"));
  assert_true(says("<?xml version=\"1.0\"?>", "it is a text in XML"));
  assert_true(says("\xFF\xFE[\0"sv, "it is a text in UTF-16"));
  assert_true(says("[6040]\n\0\x01"sv, "it is no text"));
  assert_true(says("index,type\n0x6040,u16\n", "it has no [section]"));
  assert_true(says("[FileInfo]\nFileName=x.eds\n", "this EDS file has no object"));
}

// Wherever a file is cut off, and whatever byte of it is another: read or refused, in words.
void every_cut_and_every_damage_ends_in_words(void**) {
  const std::string whole =
      "[DeviceInfo]\r\nVendorNumber=0x1\r\n[OptionalObjects]\r\nSupportedObjects=2\r\n1=0x1016\r\n2="
      "0x6040\r\n"
      "[1016]\r\nCompactSubObj=2\r\nDataType=7\r\n[1018sub1]\r\nDefaultValue=$NODEID+1\r\n[6040]\r\n"
      "DataType=0x6\r\nAccessType=rww ; both\r\nPDOMapping=1\r\n";
  std::size_t tried = 0;
  const auto is_told = [&tried](const std::string& text) {
    const Parsed parsed = parse(text);
    ++tried;
    return parsed.eds.has_value() || parsed.messages.find(": error: ") != std::string::npos;
  };
  for (std::size_t size = 0; size <= whole.size(); ++size) assert_true(is_told(whole.substr(0, size)));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char other : {'\0', '[', ']', '=', '$', '-', '\n', '\xFF'}) {
      std::string damaged = whole;
      damaged[at] = other;
      assert_true(is_told(damaged));
    }
  }
  assert_true(tried > 1000);
}

void a_cell_with_an_odd_but_good_file(void**) {
  std::filesystem::current_path(place::tests_folder);
  const Result result = read_cell("cells/eds");
  assert_string_equal(result.messages.c_str(), "");
  const auto depends_on = [&](std::string_view name) {
    for (const std::filesystem::path& file : result.model.files)
      if (file.generic_string().ends_with(name)) return true;
    return false;
  };
  assert_true(depends_on("cells/eds/servo.eds"));
  assert_true(depends_on("canopen_servo/objects.csv"));
  const Driver& driver = result.model.drivers[named(result.model.devices, "servo").drivers[0].driver];
  assert_int_equal(driver.objects.size(), 13);
}

// What one of the repository's own drivers asks of the drive that its simulator is, or of one that is so in
// all but the texts that are exchanged in its EDS file; with these parameters instead of the defaults.
using Numbers = std::map<std::string, std::int64_t>;
using Texts = std::vector<std::pair<std::string, std::string>>;
constexpr const char* canopen_servo_drive = "servo_drive/canopen/canopen_servo_drive.toml";
constexpr const char* canopen_gripper = "gripper/canopen/canopen_gripper.toml";
std::string messages_for(const std::string& driver, const Numbers& said, const Texts& exchanged = {}) {
  const std::filesystem::path hal = std::filesystem::path(place::tests_folder) / "../../hal";
  SearchPaths paths;
  paths.interfaces = {hal};
  Diagnostics diagnostics;
  const Model model = read({Target::Kind::driver, hal / driver}, paths, diagnostics);
  std::ifstream file(hal / "../apps/cia402-simulator/cia402_simulator.eds");
  std::string text(std::istreambuf_iterator<char>(file), {});
  for (const auto& [from, to] : exchanged) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return "the EDS file has no " + from;
    text.replace(at, from.size(), to);
  }
  const auto eds = parse_eds(text, "drive.eds", diagnostics);
  std::map<std::string, Literal> values;
  for (const auto& [name, value] : said) values[name] = {value, {}, {}};
  const auto parameter = [&](const std::string& name) -> const Literal* {
    if (const auto found = values.find(name); found != values.end()) return &found->second;
    for (const Parameter& one : model.drivers.front().configuration.parameters)
      if (one.field.name == name) return &one.initial;
    for (const Parameter& one : model.interfaces.front().configuration.parameters)
      if (one.field.name == name) return &one.initial;
    return nullptr;
  };
  if (eds && !model.drivers.empty() && model.drivers.front().objects.size() > 20)
    check_eds({*eds, "drive.eds", {}, model.drivers.front().objects, parameter}, diagnostics);
  std::ostringstream out;
  diagnostics.print(out);
  return eds && !model.drivers.empty() ? out.str() : "nothing was read";
}

// It has another object of the maker's own instead.
Texts without(const std::string& index) {
  const std::string own = "2" + index.substr(1);
  return {{"=0x" + index + "\n", "=0x" + own + "\n"}, {"[" + index + "]", "[" + own + "]"}};
}

bool says(const std::string& messages, const char* part) {
  if (messages.find(part) != std::string::npos) return true;
  print_message("%s", messages.c_str());
  return false;
}

constexpr std::int64_t cyclic_position = 0;
constexpr std::int64_t profile_position = 2;

void the_driver_of_drives_and_the_simulated_drive(void**) {
  for (std::int64_t mode = 0; mode < 4; ++mode) {
    assert_string_equal(messages_for(canopen_servo_drive, {{"mode", mode}, {"vendor", 0x123}}).c_str(), "");
    assert_true(says(messages_for(canopen_servo_drive, {{"mode", mode}, {"vendor", 0x999}}),
                     "object 0x1018:01 (vendor) is 0x00000123, and the device's vendor is 0x00000999"));
  }
}

void the_driver_of_grippers_and_the_simulated_drive(void**) {
  assert_string_equal(messages_for(canopen_gripper, {{"vendor", 0x123}}).c_str(), "");
  assert_true(says(messages_for(canopen_gripper, {{"vendor", 0x999}}), "(vendor) is 0x00000123"));
}

// What is optional in CiA 402, or of use to nobody here.
void what_a_drive_need_not_have(void**) {
  const Numbers plain{{"mode", profile_position}, {"vendor", 0x123}};
  assert_string_equal(messages_for(canopen_servo_drive, plain, without("6083")).c_str(), "");
  assert_string_equal(messages_for(canopen_servo_drive, plain, without("6084")).c_str(), "");
  assert_string_equal(messages_for(canopen_servo_drive, plain, {{"[1018sub2]", "[1018sub3]"}}).c_str(), "");
  Numbers named = plain;
  named["product"] = 0x456;
  assert_true(says(messages_for(canopen_servo_drive, named, {{"[1018sub2]", "[1018sub3]"}}),
                   "object 0x1018:02 (product code) is missing"));
}

// The column of the table that is for such a drive stands in the hint, and with it nothing is said any more.
void the_column_that_helps_is_in_the_hint(void**) {
  struct Case {
    Numbers plain;
    Texts exchanged;
    const char* hint;
    Numbers said;
  };
  const Texts no_cyclic{{"DefaultValue=0x000001E5", "DefaultValue=0x00000065"}};
  const Texts unmapped_speed{{"DefaultValue=10000\nPDOMapping=1", "DefaultValue=10000\nPDOMapping=0"}};
  const Case cases[] = {
      {{{"mode", cyclic_position}},
       no_cyclic,
       "with 'interpolates = true' in its configuration",
       {{"interpolates", 1}}},
      {{{"mode", profile_position}}, unmapped_speed, "'maps_speed = false'", {{"maps_speed", 0}}},
      {{{"mode", profile_position}}, without("6081"), "'maps_speed = false'", {}},
      {{{"mode", profile_position}, {"maps_speed", 0}},
       without("6081"),
       "'tells_speed = false'",
       {{"tells_speed", 0}}},
      {{{"mode", cyclic_position}},
       without("6007"),
       "'tells_abort_connection = false'",
       {{"tells_abort_connection", 0}}},
      {{{"mode", cyclic_position}}, without("606C"), "'maps_velocity = false'", {{"maps_velocity", 0}}},
      {{{"mode", cyclic_position}}, without("1017"), "'guarded = true'", {{"guarded", 1}}},
      {{{"mode", cyclic_position}},
       {{"[60C2sub1]", "[20C2sub1]"}},
       "'tells_period = false'",
       {{"tells_period", 0}}},
  };
  for (const Case& one : cases) {
    const std::string plain = messages_for(canopen_servo_drive, one.plain, one.exchanged);
    assert_true(says(plain, ": error: ") && says(plain, one.hint));
    if (one.said.empty()) continue;
    Numbers said = one.plain;
    for (const auto& [name, value] : one.said) said[name] = value;
    assert_string_equal(messages_for(canopen_servo_drive, said, one.exchanged).c_str(), "");
  }
  assert_true(says(messages_for(canopen_servo_drive, {{"mode", cyclic_position}, {"interpolates", 1}},
                                {{"[60C1sub1]", "[20C1sub1]"}}),
                   "object 0x60C1:01 (interpolation point) is missing"));
}

// An identifier that cannot be written is as good if it is the right one.
void identifiers_that_are_fixed(void**) {
  const auto fixed = [](const char* value) {
    return messages_for(canopen_servo_drive, {{"node", 5}},
                        {{"AccessType=rw\nDefaultValue=$NODEID+0x80000200",
                          std::string("AccessType=const\nDefaultValue=") + value}});
  };
  assert_string_equal(fixed("$NODEID+0x200").c_str(), "");
  assert_string_equal(fixed("0x205").c_str(), "");
  assert_true(
      says(fixed("$NODEID+0x300"), "object 0x1400:01 (identifier of RPDO 1) is 0x00000300 and cannot be"));
  assert_true(says(fixed("0x206"), "is 0x00000206 and cannot be changed, and 0x00000205 is needed"));
  // It is out of use, for good.
  assert_true(says(fixed("$NODEID+0x80000200"), "object 0x1400:01"));
}

}  // namespace
}  // namespace flexrf::config_gen::tests::eds_test

int main() {
  using namespace flexrf::config_gen::tests::eds_test;
  const CMUnitTest tests[] = {cmocka_unit_test(a_variable),
                              cmocka_unit_test(line_ends_capitals_and_comments),
                              cmocka_unit_test(numbers),
                              cmocka_unit_test(a_key_that_is_there_twice),
                              cmocka_unit_test(compact_arrays_and_configured_values),
                              cmocka_unit_test(values_of_compact_objects_and_of_a_device),
                              cmocka_unit_test(what_is_no_eds_file),
                              cmocka_unit_test(every_cut_and_every_damage_ends_in_words),
                              cmocka_unit_test(a_cell_with_an_odd_but_good_file),
                              cmocka_unit_test(the_driver_of_drives_and_the_simulated_drive),
                              cmocka_unit_test(the_driver_of_grippers_and_the_simulated_drive),
                              cmocka_unit_test(what_a_drive_need_not_have),
                              cmocka_unit_test(the_column_that_helps_is_in_the_hint),
                              cmocka_unit_test(identifiers_that_are_fixed)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
