#include "web-ui/server/api/health.hpp"

#include "runtime/face/statistics.hpp"

namespace flexrf::panel {

std::string why_not_healthy(const Cell& cell) {
  const FaultPlaces places(cell);
  // Behind the components come threads and the process, whose only fault is time that they missed; one that
  // hangs ends the application.
  for (std::size_t component = 0; component < places.thread(0); ++component) {
    if (places.extent(component) == 0) continue;
    const FaultPlaces::Fault fault = places.at(component);
    return std::string{fault.kind} + ' ' + fault.name + " is in fault: " + fault.cause;
  }
  return cell.control().check_running().cause();
}

}  // namespace flexrf::panel
