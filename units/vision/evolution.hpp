// Evolution: which members of a population of attention shall stay, go, and have children.
//
// Pure: it is told what happened and what is wished of it, and says what it wants done. Who sends requests to
// the cell, and has their answers, is the unit attention_evolution.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "types/vision_verdict.hpp"
#include "units/vision/attention_genes.hpp"

namespace flexrf::user {

struct GeneRange {
  double lowest = 0;
  double highest = 1;
  bool is_whole = false;  ///< whole numbers only
};

struct EvolutionRules {
  std::uint32_t generation_frames = 30;  ///< pictures from one generation to the next
  std::uint32_t probation_frames = 30;   ///< in which a new member is judged before it is trusted
  double probation_floor = 1.0;  ///< what it has to find, as part of what the trusted ones do for its cost
  std::uint32_t wanted = 8;      ///< members that shall be active
  double cost_cap = 2e6;         ///< declared cost of a picture, all members together, in values
  double mutation = 0.15;        ///< standard deviation of a gene's largest changes, as part of its range
  std::uint32_t tournament = 3;  ///< members of which the best becomes a parent
  double memory = 0.9;           ///< what a judgement counts a generation later
  double obstacle_worth = 0.25;  ///< of an obstacle; a target counts 1
  double least_overlap = 0.5;    ///< of region and thing, that the region counts as holding it
};

/// One thing that a region held.
struct Sighting {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< on the table, m
  bool is_target = false;
};

enum class WishKind : std::uint8_t { none, retire, clone, trust };
/// What shall be done with a member.
struct Wish {
  WishKind kind = WishKind::none;
  std::size_t member = 0;
  std::size_t parent = 0;      ///< clone: the member whose place its genes come from
  std::uint32_t identity = 0;  ///< clone: of the new member
  Genes genes{};               ///< clone: mutated
};

/// Fitness is distinct relevant objects per declared cost: of each picture in which at least one of a
/// member's regions was judged, the distinct objects in these regions count for it, and the member's values
/// that were read, its part of the features, and the judged regions count against it. Regions that nobody
/// took count neither way. Of one thread; allocates nothing.
class Evolution {
 public:
  struct Member {
    bool active = false;
    bool probation = false;
    bool is_target_in_hand = false;
    bool is_among_the_best = false;
    std::uint32_t identity = 0;
    std::uint32_t parent = 0;
    std::uint32_t frames = 0;  ///< in which it was judged
    double objects = 0;        ///< worth of those it found, older ones counting less
    double cost = 0;           ///< likewise
    double found = 0;          ///< as objects, of pictures that are settled
    double expected = 0;       ///< what the trusted would have found in these pictures at its cost
    Genes genes{};

    double fitness() const noexcept { return cost > 0 ? objects / cost : 0.0; }
    /// Against the trusted ones, in the same pictures: 1 as they on average. What members are chosen by: how
    /// much there is to be found changes more from picture to picture than from member to member.
    double standing() const noexcept { return expected > 0 ? found / expected : 0.0; }
  };

  void begin(std::uint64_t seed, std::span<const GeneRange, gene_count> ranges) noexcept;

  // ---- what happened

  /// How the member is now. One that has another identity than before begins anew.
  void note_member(std::size_t member, bool active, std::uint32_t identity, bool probation,
                   const Genes& genes) noexcept;
  /// A wish to clone was granted.
  void note_birth(const Wish& wish) noexcept;
  void note_target_in_hand(std::size_t member, bool is_so) noexcept;
  /// The member looked at this picture, and read so many values.
  void note_picture(std::size_t member, std::uint32_t identity, std::uint64_t frame, double values) noexcept;
  /// A region of the member's in that picture was judged, which took so many pixels. Once for each region.
  void note_judged(std::size_t member, std::uint32_t identity, std::uint64_t frame, double pixels) noexcept;
  /// What recognition says of a region: that it was judged, and what it held. A region holds what it fits: a
  /// large one with something small in it has told nobody where that is.
  void note_verdict(const VisionVerdict& verdict, const EvolutionRules& rules) noexcept;
  /// It held this.
  void note_sighting(std::size_t member, std::uint32_t identity, std::uint64_t frame, const Sighting& seen,
                     const EvolutionRules& rules) noexcept;

  // ---- what shall be done

  /// After each picture: what is wanted of the population, at most one thing, and nothing while `may_change`
  /// is false, as when it is frozen or the last wish was not answered yet.
  Wish next_picture(const EvolutionRules& rules, bool may_change) noexcept;

  /// The genes changed at random, by `deviation` (a standard deviation, as part of each one's range).
  Genes varied(const Genes& genes, double deviation) noexcept { return mutated(genes, deviation); }

  /// For a member that comes by another way, as a saved one.
  std::uint32_t new_identity() noexcept { return next_identity_++; }

  const Member& member(std::size_t index) const noexcept { return members_[index]; }
  std::uint64_t generation() const noexcept { return generation_; }
  /// Of all active members.
  double declared_cost_of_all() const noexcept;
  /// Children that were not born because all would cost too much.
  std::uint64_t held_back() const noexcept { return held_back_; }

 private:
  /// What is still expected of a picture: verdicts come late.
  struct Picture {
    std::uint64_t frame = 0;
    std::uint32_t identity = 0;
    bool is_open = false;
    bool is_judged = false;
    bool is_settled = false;
    double values = 0;
    double cost = 0;   ///< of what was judged
    double worth = 0;  ///< of what was found
    std::array<Sighting, most_regions> seen{};
    std::size_t seen_count = 0;
  };
  static constexpr std::size_t pictures_kept = 16;
  /// So many pictures later its verdicts are in.
  static constexpr std::uint64_t settled_after = 5;

  Picture* find(std::size_t member, std::uint32_t identity, std::uint64_t frame) noexcept;
  bool is_protected(std::size_t member) const noexcept {
    return members_[member].is_target_in_hand || members_[member].is_among_the_best;
  }
  bool is_established(std::size_t member) const noexcept {
    return members_[member].active && !members_[member].probation && members_[member].expected > 0;
  }
  std::size_t active_count() const noexcept;
  void settle_pictures() noexcept;
  bool oldest_to_settle(std::uint64_t& frame) const noexcept;
  void settle(std::uint64_t frame) noexcept;
  void mark_the_best() noexcept;
  Wish judge_probation(const EvolutionRules& rules) noexcept;
  Wish make_room(const EvolutionRules& rules) noexcept;
  Wish make_child(const EvolutionRules& rules) noexcept;
  std::size_t choose_parent(const EvolutionRules& rules) noexcept;
  Genes mutated(Genes genes, double deviation) noexcept;

  std::array<Member, most_members> members_{};
  std::array<std::array<Picture, pictures_kept>, most_members> pictures_{};
  std::array<GeneRange, gene_count> ranges_{};
  RandomSource random_{0};
  std::uint64_t generation_ = 0;
  std::uint64_t held_back_ = 0;
  std::uint64_t newest_ = 0;  // picture
  std::uint32_t frames_of_generation_ = 0;
  std::uint32_t next_identity_ = 1;
  bool replaces_ = false;  // a generation has ended: one member may go, and one come
};

}  // namespace flexrf::user
