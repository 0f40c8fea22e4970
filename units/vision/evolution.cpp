#include "units/vision/evolution.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

constexpr double same_object = 0.015;  // m: two sightings no further apart are one object
constexpr int tries = 8;               // to find a child that is not too dear
constexpr std::size_t kept_for_ever = 2;

}  // namespace

void Evolution::begin(std::uint64_t seed, std::span<const GeneRange, gene_count> ranges) noexcept {
  *this = Evolution{};
  std::copy(ranges.begin(), ranges.end(), ranges_.begin());
  random_ = RandomSource(seed);
}

// ---- what happened

void Evolution::note_member(std::size_t member, bool active, std::uint32_t identity, bool probation,
                            const Genes& genes) noexcept {
  Member& one = members_[member];
  if (one.active != active || one.identity != identity) {
    const std::uint32_t parent = one.identity == identity ? one.parent : 0;
    one = Member{};
    one.parent = parent;
    pictures_[member] = {};
  }
  one.active = active;
  one.identity = identity;
  one.probation = probation;
  one.genes = genes;
  next_identity_ = std::max(next_identity_, identity + 1);
}

void Evolution::note_birth(const Wish& wish) noexcept {
  note_member(wish.member, true, wish.identity, true, wish.genes);
  members_[wish.member].parent = members_[wish.parent].identity;
}

void Evolution::note_target_in_hand(std::size_t member, bool is_so) noexcept {
  members_[member].is_target_in_hand = is_so;
}

Evolution::Picture* Evolution::find(std::size_t member, std::uint32_t identity,
                                    std::uint64_t frame) noexcept {
  Picture& picture = pictures_[member][frame % pictures_kept];
  return picture.is_open && picture.frame == frame && picture.identity == identity ? &picture : nullptr;
}

void Evolution::note_picture(std::size_t member, std::uint32_t identity, std::uint64_t frame,
                             double values) noexcept {
  Picture& picture = pictures_[member][frame % pictures_kept];
  picture = Picture{};
  picture.frame = frame;
  picture.identity = identity;
  picture.is_open = true;
  picture.values = values;
}

void Evolution::note_judged(std::size_t member, std::uint32_t identity, std::uint64_t frame,
                            double pixels) noexcept {
  Picture* const picture = find(member, identity, frame);
  if (picture == nullptr) return;
  Member& one = members_[member];
  if (!picture->is_judged) {
    picture->is_judged = true;
    ++one.frames;
    one.cost += values_of_features + picture->values;
  }
  one.cost += values_per_region + pixels;
}

void Evolution::note_sighting(std::size_t member, std::uint32_t identity, std::uint64_t frame,
                              const Sighting& seen, const EvolutionRules& rules) noexcept {
  Picture* const picture = find(member, identity, frame);
  if (picture == nullptr) return;
  for (std::size_t i = 0; i < picture->seen_count; ++i) {
    const Sighting& before = picture->seen[i];
    if (before.is_target == seen.is_target && (before.position - seen.position).norm() < same_object) return;
  }
  if (picture->seen_count == picture->seen.size()) return;  // as many as regions: more cannot be distinct
  picture->seen[picture->seen_count++] = seen;
  members_[member].objects += seen.is_target ? 1.0 : rules.obstacle_worth;
}

// ---- what shall be done

Wish Evolution::next_picture(const EvolutionRules& rules, bool may_change) noexcept {
  mark_the_best();
  if (++frames_of_generation_ >= rules.generation_frames) {
    frames_of_generation_ = 0;
    ++generation_;
    replaces_ = true;
    for (Member& one : members_) {
      one.objects *= rules.memory;
      one.cost *= rules.memory;
    }
  }
  if (!may_change) return {};
  if (const Wish wish = judge_probation(rules); wish.kind != WishKind::none) return wish;
  if (!replaces_) return {};
  if (active_count() >= rules.wanted || declared_cost_of_all() > rules.cost_cap) {
    const Wish wish = make_room(rules);
    replaces_ = wish.kind != WishKind::none;
    return wish;
  }
  replaces_ = false;
  const std::uint64_t held_back = held_back_;
  const Wish birth = make_child(rules);
  // Where a child would be too dear the worst goes, and the next generation has one.
  return held_back_ > held_back ? make_room(rules) : birth;
}

/// Trusted when it was judged long enough and is good enough; retired when it was judged twice as long and is
/// not.
Wish Evolution::judge_probation(const EvolutionRules& rules) noexcept {
  const double floor = rules.probation_floor * mean_fitness();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& one = members_[i];
    if (!one.active || !one.probation || one.frames < rules.probation_frames) continue;
    Wish wish;
    wish.member = i;
    if (one.fitness() > 0 && one.fitness() >= floor) {
      wish.kind = WishKind::trust;
      return wish;
    }
    if (one.frames < 2 * rules.probation_frames || one.is_target_in_hand) continue;
    wish.kind = WishKind::retire;
    return wish;
  }
  return {};
}

/// The worst of those that were judged long enough and are not protected.
Wish Evolution::make_room(const EvolutionRules& rules) noexcept {
  Wish wish;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!is_established(i) || is_protected(i) || members_[i].frames < rules.probation_frames) continue;
    if (wish.kind == WishKind::retire && members_[i].fitness() >= members_[wish.member].fitness()) continue;
    wish.kind = WishKind::retire;
    wish.member = i;
  }
  return wish;
}

Wish Evolution::make_child(const EvolutionRules& rules) noexcept {
  const auto place =
      std::find_if(members_.begin(), members_.end(), [](const Member& one) { return !one.active; });
  const std::size_t parent = choose_parent(rules);
  if (place == members_.end() || parent == most_members) return {};
  Wish wish;
  wish.member = static_cast<std::size_t>(place - members_.begin());
  wish.parent = parent;
  const double left = rules.cost_cap - declared_cost_of_all();
  for (int i = 0; i < tries; ++i) {
    wish.genes = mutated(members_[parent].genes, rules.mutation);
    if (declared_cost(wish.genes) > left) continue;
    wish.kind = WishKind::clone;
    wish.identity = new_identity();
    return wish;
  }
  ++held_back_;
  return {};
}

/// The best of some that are drawn with replacement; most_members: there is none to draw.
std::size_t Evolution::choose_parent(const EvolutionRules& rules) noexcept {
  std::array<std::size_t, most_members> candidates{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (is_established(i)) candidates[count++] = i;
  if (count == 0) return most_members;
  std::size_t best = candidates[random_.below(count)];
  for (std::uint32_t i = 1; i < rules.tournament; ++i) {
    const std::size_t other = candidates[random_.below(count)];
    if (members_[other].fitness() > members_[best].fitness()) best = other;
  }
  return best;
}

/// What would leave its range is reflected at its end.
Genes Evolution::mutated(Genes genes, double deviation) noexcept {
  for (std::size_t i = 0; i < genes.size(); ++i) {
    const GeneRange& range = ranges_[i];
    const double width = range.highest - range.lowest;
    double value = genes[i] + random_.normal() * deviation * width;
    if (value < range.lowest) value = 2 * range.lowest - value;
    if (value > range.highest) value = 2 * range.highest - value;
    value = std::clamp(value, range.lowest, range.highest);
    genes[i] = range.is_whole ? std::round(value) : value;
  }
  return genes;
}

void Evolution::mark_the_best() noexcept {
  for (Member& one : members_) one.is_among_the_best = false;
  for (std::size_t n = 0; n < kept_for_ever; ++n) {
    Member* best = nullptr;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      Member& one = members_[i];
      if (is_established(i) && !one.is_among_the_best && (best == nullptr || one.fitness() > best->fitness()))
        best = &one;
    }
    if (best != nullptr) best->is_among_the_best = true;
  }
}

double Evolution::declared_cost_of_all() const noexcept {
  double sum = 0;
  for (const Member& one : members_)
    if (one.active) sum += declared_cost(one.genes);
  return sum;
}

std::size_t Evolution::active_count() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(members_.begin(), members_.end(), [](const Member& one) { return one.active; }));
}

/// Of the trusted.
double Evolution::mean_fitness() const noexcept {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!is_established(i)) continue;
    sum += members_[i].fitness();
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace flexrf::user
