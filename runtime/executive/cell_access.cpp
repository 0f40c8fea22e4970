#include "runtime/executive/cell_access.hpp"

#include "runtime/executive/cell.hpp"

namespace flexrf {

std::uint64_t CellAccess::send(ParameterRequest& request, Time now, bool keeps) noexcept {
  request.keeps = keeps || request.who[0] != '\0';
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

void CellAccess::note(std::string_view who, const char* did, std::string_view what) noexcept {
  cell_->audit().note(who, did, what);
}

void CellAccess::stop_motion(std::string_view who) noexcept {
  cell_->stop_motion(who);
}

}  // namespace flexrf
