// Who of the population runs, what is wrong with it as a whole, and a new beginning where nobody is left.
#include "runtime/executive/cell.hpp"
#include "units/attention_evolution/attention_evolution.hpp"

namespace flexrf::user {
namespace {

// Generations without a finding, one after the other. For less the camera looks elsewhere, as over a bin.
constexpr std::uint32_t barren_to_tell = 5;

}  // namespace

/// Nothing can be done with others: they have to be initialised by a person first.
bool AttentionEvolution::runs(std::size_t member) const noexcept {
  const UnitState& state = cell.cell().application().unit_states[first_ + member];
  return state.life.load(std::memory_order_acquire) == Life::running;
}

bool AttentionEvolution::is_active(std::size_t member) const noexcept {
  const UnitState& state = cell.cell().application().unit_states[first_ + member];
  return state.active.load(std::memory_order_acquire) && runs(member);
}

/// A place in which a member can begin; most_members: there is none.
std::size_t AttentionEvolution::free_place() const noexcept {
  for (std::size_t i = 0; i < capacity_; ++i)
    if (runs(i) && !is_active(i)) return i;
  return most_members;
}

/// What is wrong with the population as a whole, and a new beginning where nobody is left.
void AttentionEvolution::look_at_all(bool may_change, Time now) noexcept {
  feedback.out_of_service = 0;
  bool any_active = false;
  for (std::size_t i = 0; i < capacity_; ++i) {
    if (!runs(i)) ++feedback.out_of_service;
    any_active = any_active || is_active(i);
  }
  if (evolution_.generation() != judged_generation_) {
    judged_generation_ = evolution_.generation();
    barren_ = any_active && findings_ == 0 ? barren_ + 1 : 0;
    finds_nothing_ = barren_ >= barren_to_tell;
    needs_newcomer_ = finds_nothing_ && !has_table_genes();
    findings_ = 0;
  }
  if (any_active) {
    warn(finds_nothing_ ? Warning::nothing_found : Warning::none);
    if (may_change && needs_newcomer_) make_room_or_begin(now);
  } else if (free_place() == most_members) {
    warn(Warning::all_out_of_service);
  } else {
    warn(runtime.frozen ? Warning::frozen_empty : Warning::begins_anew);
    if (may_change) begin_anew(now);
  }
}

bool AttentionEvolution::has_table_genes() const noexcept {
  for (std::size_t i = 0; i < capacity_; ++i)
    if (is_active(i) && evolution_.member(i).genes == table_genes_) return true;
  return false;
}

/// Members that find nothing are no parents either: one that is known to be good joins them, at first in the
/// place of another where there are as many as shall be.
void AttentionEvolution::make_room_or_begin(Time now) noexcept {
  std::size_t active = 0;
  std::size_t last = most_members;
  for (std::size_t i = 0; i < capacity_; ++i) {
    if (!is_active(i)) continue;
    ++active;
    if (!evolution_.member(i).is_target_in_hand) last = i;
  }
  if (active < runtime.wanted && free_place() != most_members) {
    needs_newcomer_ = false;
    return begin_anew(now);
  }
  if (last == most_members) return;
  Wish wish;
  wish.kind = WishKind::retire;
  wish.member = last;
  fulfil(wish, now);
}

void AttentionEvolution::begin_anew(Time now) noexcept {
  const std::size_t member = free_place();
  ParameterRequest request;
  request.kind = RequestKind::activate;
  add_genes(request, table_genes_);
  add_state(request, evolution_.new_identity(), false);
  begins_anew_ = true;
  send(request, member, now);
}

void AttentionEvolution::warn(Warning warning) noexcept {
  const char* const text = text_of(warning);
  if (feedback.warning_view() == text) return;
  feedback.set_warning(text);
  if (text[0] != '\0') log_warning(warnings_[static_cast<std::size_t>(warning)], name(), "{}", text);
}

const char* AttentionEvolution::text_of(Warning warning) noexcept {
  switch (warning) {
    case Warning::nothing_found:
      return "no member found anything for 5 generations: is the table empty, or are their weights unfit? "
             "Back to the saved generation brings good ones";
    case Warning::all_out_of_service:
      return "all members are in fault or stopped: initialise them on their pages, then give Start";
    case Warning::frozen_empty:
      return "no member is active, and the population is frozen";
    case Warning::begins_anew:
      return "no member is active: one begins anew with the weights of the table's row";
    case Warning::none:
      break;
  }
  return "";
}

}  // namespace flexrf::user
