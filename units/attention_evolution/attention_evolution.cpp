#include "units/attention_evolution/attention_evolution.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/executive/cell.hpp"

namespace flexrf::user {
namespace {

double number_in(const void* values, const FieldDescriptor& field) {
  const auto* const at = static_cast<const std::byte*>(values) + field.offset;
  if (field.scalar == Scalar::u32) {
    std::uint32_t whole = 0;
    std::memcpy(&whole, at, sizeof(whole));
    return whole;
  }
  double number = 0;
  std::memcpy(&number, at, sizeof(number));
  return number;
}

}  // namespace

Status AttentionEvolution::initialise() {
  read_ = {};
  last_frame_ = correlation_ = 0;
  judged_generation_ = findings_ = 0;
  barren_ = 0;
  begins_anew_ = finds_nothing_ = needs_newcomer_ = false;
  restored_ = most_members;
  varied_ = 0;
  begins_ = true;
  writes_saved_ = false;
  // What the members are now, not what they reported last to the unit as it was before.
  for (auto& one : reports) one.forget();
  if (const Status status = find_population(); !status) return status;
  return find_parameters();
}

Status AttentionEvolution::find_population() noexcept {
  const std::string_view wanted = configuration.population_view();
  for (const PopulationRecord& one : cell.cell().application().populations) {
    if (wanted != one.name) continue;
    capacity_ = one.capacity;
    first_ = one.first_unit;
    if (capacity_ > most_members || reports.size() != capacity_ || verdicts.size() > most_recognisers)
      return Status::error(
          StatusCode::invalid_argument,
          "%s: population '%s' has %zu members and %zu reports are connected, of %zu recognisers; "
          "all members' reports have to be, at most %zu of each",
          name(), one.name, capacity_, reports.size(), verdicts.size(), most_members);
    return {};
  }
  return Status::error(StatusCode::not_found,
                       "%s: there is no population '%.64s'; give configuration.population the name of the "
                       "attention's row",
                       name(), configuration.population.data());
}

Status AttentionEvolution::find_parameters() noexcept {
  const ParameterBlock& block = cell.cell().component_type(first_).runtime;
  std::array<GeneRange, gene_count> ranges{};
  for (std::size_t i = 0; i < gene_count; ++i) {
    gene_places_[i] = place_of(gene_names[i]);
    if (gene_places_[i].parameter == no_parameter)
      return Status::error(
          StatusCode::invalid_argument,
          "%s: members of '%.64s' have no weight '%s'; they have to be of the type attention", name(),
          configuration.population.data(), gene_names[i].data());
    const ParameterDescriptor& parameter = block.parameters[gene_places_[i].parameter];
    ranges[i] = {parameter.minimum, parameter.maximum, gene_places_[i].is_whole};
    table_genes_[i] = number_in(cell.cell().application().units[first_].runtime, *parameter.field);
  }
  identity_place_ = place_of("identity");
  probation_place_ = place_of("probation");
  evolution_.begin(configuration.seed, ranges);
  return {};
}

AttentionEvolution::Place AttentionEvolution::place_of(std::string_view parameter_name) const noexcept {
  const ParameterBlock& block = cell.cell().component_type(first_).runtime;
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    const FieldDescriptor& field = *block.parameters[i].field;
    if (parameter_name == field.name) return {static_cast<std::uint16_t>(i), field.scalar == Scalar::u32};
  }
  return {};
}

void AttentionEvolution::step(const Tick& tick) {
  const bool is_new_picture = look_at_members();
  look_at_hand();
  read_verdicts();
  hear_answers();
  if (begins_) begin();
  if (writes_saved_) write_saved();
  press_buttons();
  const bool may_change = !runtime.frozen && correlation_ == 0 && restored_ == most_members;
  if (is_new_picture) fulfil(evolution_.next_picture(rules(), may_change), tick.now);
  look_at_all(may_change && correlation_ == 0, tick.now);
  if (restored_ < most_members && correlation_ == 0) restore_next(tick.now);
  if (varied_ < capacity_ && may_change && correlation_ == 0) vary_next(tick.now);
  publish();
}

// ---- what happened

/// True: a picture was looked at that none was before.
bool AttentionEvolution::look_at_members() noexcept {
  bool is_new = false;
  for (std::size_t i = 0; i < capacity_; ++i) {
    const Evolution::Member& member = evolution_.member(i);
    const auto report = reports[i].latest();
    if (!is_active(i)) {
      if (member.active) evolution_.note_member(i, false, member.identity, false, {});
      continue;
    }
    // One that was begun just now has not reported: its place is taken all the same.
    if (!member.active) evolution_.note_member(i, true, 0, false, table_genes_);
    if (!report || !report.is_new()) continue;
    evolution_.note_member(i, true, report->identity, report->probation, report->genes);
    evolution_.note_picture(i, report->identity, report->frame, report->pixels);
    is_new = is_new || report->frame != last_frame_;
    last_frame_ = report->frame;
  }
  return is_new;
}

void AttentionEvolution::read_verdicts() noexcept {
  std::size_t recogniser = 0;
  for (auto& one : verdicts) {
    std::uint64_t& read = read_[recogniser++];
    const auto list = one.latest();
    if (!list || !list.is_new()) continue;
    // A recogniser that was constructed anew begins at 0 again.
    if (list->count < read) read = 0;
    const std::uint64_t kept = list->verdicts.size();
    read = std::max(read, list->count > kept ? list->count - kept : 0);
    for (; read < list->count; ++read) take(list->verdicts[read % kept]);
  }
}

void AttentionEvolution::take(const VisionVerdict& verdict) noexcept {
  if (verdict.region.member < capacity_ && verdict.verdict != VisualClass::nothing) ++findings_;
  evolution_.note_verdict(verdict, rules());
}

/// What is held is no longer followed on the table; the member that found it is left alone all the same.
void AttentionEvolution::look_at_hand() noexcept {
  for (std::size_t i = 0; i < capacity_; ++i) evolution_.note_target_in_hand(i, false);
  const auto hand = in_hand.latest();
  if (!hand || hand->track == 0) {
    in_hand_ = {};
    return;
  }
  if (const auto list = tracks.latest())
    for (const ObjectTrack& track : list->tracks)
      if (track.found != VisualClass::nothing && track.identity == hand->track) in_hand_ = track;
  if (in_hand_.identity != hand->track || in_hand_.member >= capacity_) return;
  if (evolution_.member(in_hand_.member).identity == in_hand_.member_identity)
    evolution_.note_target_in_hand(in_hand_.member, true);
}

// ---- what shall be done

void AttentionEvolution::fulfil(Wish wish, Time now) noexcept {
  if (wish.kind == WishKind::clone && !runs(wish.member)) {
    wish.member = free_place();
    if (wish.member == most_members)
      return complain("there is no place for a child: those that are free are in fault or stopped");
  }
  if (wish.kind == WishKind::none) return;
  ParameterRequest request;
  switch (wish.kind) {
    case WishKind::retire:
      request.kind = RequestKind::retire;
      break;
    case WishKind::clone:
      request.kind = RequestKind::clone;
      request.source = static_cast<ComponentIndex>(first_ + wish.parent);
      add_genes(request, wish.genes);
      add_state(request, wish.identity, true);
      break;
    case WishKind::trust:
      request.kind = RequestKind::set;
      add_state(request, evolution_.member(wish.member).identity, false);
      break;
    case WishKind::none:
      return;
  }
  asked_ = wish;
  send(request, wish.member, now);
}

void AttentionEvolution::send(ParameterRequest& request, std::size_t member, Time now) noexcept {
  request.component = static_cast<ComponentIndex>(first_ + member);
  correlation_ = cell.send(request, now);
}

void AttentionEvolution::add_genes(ParameterRequest& request, const Genes& genes) const noexcept {
  for (std::size_t i = 0; i < gene_count; ++i) {
    const auto whole = static_cast<std::uint32_t>(genes[i]);
    if (gene_places_[i].is_whole)
      request.add(gene_places_[i].parameter, 0, &whole, sizeof(whole));
    else
      request.add(gene_places_[i].parameter, 0, &genes[i], sizeof(genes[i]));
  }
}

void AttentionEvolution::add_state(ParameterRequest& request, std::uint32_t identity,
                                   bool probation) const noexcept {
  request.add(identity_place_.parameter, 0, &identity, sizeof(identity));
  request.add(probation_place_.parameter, 0, &probation, sizeof(probation));
}

void AttentionEvolution::hear_answers() noexcept {
  ParameterAnswer answer;
  while (cell.take_answer(answer)) {
    if (answer.correlation != correlation_) continue;  // of before a restart
    correlation_ = 0;
    begins_anew_ = false;
    const Wish done = std::exchange(asked_, Wish{});
    if (answer.kind != AnswerKind::accepted) {
      ++feedback.refused;
      complain(answer.kind == AnswerKind::busy ? "the population's thread is busy" : answer.reason);
      continue;
    }
    switch (done.kind) {
      case WishKind::clone:
        evolution_.note_birth(done);
        ++feedback.births;
        break;
      case WishKind::retire:
        ++feedback.deaths;
        break;
      case WishKind::trust:
        ++feedback.promotions;
        break;
      case WishKind::none:
        break;
    }
  }
}

void AttentionEvolution::press_buttons() noexcept {
  if (runtime.save > 0) save_generation();
  if (runtime.restore == 0) return;
  if (!has_saved()) {
    complain("no generation was saved yet: Save this generation keeps one to come back to");
    return;
  }
  restored_ = 0;
  feedback.set_trouble({});
}

bool AttentionEvolution::has_saved() const noexcept {
  return std::any_of(runtime.saved_members.begin(), runtime.saved_members.end(),
                     [](bool saved) { return saved; });
}

/// A population that begins with the tables' weights becomes the saved one, if there is one: weights of other
/// members do not outlast a run.
void AttentionEvolution::begin() noexcept {
  begins_ = false;
  for (std::size_t i = 0; i < capacity_; ++i) {
    const Evolution::Member& member = evolution_.member(i);
    if (member.active && (member.identity != 0 || member.genes != table_genes_)) return;
  }
  if (!has_saved()) return;
  restored_ = 0;
  varied_ = capacity_;
}

/// Those on probation are not kept: they have not shown what they are worth.
void AttentionEvolution::save_generation() noexcept {
  bool any = false;
  for (std::size_t i = 0; i < capacity_; ++i)
    any = any || (evolution_.member(i).active && !evolution_.member(i).probation);
  if (!any) return complain("no member is trusted: there is no generation to save");
  for (std::size_t i = 0; i < most_members; ++i) {
    const Evolution::Member& member = evolution_.member(i);
    runtime.saved_members[i] = i < capacity_ && member.active && !member.probation;
    std::copy(member.genes.begin(), member.genes.end(),
              runtime.saved_genes.begin() + static_cast<std::ptrdiff_t>(i * gene_count));
  }
  feedback.set_trouble({});
  writes_saved_ = true;  // in the next step, when the values are in force
}

void AttentionEvolution::write_saved() noexcept {
  writes_saved_ = false;
  if (cell.cell().saver() == nullptr)
    return complain("the generation is kept until the end: nothing is saved here");
  if (const auto begun = cell.save_values(); !begun) complain(begun.status().cause());
}

/// Members that all look at the same see no more than one of them. So at the start all but the first are made
/// different, one request at a time, and are on probation from then on; those that somebody changed stay as
/// they are.
void AttentionEvolution::vary_next(Time now) noexcept {
  for (; varied_ < capacity_; ++varied_) {
    const Evolution::Member& member = evolution_.member(varied_);
    const bool is_of_table = member.active && member.identity == 0 && member.genes == table_genes_;
    if (varied_ == 0 || !is_of_table || configuration.variety == 0) continue;
    ParameterRequest request;
    request.kind = RequestKind::set;
    add_genes(request, evolution_.varied(table_genes_, configuration.variety));
    add_state(request, evolution_.new_identity(), true);
    send(request, varied_++, now);
    return;
  }
}

/// One request at a time, until a member needs none.
void AttentionEvolution::restore_next(Time now) noexcept {
  while (restored_ < most_members && correlation_ == 0) {
    if (restored_ < capacity_ && evolution_.member(restored_).is_target_in_hand)
      complain("a member was left as it is: its region is the target in hand");
    else if (restored_ < capacity_)
      restore_member(restored_, now);
    ++restored_;
  }
}

void AttentionEvolution::restore_member(std::size_t member, Time now) noexcept {
  const bool active = is_active(member);
  if (!runtime.saved_members[member]) {
    if (!active) return;
    Wish wish;
    wish.kind = WishKind::retire;
    wish.member = member;
    return fulfil(wish, now);
  }
  Genes genes{};
  std::copy_n(runtime.saved_genes.begin() + static_cast<std::ptrdiff_t>(member * gene_count), gene_count,
              genes.begin());
  ParameterRequest request;
  request.kind = active ? RequestKind::set : RequestKind::activate;
  add_genes(request, genes);
  add_state(request, evolution_.new_identity(), false);
  send(request, member, now);
}

// ---- what is told

void AttentionEvolution::complain(const char* trouble) noexcept {
  feedback.set_trouble(trouble);
  log_warning(troubles_, name(), "{}", trouble);
}

void AttentionEvolution::publish() noexcept {
  AttentionGeneration now{};
  now.generation = evolution_.generation();
  now.frozen = runtime.frozen;
  feedback.active = feedback.on_probation = 0;
  feedback.best_fitness = 0;
  for (std::size_t i = 0; i < capacity_; ++i) {
    const Evolution::Member& member = evolution_.member(i);
    if (!member.active) continue;
    AttentionMember& told = now.members[i];
    told.active = true;
    told.probation = member.probation;
    told.is_protected = member.is_target_in_hand || member.is_among_the_best;
    told.identity = member.identity;
    told.parent = member.parent;
    told.frames = member.frames;
    told.fitness = 1e6 * member.fitness();
    told.standing = member.standing();
    told.cost = declared_cost(member.genes);
    told.genes = member.genes;
    ++feedback.active;
    if (member.probation)
      ++feedback.on_probation;
    else
      feedback.best_fitness = std::max(feedback.best_fitness, told.fitness);
  }
  feedback.generation = now.generation;
  feedback.cost = evolution_.declared_cost_of_all();
  feedback.held_back = evolution_.held_back();
  const bool has_asked_to_restore = correlation_ != 0 && asked_.kind == WishKind::none && !begins_anew_;
  feedback.restoring = restored_ < most_members || has_asked_to_restore;
  if (feedback.cost > runtime.cost_cap)
    restrain("members cost more by declaration than all together may", feedback.cost, runtime.cost_cap);
  generation.publish(now);
}

EvolutionRules AttentionEvolution::rules() const noexcept {
  EvolutionRules rules;
  rules.generation_frames = runtime.generation_frames;
  rules.probation_frames = runtime.probation_frames;
  rules.probation_floor = runtime.probation_floor;
  rules.wanted = runtime.wanted;
  rules.cost_cap = runtime.cost_cap;
  rules.mutation = runtime.mutation;
  rules.tournament = runtime.tournament;
  rules.memory = runtime.memory;
  rules.obstacle_worth = runtime.obstacle_worth;
  rules.least_overlap = runtime.least_overlap;
  return rules;
}

}  // namespace flexrf::user
