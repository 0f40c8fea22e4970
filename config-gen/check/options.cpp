// Options of the command line: one name means one thing, whichever of an application's drivers declare it.
#include <map>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

void check_options(const Model& model, Diagnostics& diagnostics) {
  std::map<std::string, std::pair<const DriverOption*, const Driver*>> known;
  for (const Device& device : model.devices)
    for (const DriverChoice& choice : device.drivers) {
      const Driver& driver = model.drivers[choice.driver];
      for (const DriverOption& option : driver.options) {
        const auto [first, is_new] = known.try_emplace(option.name, &option, &driver);
        const auto& [other, its_driver] = first->second;
        if (is_new || other == &option || other->means_the_same(option)) continue;
        diagnostics.error(
            option.position,
            "the option " + quote(option.flag()) + " means something else here than in driver " +
                quote(its_driver->stem),
            "an application permits both drivers: rename one, or write the same in both; the other "
            "is at " +
                to_string(other->position));
      }
    }
}

}  // namespace flexrf::config_gen
