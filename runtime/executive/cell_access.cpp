#include "runtime/executive/cell_access.hpp"

#include "runtime/executive/cell.hpp"

namespace flexrf {

std::uint64_t CellAccess::send(ParameterRequest& request, Time now) noexcept {
  request.requester = post_->requester;
  request.correlation = ++post_->sent;
  request.issued_at = now;
  cell_->send(request);
  return request.correlation;
}

Result<std::uint64_t> CellAccess::save_values() {
  return cell_->saver()->request();
}

SaveState CellAccess::save_state() const {
  return cell_->saver()->state();
}

void CellAccess::stop_motion() noexcept {
  cell_->control().stop_motion();
}

}  // namespace flexrf
