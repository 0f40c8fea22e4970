// A vendor's EDS file, whatever it is.
#include <sstream>

#include "config-gen/read/eds.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {

std::vector<Bytes> seeds() {
  return {
      bytes_of(
          "[DeviceInfo]\r\nVendorNumber=0x123\r\nProductNumber=7\r\n[6040]\r\nParameterName=Controlword\r\n"
          "ObjectType=0x7\r\nDataType=0x0006\r\nAccessType=rww\r\nDefaultValue=$NODEID+0x200\r\n"
          "PDOMapping=1\r\nLowLimit=-5\r\nHighLimit=0xFFFF\r\n[1A00sub1]\r\nDataType=7\r\nAccessType=ro\r\n"),
      bytes_of("; comment\n[1018]\nSubNumber=2\nObjectType=8\nCompactSubObj=3\n[1018sub0]\nDataType=5\n"
               "DefaultValue=2\nParameterValue=010\n[1018Value]\nNrOfEntries=1\n1=0x5\n")};
}

void take(std::span<const std::uint8_t> bytes) {
  using namespace config_gen;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Diagnostics diagnostics;
  const auto eds = parse_eds(text, "fuzz.eds", diagnostics);
  expect(eds.has_value() || diagnostics.failed());
  std::ostringstream told;
  diagnostics.print(told);
  if (!eds) return;
  for (const auto& [address, variable] : eds->variables) {
    expect(eds->find(address.first, address.second) == &variable);
    if (variable.data_type) static_cast<void>(eds_type_name(variable.data_type->value));
  }
}

}  // namespace flexrf::fuzz
