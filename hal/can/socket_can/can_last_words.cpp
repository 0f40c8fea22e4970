#include "hal/can/socket_can/can_last_words.hpp"

#include <span>

#include "runtime/realtime/last_gasp.hpp"

namespace flexrf {
namespace {

void put(int slot, const CanSocket& socket, const CanFrame& frame) noexcept {
  const can_frame bytes = CanSocket::as_kernel_takes(frame);
  last_gasp::prepare_write(slot, socket.descriptor(), std::as_bytes(std::span{&bytes, 1}));
}

}  // namespace

CanLastWords::~CanLastWords() {
  for (const int place : places_) last_gasp::release_slot(place);
  last_gasp::release_slot(to_all_);
}

int CanLastWords::claim() {
  if (to_all_ < 0) to_all_ = last_gasp::claim_slot(last_gasp::Turn::last);
  if (to_all_ < 0) return none;
  const int place = last_gasp::claim_slot();
  if (place >= 0) places_.push_back(place);
  return place;
}

void CanLastWords::release(int place) noexcept {
  if (std::erase(places_, place) > 0) last_gasp::release_slot(place);
  if (places_.empty()) last_gasp::clear(to_all_);
}

void CanLastWords::clear() noexcept {
  for (const int place : places_) last_gasp::clear(place);
  last_gasp::clear(to_all_);
}

void CanLastWords::prepare(int place, const CanSocket& socket, const CanFrame& word,
                           const CanFrame& all) const noexcept {
  if (socket.descriptor() < 0) return;
  put(place, socket, word);
  put(to_all_, socket, all);
}

}  // namespace flexrf
