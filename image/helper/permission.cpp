#include "image/helper/permission.hpp"

namespace flexrf::helper {

bool is_confirmed(const Facts& facts) noexcept {
  return facts.choice && facts.running.slot && facts.choice->of(*facts.running.slot).is_confirmed;
}

bool is_fallen_back_to(const Facts& facts) noexcept {
  return facts.choice && facts.running.slot && facts.running.why == "fallback" &&
         facts.running.trial == facts.choice->trial && facts.choice->primary != *facts.running.slot;
}

bool has_to_come_up(const Facts& facts) noexcept {
  return is_confirmed(facts) && facts.choice->primary == *facts.running.slot && facts.attempts > 0;
}

bool has_another_turn(const Facts& facts) noexcept {
  if (!facts.choice || !facts.running.slot || !facts.choice->of(other(*facts.running.slot)).is_whole)
    return false;
  return is_confirmed(facts) ? has_to_come_up(facts) && facts.running.why == "confirmed"
                             : facts.running.why == "trial";
}

std::string permission_of(const Facts& facts) {
  if (!facts.is_claimed) return "nobody has claimed this PC: there is no admin with a password";
  if (facts.update == Phase::installing) return installing;
  if (facts.update == Phase::installed) return "an update was installed: the PC has to be restarted";
  if (facts.update == Phase::unknown)
    return "whether an update is being installed cannot be told: " + facts.update_failure +
           "; restart the PC";
  if (!facts.choice) return "which version of this PC counts cannot be told: " + facts.choice_failure;
  if (!facts.running.slot) return "this PC was not started by its own boot loader, which names the version";
  if (!is_confirmed(facts))
    return "this version has not confirmed itself; it does when it has been healthy for a minute";
  if (!facts.address_on_trial.empty())
    return "the address of " + facts.address_on_trial +
           " is on trial; keep it, or wait until it is taken back";
  return permitted;
}

}  // namespace flexrf::helper
