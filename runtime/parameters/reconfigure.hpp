// Changing configuration parameters of a running application: one transaction over several components.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "runtime/unit/component.hpp"

namespace flexrf {

struct ConfigurationChange {
  std::uint16_t component = 0;  ///< executive's index: units in table order, then devices
  std::string parameter;        ///< "length", "gains[2]", "limits.low"
  std::string value;            ///< as text_of() writes it
};

/// The executive's side. All on the lifecycle thread; may block.
class ReconfigureHost {
 public:
  virtual Component* component(std::uint16_t index) = 0;  ///< null: no such component
  virtual bool is_initialised(std::uint16_t index) const = 0;
  /// Who must be re-initialised when the configuration of these changes, each once, in order of stopping:
  /// what actuates first, what others stand on (buses) last. Only initialised ones.
  virtual std::vector<std::uint16_t> owners_of(std::span<const std::uint16_t> changed) = 0;
  /// Takes the owner out of its thread and stops it; actuators are inhibited until a person gives Start.
  virtual Status stop(std::uint16_t owner) = 0;
  /// Initialises it with the configuration as it lies in its memory, and gives it back to its thread. After a
  /// failure it is stopped.
  virtual Status initialise(std::uint16_t owner) = 0;
  /// Puts the owner in fault with this cause (both causes, when there are two).
  virtual void fault(std::uint16_t owner, const Status& cause) = 0;

 protected:
  ~ReconfigureHost() = default;
};

enum class ReconfigureOutcome : std::uint8_t {
  done,         ///< the new values are in force
  refused,      ///< nothing was touched
  rolled_back,  ///< an owner did not initialise; all run again with the old values
  fault,        ///< as rolled_back, but an owner did not stop, or did not take the old values: it is in fault
};
const char* name_of(ReconfigureOutcome outcome) noexcept;

struct ReconfigureResult {
  ReconfigureOutcome outcome = ReconfigureOutcome::done;
  std::vector<std::string> causes;    ///< why not; empty when done
  std::vector<std::uint16_t> owners;  ///< stopped and initialised again, in order of stopping
};

/// Validates all changes (all problems at once), stops every owner, writes the values, initialises the owners
/// in reverse order of stopping; if one fails, stops what was initialised, writes the old values, initialises
/// all again. What changes nothing stops nobody. Lifecycle thread.
ReconfigureResult reconfigure(ReconfigureHost& host, std::span<const ConfigurationChange> changes);

/// A plain write: only while the component is not initialised. Lifecycle thread.
Status write_configuration(ReconfigureHost& host, const ConfigurationChange& change);

}  // namespace flexrf
