#include "drivers/feeder_station/feeder_station.hpp"

#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"

namespace flexrf::user {

Status FeederStation::initialise() {
  auto* const link = dynamic_cast<SimulatedModbusLink*>(bus);
  if (link == nullptr) {
    return Status::error(StatusCode::invalid_argument,
                         "the feeder is simulated, and its link is not: choose --hardware for both");
  }
  // Initialised again it is the same feeder, with what is left in it.
  if (feeder_ == nullptr) {
    feeder_ =
        std::make_shared<Feeder>(Feeder::Settings{duration_of(configuration.travel), configuration.stock});
    link->registers().set_model(configuration.unit_id, feeder_);
  }
  return LinkedStation::initialise();
}

}  // namespace flexrf::user
