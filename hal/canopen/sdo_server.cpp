#include "hal/canopen/sdo_server.hpp"

#include "hal/canopen/sdo_abort.hpp"
#include "hal/canopen/sdo_frames.hpp"

namespace flexrf::canopen {
namespace {

constexpr std::uint8_t begin_write_kind = 0x20;
constexpr std::uint8_t write_segment_kind = 0x00;

}  // namespace

std::optional<Message> SdoServer::receive(const Message& message) noexcept {
  if (message.identifier != identifier_of(sdo_request_base, node_) || message.size != 8 || message.remote)
    return std::nullopt;
  if (message.data[0] == sdo::abort) {
    open_ = Open::nothing;
    return std::nullopt;
  }
  const std::uint8_t kind = sdo::kind_of(message);
  if (kind == sdo::read_request || kind == begin_write_kind) {
    object_ = sdo::object_of(message);
    // As servers in the field do: what interrupts a transfer ends it and is not served either.
    if (open_ != Open::nothing) return abort(sdo_abort::bad_command);
    return kind == sdo::read_request ? begin_read() : begin_write(message);
  }
  if (kind == sdo::read_segment_request && open_ == Open::read) return read_segment(message);
  if (kind == write_segment_kind && open_ == Open::write) return write_segment(message);
  return abort(sdo_abort::bad_command);
}

Message SdoServer::answer(std::uint8_t command) const noexcept {
  return sdo::frame(identifier_of(sdo_answer_base, node_), command, object_);
}

Message SdoServer::abort(std::uint32_t code) noexcept {
  open_ = Open::nothing;
  Message message = answer(sdo::abort);
  write_number(&message.data[4], 4, code);
  return message;
}

Message SdoServer::begin_read() noexcept {
  size_ = 0;
  if (const std::uint32_t code = dictionary_->read(object_, value_, size_); code != 0) return abort(code);
  if (size_ >= 1 && size_ <= 4) {
    Message message = answer(sdo::expedited(sdo::read_expedited, size_));
    std::copy_n(value_.begin(), size_, message.data.begin() + 4);
    return message;
  }
  open_ = Open::read;
  toggle_ = false;
  sent_ = 0;
  Message message = answer(sdo::read_segmented);
  write_number(&message.data[4], 4, size_);
  return message;
}

Message SdoServer::begin_write(const Message& message) noexcept {
  if (sdo::is_expedited(message)) {
    const std::span<const std::uint8_t> value{message.data.data() + 4, sdo::expedited_size(message)};
    const std::uint32_t code = dictionary_->write(object_, value);
    return code != 0 ? abort(code) : answer(sdo::write_answer);
  }
  if (sdo::states_size(message) && read_number(&message.data[4], 4) > capacity) {
    return abort(sdo_abort::too_long);
  }
  open_ = Open::write;
  toggle_ = false;
  size_ = 0;
  return answer(sdo::write_answer);
}

Message SdoServer::read_segment(const Message& message) noexcept {
  if (sdo::toggle_of(message) != toggle_) return abort(sdo_abort::toggle);
  const std::size_t count = std::min<std::size_t>(size_ - sent_, 7);
  const Message result = sdo::segment(identifier_of(sdo_answer_base, node_), toggle_,
                                      {value_.data() + sent_, count}, sent_ + count == size_);
  sent_ += count;
  toggle_ = !toggle_;
  if (sent_ == size_) open_ = Open::nothing;
  return result;
}

Message SdoServer::write_segment(const Message& message) noexcept {
  if (sdo::toggle_of(message) != toggle_) return abort(sdo_abort::toggle);
  const std::size_t count = sdo::segment_size(message);
  if (size_ + count > capacity) return abort(sdo_abort::too_long);
  std::copy_n(message.data.begin() + 1, count, value_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += count;
  Message result{identifier_of(sdo_answer_base, node_), 8, {}};
  result.data[0] = sdo::with_toggle(sdo::write_segment_answer, toggle_);
  toggle_ = !toggle_;
  if (!sdo::is_last_segment(message)) return result;
  open_ = Open::nothing;
  const std::uint32_t code = dictionary_->write(object_, {value_.data(), size_});
  return code != 0 ? abort(code) : result;
}

}  // namespace flexrf::canopen
