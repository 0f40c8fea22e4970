#include "units/vision/evolution.hpp"

#include <algorithm>
#include <cmath>

#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {
namespace {

constexpr double same_object = 0.015;  // m: two sightings no further apart are one object
constexpr int tries = 8;               // to find a child that is not too dear
constexpr std::size_t kept_for_ever = 2;
constexpr double share_changed = 0.3;  // of a child's weights
constexpr double hopeless = 0.6;       // of what a child has to reach: so far below it goes early
constexpr double smallest_step = 4;    // halvings of the largest

/// Of the area that region and thing cover together, the part that both cover (intersection over union).
double overlap_of(const VisionVerdict& verdict) noexcept {
  const VisionRegion& region = verdict.region;
  const PixelRectangle one{region.left, region.top, region.width, region.height};
  const PixelRectangle other{verdict.left, verdict.top, verdict.width, verdict.height};
  const PixelRectangle both = common_part(one, other);
  if (both.is_empty()) return 0;
  const double shared = static_cast<double>(both.width) * both.height;
  return shared / (static_cast<double>(one.width) * one.height +
                   static_cast<double>(other.width) * other.height - shared);
}

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
  newest_ = frame;
}

void Evolution::note_judged(std::size_t member, std::uint32_t identity, std::uint64_t frame,
                            double pixels) noexcept {
  Picture* const picture = find(member, identity, frame);
  if (picture == nullptr) return;
  Member& one = members_[member];
  if (!picture->is_judged) {
    picture->is_judged = true;
    ++one.frames;
    picture->cost = values_of_features + picture->values;
    one.cost += picture->cost;
  }
  picture->cost += values_per_region + pixels;
  one.cost += values_per_region + pixels;
}

/// The region's own pixels count, whether they were looked at, or what they hold was known already from
/// another member's: else it would depend on the order of jobs which of two is the dearer.
void Evolution::note_verdict(const VisionVerdict& verdict, const EvolutionRules& rules) noexcept {
  const VisionRegion& region = verdict.region;
  if (region.member >= most_members) return;
  if (verdict.part == 0)
    note_judged(region.member, region.identity, region.frame,
                static_cast<double>(region.width) * region.height);
  if (verdict.verdict == VisualClass::nothing || overlap_of(verdict) < rules.least_overlap) return;
  note_sighting(region.member, region.identity, region.frame,
                {verdict.position_map(), verdict.verdict == VisualClass::target}, rules);
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
  const double worth = seen.is_target ? 1.0 : rules.obstacle_worth;
  picture->worth += worth;
  members_[member].objects += worth;
}

void Evolution::settle_pictures() noexcept {
  for (std::uint64_t frame = 0; oldest_to_settle(frame);) settle(frame);
}

bool Evolution::oldest_to_settle(std::uint64_t& frame) const noexcept {
  bool any = false;
  for (const auto& of_member : pictures_) {
    for (const Picture& picture : of_member) {
      // A camera that counts anew has newer ones of less.
      const bool is_due = picture.frame + settled_after <= newest_ || picture.frame > newest_;
      if (!picture.is_judged || picture.is_settled || !is_due) continue;
      if (any && picture.frame >= frame) continue;
      any = true;
      frame = picture.frame;
    }
  }
  return any;
}

/// What the trusted members found in this picture per cost is what there was to be found; where none was
/// judged, what all did.
void Evolution::settle(std::uint64_t frame) noexcept {
  double worth = 0;
  double cost = 0;
  const auto picture_of = [&](std::size_t member) -> Picture* {
    Picture& picture = pictures_[member][frame % pictures_kept];
    return picture.is_judged && picture.frame == frame ? &picture : nullptr;
  };
  const auto add = [&](bool on_probation) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Picture* const picture = picture_of(i);
      if (picture == nullptr || members_[i].probation != on_probation) continue;
      worth += picture->worth;
      cost += picture->cost;
    }
  };
  add(false);
  if (cost == 0) add(true);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Picture* const picture = picture_of(i);
    if (picture == nullptr) continue;
    picture->is_settled = true;
    if (worth == 0) continue;  // nothing was there
    members_[i].found += picture->worth;
    members_[i].expected += picture->cost * worth / cost;
  }
}

// ---- what shall be done

Wish Evolution::next_picture(const EvolutionRules& rules, bool may_change) noexcept {
  settle_pictures();
  mark_the_best();
  if (++frames_of_generation_ >= rules.generation_frames) {
    frames_of_generation_ = 0;
    ++generation_;
    replaces_ = true;
    for (Member& one : members_) {
      one.objects *= rules.memory;
      one.cost *= rules.memory;
      one.found *= rules.memory;
      one.expected *= rules.memory;
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
/// not, or is far from it after a few pictures.
Wish Evolution::judge_probation(const EvolutionRules& rules) noexcept {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& one = members_[i];
    if (!one.active || !one.probation || !(one.expected > 0)) continue;
    const bool is_good = one.found > 0 && one.standing() >= rules.probation_floor;
    const bool is_hopeless = one.standing() < hopeless * rules.probation_floor;
    Wish wish;
    wish.member = i;
    if (is_good && one.frames >= rules.probation_frames) {
      wish.kind = WishKind::trust;
      return wish;
    }
    const bool was_judged_enough =
        one.frames >= 2 * rules.probation_frames || (is_hopeless && one.frames >= rules.probation_frames / 2);
    if (is_good || !was_judged_enough || one.is_target_in_hand) continue;
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
    if (wish.kind == WishKind::retire && members_[i].standing() >= members_[wish.member].standing()) continue;
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
    if (members_[other].standing() > members_[best].standing()) best = other;
  }
  return best;
}

/// Some weights change, and all of these by large or all by small steps: large ones find what is far better,
/// small ones what is a little better. What would leave its range is reflected at its end.
Genes Evolution::mutated(Genes genes, double deviation) noexcept {
  const double step = deviation * std::exp2(-smallest_step * random_.uniform());
  const std::size_t changed = random_.below(genes.size());  // this one in any case
  for (std::size_t i = 0; i < genes.size(); ++i) {
    const GeneRange& range = ranges_[i];
    const double width = range.highest - range.lowest;
    if (random_.uniform() >= share_changed && i != changed) continue;
    double value = genes[i] + random_.normal() * step * width;
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
      if (is_established(i) && !one.is_among_the_best &&
          (best == nullptr || one.standing() > best->standing()))
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

}  // namespace flexrf::user
