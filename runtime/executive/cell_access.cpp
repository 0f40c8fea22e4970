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

void CellAccess::stop_motion() noexcept {
  cell_->control().stop_motion();
}

}  // namespace flexrf
