#include "hal/canopen/sdo_abort.hpp"

namespace flexrf::canopen {
namespace {

struct Reason {
  std::uint32_t code;
  const char* words;
};

constexpr Reason reasons[] = {
    {sdo_abort::toggle, "a segment came twice or was lost"},
    {sdo_abort::timeout, "no answer in time"},
    {sdo_abort::bad_command, "the command is not understood"},
    {0x05040002, "the block size is invalid"},
    {0x05040003, "a block's sequence number is wrong"},
    {0x05040004, "a block's checksum is wrong"},
    {sdo_abort::out_of_memory, "the value does not fit into memory"},
    {sdo_abort::access, "the object cannot be accessed like this"},
    {sdo_abort::write_only, "the object cannot be read"},
    {sdo_abort::read_only, "the object cannot be written"},
    {sdo_abort::no_object, "there is no such object"},
    {sdo_abort::not_mappable, "the object cannot be mapped into a PDO"},
    {sdo_abort::mapping_too_long, "the mapped objects do not fit into a PDO"},
    {0x06040043, "the parameters do not fit together"},
    {0x06040047, "the device is not able to do this"},
    {0x06060000, "the device's hardware failed"},
    {sdo_abort::wrong_length, "the value has the wrong length"},
    {sdo_abort::too_long, "the value is too long"},
    {sdo_abort::too_short, "the value is too short"},
    {sdo_abort::no_subindex, "the object has no such subindex"},
    {sdo_abort::out_of_range, "the value is out of its range"},
    {0x06090031, "the value is too high"},
    {0x06090032, "the value is too low"},
    {0x06090036, "the maximum lies below the minimum"},
    {0x060A0023, "the device lacks a resource for it"},
    {sdo_abort::general, "the device does not say why"},
    {0x08000020, "the device cannot store or transfer it"},
    {0x08000021, "the device is under local control"},
    {sdo_abort::device_state, "the device's present state does not permit it"},
    {0x08000023, "the device has no object dictionary"},
    {0x08000024, "there is no data"},
};

}  // namespace

const char* describe_sdo_abort(std::uint32_t code) noexcept {
  for (const Reason& reason : reasons) {
    if (reason.code == code) return reason.words;
  }
  return "a reason of the device's own";
}

}  // namespace flexrf::canopen
