// AttentionEvolution: tells Evolution what the population did, and has done what Evolution wishes.
#pragma once

#include <array>

#include "attention_evolution_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/vision/evolution.hpp"

namespace flexrf::user {

class AttentionEvolution final : public AttentionEvolutionUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  static constexpr std::size_t most_recognisers = 16;
  enum class Warning : std::uint8_t { none, nothing_found, all_out_of_service, frozen_empty, begins_anew };
  /// A runtime parameter of the members: its place in their table.
  struct Place {
    std::uint16_t parameter = no_parameter;
    bool is_whole = false;
  };

  Status find_population() noexcept;
  Status find_parameters() noexcept;
  Place place_of(std::string_view name) const noexcept;
  bool runs(std::size_t member) const noexcept;
  bool is_active(std::size_t member) const noexcept;
  std::size_t free_place() const noexcept;

  bool look_at_members() noexcept;
  void read_verdicts() noexcept;
  void take(const VisionVerdict& verdict) noexcept;
  void look_at_hand() noexcept;
  void look_at_all(bool may_change, Time now) noexcept;

  void fulfil(Wish wish, Time now) noexcept;
  bool has_table_genes() const noexcept;
  void make_room_or_begin(Time now) noexcept;
  void begin_anew(Time now) noexcept;
  void hear_answers() noexcept;
  void press_buttons() noexcept;
  bool has_saved() const noexcept;
  void begin() noexcept;
  void save_generation() noexcept;
  void write_saved() noexcept;
  void vary_next(Time now) noexcept;
  void restore_next(Time now) noexcept;
  void restore_member(std::size_t member, Time now) noexcept;
  void send(ParameterRequest& request, std::size_t member, Time now) noexcept;
  void add_genes(ParameterRequest& request, const Genes& genes) const noexcept;
  void add_state(ParameterRequest& request, std::uint32_t identity, bool probation) const noexcept;
  void complain(const char* trouble) noexcept;
  void warn(Warning warning) noexcept;
  static const char* text_of(Warning warning) noexcept;
  void publish() noexcept;
  EvolutionRules rules() const noexcept;

  Evolution evolution_;
  std::array<Place, gene_count> gene_places_{};
  Place identity_place_;
  Place probation_place_;
  Genes table_genes_{};  // of members that have not reported yet
  std::size_t capacity_ = 0;
  ComponentIndex first_ = 0;
  std::array<std::uint64_t, most_recognisers> read_{};
  std::uint64_t last_frame_ = 0;
  ObjectTrack in_hand_{};                // the target in hand, as it was followed last
  Wish asked_;                           // whose answer has not come
  std::uint64_t correlation_ = 0;        // of the request under way; 0: none is
  std::size_t restored_ = most_members;  // next member to bring back; most_members: none
  std::size_t varied_ = 0;               // next member to be made different from the table; capacity_: none
  bool begins_ = true;                   // no step was made yet
  bool writes_saved_ = false;
  bool begins_anew_ = false;  // the request under way is for a first member
  std::uint64_t judged_generation_ = 0;
  std::uint64_t findings_ = 0;  // of all members, in the generation under way
  std::uint32_t barren_ = 0;    // generations before it in which nobody found anything
  bool finds_nothing_ = false;  // in too many of them
  bool needs_newcomer_ = false;
  LogLimit troubles_;
  std::array<LogLimit, 5> warnings_;  // of each
};

}  // namespace flexrf::user
