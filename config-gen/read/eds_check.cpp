#include "config-gen/read/eds_check.hpp"

#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {
namespace {

using Access = NeededObject::Access;
using Pdo = NeededObject::Pdo;

constexpr std::uint16_t identity = 0x1018;
constexpr std::uint8_t vendor_id = 1;
constexpr std::uint8_t product_code = 2;

// With all digits of so many bits: "0x00000123".
std::string hexadecimal(std::int64_t value, unsigned bits) {
  std::string text = "0x";
  for (unsigned left = bits; left > 0; left -= 4)
    text += "0123456789ABCDEF"[static_cast<std::uint64_t>(value) >> (left - 4) & 0xF];
  return text;
}

bool is_readable(const std::string& access) {
  return access != "wo";
}
bool is_writable(const std::string& access) {
  return access == "wo" || access == "rw" || access == "rwr" || access == "rww";
}
bool is_known(const std::string& access) {
  return is_writable(access) || access == "ro" || access == "const";
}

class EdsCheck {
 public:
  EdsCheck(const EdsUse& use, Diagnostics& diagnostics) : use_(use), diagnostics_(diagnostics) {}

  void run() {
    check_node();
    for (const NeededObject& needed : use_.objects) {
      if (!is_asked_for(needed)) continue;
      needed_ = &needed;
      called_ = "object " + object_text(needed.index, needed.subindex) + " (" + needed.name + ")";
      check();
    }
  }

 private:
  // A DCF is what a tool has set of one device.
  void check_node() {
    const Literal* const node = use_.parameter("node");
    if (!use_.eds.node || node == nullptr) return;
    const auto configured = static_cast<std::int64_t>(number_of(*node));
    if (use_.eds.node->value == configured) return;
    diagnostics_.error(use_.eds.node->position,
                       "this file is of node " + std::to_string(use_.eds.node->value) +
                           ", and the device's node is " + std::to_string(configured),
                       "name the file of the device that is there, or correct the configuration at " +
                           to_string(node->position));
  }

  bool is_asked_for(const NeededObject& needed) const {
    return std::all_of(needed.when.begin(), needed.when.end(),
                       [this](const NeededObject::Condition& condition) { return holds(condition); });
  }

  bool holds(const NeededObject::Condition& condition) const {
    const Literal* parameter = use_.parameter(condition.parameter);
    if (parameter == nullptr) return false;
    const auto value = static_cast<std::int64_t>(number_of(*parameter));
    const auto& values = condition.values;
    const bool is_so = values.empty() ? number_of(*parameter) != 0
                                      : std::find(values.begin(), values.end(), value) != values.end();
    return is_so != condition.unless;
  }

  void error(const Position& position, std::string text, std::string hint) {
    if (!needed_->without.empty()) text += ": " + needed_->without;
    if (!needed_->helps.empty())
      hint = "with " + quote(needed_->helps) +
             " in its configuration the driver takes a drive that is so; else: " + hint;
    diagnostics_.error(position, std::move(text), std::move(hint));
  }

  void check() {
    const EdsVariable* found = use_.eds.find(needed_->index, needed_->subindex);
    if (found == nullptr) {
      if (needed_->optional) return;
      const auto object = use_.eds.objects.find(needed_->index);
      if (object == use_.eds.objects.end())
        error(use_.named_at, called_ + " is missing in " + quote(use_.file),
              "is this the EDS of the drive that is there, with its firmware?");
      else
        error(object->second,
              called_ + (needed_->subindex == 0 ? " has no DataType"
                                                : " is missing: the object has no such subindex"),
              "is this the EDS of the drive that is there, with its firmware, and whole?");
      return;
    }
    check_type(*found);
    check_access(*found);
    check_flags(*found);
    check_pdo(*found);
    for (const EdsOddValue& odd : found->odd)
      diagnostics_.warning(odd.position,
                           called_ + " has the " + odd.key + " " + quote(odd.text) + ", which is no number",
                           "it is left out; numbers are written as 31, 0x1F or $NODEID+0x180");
    check_value(*found);
  }

  // ObjFlags of the objects that the driver writes or reads at bring-up. Objects in PDOs are not judged by
  // them.
  void check_flags(const EdsVariable& found) {
    if (!found.flags || needed_->pdo != Pdo::none) return;
    const bool writes = needed_->access != Access::read && (found.flags->value & eds_refuses_writing) != 0;
    const bool reads = (needed_->access == Access::read || needed_->access == Access::read_write) &&
                       (found.flags->value & eds_refuses_reading) != 0;
    if (!writes && !reads) return;
    diagnostics_.warning(found.flags->position,
                         called_ + " is not to be " + (writes ? "written" : "read") +
                             " when the device is configured, its ObjFlags say, and the driver does",
                         "look into the device's manual what comes of it");
  }

  void check_type(const EdsVariable& found) {
    const std::string& wanted = object_types[needed_->type];
    if (!found.data_type) {
      diagnostics_.warning(found.position, called_ + " has no DataType",
                           "is the file truncated? The driver takes it for " + wanted);
      return;
    }
    const std::string type = eds_type_name(found.data_type->value);
    if (type == wanted) return;
    // On the wire only the size shows.
    const bool only_sign = (type.front() == 'i' || type.front() == 'u') && type.substr(1) == wanted.substr(1);
    if (only_sign)
      diagnostics_.warning(found.data_type->position,
                           called_ + " is " + type + " in this EDS, and the driver takes it for " + wanted,
                           "look into the drive's manual whether its sign is as the profile says");
    else
      error(found.data_type->position, called_ + " is " + type + ", and " + wanted + " is needed",
            "its bytes would not fit: is this the EDS of the drive that is there?");
  }

  void check_access(const EdsVariable& found) {
    if (!is_known(found.access)) {
      diagnostics_.warning(
          found.access_position,
          called_ +
              (found.access.empty() ? " has no AccessType" : " has the AccessType " + quote(found.access)),
          "known ones are ro, wo, rw, rwr, rww and const; what the driver may do with it is not checked");
      return;
    }
    const bool reads = needed_->access == Access::read || needed_->access == Access::read_write;
    const bool writes = needed_->access == Access::write || needed_->access == Access::read_write;
    if (reads && !is_readable(found.access))
      error(found.access_position, called_ + " cannot be read: its AccessType is " + found.access,
            "the driver reads it: is this the EDS of the drive that is there?");
    if (writes && !is_writable(found.access))
      error(found.access_position, called_ + " cannot be written: its AccessType is " + found.access,
            "the driver writes it: is this the EDS of the drive that is there?");
  }

  void check_pdo(const EdsVariable& found) {
    if (needed_->pdo == Pdo::none) return;
    const bool sent = needed_->pdo == Pdo::sent;
    const std::string what = sent ? " cannot be mapped into a PDO that the drive sends: "
                                  : " cannot be mapped into a PDO that the drive receives: ";
    if (!found.mappable)
      error(found.mappable_position, called_ + what + "its PDOMapping is not 1",
            "the driver needs it in each cycle: is this the EDS of the drive that is there?");
    else if (found.access == (sent ? "rww" : "rwr"))
      error(found.access_position, called_ + what + "its AccessType is " + found.access,
            "rwr is sent only, rww is received only");
  }

  void check_value(const EdsVariable& found) {
    std::optional<std::int64_t> wanted;
    std::string from;
    if (const auto* number = std::get_if<std::int64_t>(&needed_->value)) wanted = *number;
    if (const auto* name = std::get_if<std::string>(&needed_->value)) {
      const Literal* parameter = use_.parameter(*name);
      // 0 is any.
      if (parameter == nullptr || number_of(*parameter) == 0) return;
      wanted = static_cast<std::int64_t>(number_of(*parameter));
      from = ", and the device's " + *name + " is ";
      configured_at_ = parameter->position;
    }
    if (!wanted) return;
    const bool fixed = needed_->access == Access::map && is_known(found.access) && !is_writable(found.access);
    if (needed_->access == Access::read || fixed)
      check_equal(found, *wanted, from, fixed);
    else if (!needed_->of_node)
      check_limits(found, *wanted);
    if (needed_->access != Access::read && !fixed) tell_configured(found, *wanted);
  }

  // Warns of a ParameterValue that the driver overwrites at bring-up.
  void tell_configured(const EdsVariable& found, std::int64_t wanted) {
    if (!found.configured || !found.value || found.value->of_node) return;
    if (needed_->of_node) {
      const Literal* const node = use_.parameter("node");
      if (node == nullptr) return;
      wanted += static_cast<std::int64_t>(number_of(*node));
    }
    if (as_typed(found.value->value) == as_typed(wanted)) return;
    const unsigned bits = object_type_bits[needed_->type];
    diagnostics_.warning(
        found.value->position,
        called_ + " has the ParameterValue " + hexadecimal(found.value->value, bits) +
            ", and the driver sets it to " + hexadecimal(wanted, bits),
        "the value of this file is without effect" +
            (configured_at_ ? ": change the configuration at " + to_string(configured_at_) : ""));
  }

  // What the device says of itself, or what is mapped in it for good.
  void check_equal(const EdsVariable& found, std::int64_t wanted, const std::string& from, bool fixed) {
    std::optional<EdsNumber> value = found.value;
    // [DeviceInfo] says the same, and says it also where the object's section says nothing.
    if (needed_->index == identity && (!value || value->value == 0)) {
      if (needed_->subindex == vendor_id) value = use_.eds.vendor;
      if (needed_->subindex == product_code) value = use_.eds.product;
    }
    if (value && value->of_node && needed_->of_node) {
      value->of_node = false;
    } else if (value && needed_->of_node) {
      const Literal* node = use_.parameter("node");
      if (node != nullptr) wanted += static_cast<std::int64_t>(number_of(*node));
    }
    if (!value || value->of_node) {
      if (fixed)
        diagnostics_.warning(found.position, called_ + " is fixed, and this EDS does not say to what",
                             "the device is asked when it is brought up, and refused if it does not fit");
      return;
    }
    const auto masked = [this](std::int64_t number) {
      return static_cast<std::int64_t>(static_cast<std::uint64_t>(number) & needed_->mask);
    };
    if (masked(value->value) == masked(wanted)) return;
    const unsigned bits = object_type_bits[needed_->type];
    std::string text = called_ + " is " + hexadecimal(value->value, bits);
    if (fixed) text += " and cannot be changed";
    text += from.empty() ? ", and " + hexadecimal(wanted, bits) +
                               (needed_->mask == 0xFFFFFFFF
                                    ? std::string(" is needed")
                                    : " is needed in its bits " + hexadecimal(needed_->mask, bits))
                         : from + hexadecimal(wanted, bits);
    error(value->position, std::move(text),
          from.empty() ? "is this the EDS of the drive that is there?"
                       : "name the EDS of the drive that is there, or correct the configuration at " +
                             to_string(configured_at_));
  }

  void check_limits(const EdsVariable& found, std::int64_t wanted) {
    const auto below = [&](const std::optional<EdsNumber>& limit) {
      return limit && !limit->of_node && wanted < as_typed(limit->value);
    };
    const auto above = [&](const std::optional<EdsNumber>& limit) {
      return limit && !limit->of_node && wanted > as_typed(limit->value);
    };
    const bool is_below = below(found.low);
    if (!is_below && !above(found.high)) return;
    const EdsNumber& limit = is_below ? *found.low : *found.high;
    error(limit.position,
          called_ + " is to be " + std::to_string(wanted) + ", and its " +
              (is_below ? "LowLimit" : "HighLimit") + " is " + std::to_string(as_typed(limit.value)),
          configured_at_ ? "change the configuration at " + to_string(configured_at_)
                         : "is this the EDS of the drive that is there?");
  }

  // Vendors write -1 as 0xFF.
  std::int64_t as_typed(std::int64_t number) const {
    const unsigned unused = 64 - object_type_bits[needed_->type];
    const auto raised = static_cast<std::uint64_t>(number) << unused;
    return object_types[needed_->type].front() == 'i' ? static_cast<std::int64_t>(raised) >> unused
                                                      : static_cast<std::int64_t>(raised >> unused);
  }

  const EdsUse& use_;
  Diagnostics& diagnostics_;
  const NeededObject* needed_ = nullptr;
  std::string called_;
  Position configured_at_;
};

}  // namespace

void check_eds(const EdsUse& use, Diagnostics& diagnostics) {
  EdsCheck(use, diagnostics).run();
}

}  // namespace flexrf::config_gen
