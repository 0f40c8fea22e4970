#include "hal/modbus/link/client/modbus_client.hpp"

#include <arpa/inet.h>
#include <modbus.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>

namespace flexrf {
namespace {

constexpr std::size_t tcp_header = 7;  // with the unit id
constexpr std::size_t crc_bytes = 2;

constexpr Duration shortest_silence = std::chrono::microseconds(1750);  // also above 19200 bit/s

const char* advice_to_open(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "is the adapter plugged in, and the name right (see /dev/serial/by-id)?";
    case EACCES:
    case EPERM:
      return "the user needs the right to it, as through the group dialout";
    case EBUSY:
      return "another program has it open";
    case ECONNREFUSED:
      return "the machine is there, but nothing listens on this port";
    case ETIMEDOUT:
    case EHOSTUNREACH:
    case ENETUNREACH:
      return "is it switched on, and the cable plugged in?";
    default:
      return "it is tried again";
  }
}

bool is_pseudo_terminal(int line) noexcept {
  struct stat status {};
  return fstat(line, &status) == 0 && major(status.st_rdev) >= 136 && major(status.st_rdev) <= 143;
}

void limit_answers(_modbus* context, Duration timeout) noexcept {
  const auto microseconds = static_cast<std::uint32_t>(timeout.count() / 1000);
  modbus_set_response_timeout(context, microseconds / 1000000, microseconds % 1000000);
}

/// Bytes of request and answer together, unit id and CRC included (Modbus Application Protocol V1.1b3, 6.1 to
/// 6.6, 6.11, 6.12; Modbus over serial line V1.02, 2.5.1). A single value may be written by two functions:
/// the longer one counts.
std::int64_t bytes_of(const ModbusBlock& block, bool writes) noexcept {
  const bool registers =
      block.area == ModbusArea::holding_register || block.area == ModbusArea::input_register;
  const std::int64_t data = registers ? 2 * block.count : (block.count + 7) / 8;
  constexpr std::int64_t address_and_count = 8;
  if (!writes) return address_and_count + 5 + data;
  return address_and_count + 9 + data;
}

/// Two masters on one line garble each other. The lock keeps out who asks for it, as every link does, root's
/// too; exclusive use all others. A pseudo-terminal would stay exclusive after who claimed it crashed, as
/// long as its simulator runs.
bool claim(int line) noexcept {
  if (flock(line, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  if (!is_pseudo_terminal(line)) static_cast<void>(ioctl(line, TIOCEXCL));
  return true;
}

}  // namespace

ModbusClient::~ModbusClient() {
  release();
}

void ModbusClient::release() noexcept {
  close();
  if (context_ != nullptr) modbus_free(context_);
  context_ = nullptr;
}

Status ModbusClient::use(_modbus* context, Duration response_timeout) {
  context_ = context;
  if (context_ == nullptr) {
    return Status::error(StatusCode::invalid_argument, "%s cannot be used: %s", where_.data(),
                         modbus_strerror(errno));
  }
  response_timeout_ = response_timeout;
  limit_answers(context_, response_timeout);  // also how long a connection may take
  // The whole answer has to come within it: a peer that sends a byte now and then would hold the thread.
  modbus_set_byte_timeout(context_, 0, 0);
  modbus_set_error_recovery(context_, MODBUS_ERROR_RECOVERY_NONE);
  return {};
}

Status ModbusClient::use_tcp(const char* address, std::uint16_t port, Duration response_timeout) {
  release();
  in_addr parsed{};
  if (inet_pton(AF_INET, address, &parsed) != 1) {
    return Status::error(StatusCode::invalid_argument,
                         "`%s` is no address: write the station's numeric one, as 192.168.1.20", address);
  }
  std::snprintf(where_.data(), where_.size(), "%s, port %u", address, unsigned{port});
  serial_ = false;
  character_ = {};
  return use(modbus_new_tcp(address, port), response_timeout);
}

Status ModbusClient::use_rtu(const SerialLine& line, Duration response_timeout) {
  release();
  std::snprintf(where_.data(), where_.size(), "serial line %s", line.device);
  serial_ = true;
  // A start bit, eight of data, and what follows them.
  const std::int64_t bits = 9 + (line.parity == 'N' ? 0 : 1) + line.stop_bits;
  character_ = Duration{bits * 1'000'000'000 / std::max<std::int64_t>(line.baud, 1)};
  silence_ = line.baud > 19200 ? shortest_silence : std::max(shortest_silence, character_ * 7 / 2);
  return use(modbus_new_rtu(line.device, static_cast<int>(line.baud), line.parity, 8, line.stop_bits),
             response_timeout);
}

Status ModbusClient::open() noexcept {
  close();
  // libmodbus, too late, leaves what the connection was at.
  if (modbus_connect(context_) != 0) return cannot_open(errno == EINPROGRESS ? ETIMEDOUT : errno);
  open_ = true;
  if (serial_ && !claim(modbus_get_socket(context_))) {
    close();
    return cannot_open(EBUSY);
  }
  quiet_since_ = now();
  is_without_echo_ = false;
  if (serial_) modbus_flush(context_);
  return {};
}

Status ModbusClient::cannot_open(int error) const noexcept {
  return Status::error(
      error == EACCES || error == EPERM ? StatusCode::not_permitted : StatusCode::unavailable,
      "%s cannot be opened: %s; %s", where_.data(), modbus_strerror(error), advice_to_open(error));
}

void ModbusClient::close() noexcept {
  if (open_) modbus_close(context_);
  open_ = false;
}

Duration ModbusClient::longest_wait(const ModbusBlock& block, bool writes) const noexcept {
  return response_timeout_ + (serial_ ? silence_ + bytes_of(block, writes) * character_ : Duration{});
}

void ModbusClient::prepare(std::uint8_t unit_id, const ModbusBlock& block, bool writes) noexcept {
  modbus_set_slave(context_, unit_id);
  waits_ = response_timeout_;
  if (!serial_) return;
  // What is written to the line goes out while the answer is waited for already.
  waits_ += bytes_of(block, writes) * character_;
  limit_answers(context_, waits_);
  const Duration rest = silence_ - (now() - quiet_since_);
  if (rest > Duration{}) {
    const timespec pause{0, static_cast<long>(rest.count())};
    nanosleep(&pause, nullptr);
  }
  modbus_flush(context_);
}

ModbusReply ModbusClient::read(std::uint8_t unit_id, const ModbusBlock& block,
                               std::uint16_t* words) noexcept {
  prepare(unit_id, block, false);
  const ModbusReply reply = exchange(unit_id, read_request(block));
  if (reply.outcome == ModbusOutcome::answered) take_words(block, answer_, words);
  return reply;
}

ModbusReply ModbusClient::write(std::uint8_t unit_id, const ModbusBlock& block, const std::uint16_t* words,
                                bool multiple) noexcept {
  prepare(unit_id, block, true);
  const bool tries_echo = serial_ && !is_without_echo_ && block.count == 1 && !multiple;
  ModbusReply reply = exchange(unit_id, write_request(block, words, multiple || tries_echo));
  if (tries_echo && reply.is_of_unknown_function()) {
    // The refusal is about 15 or 16, which nobody asked for; whether 5 or 6 is known, the next request tells.
    reply.exception = 0;
    reply.cause = "the station does not know the functions 15 and 16; 5 or 6 is tried next";
  }
  return reply;
}

bool ModbusClient::send(std::uint8_t unit_id, const ModbusPdu& request) noexcept {
  if (serial_) {
    std::array<std::uint8_t, 1 + ModbusPdu::most> raw{unit_id};
    std::copy_n(request.bytes.begin(), request.size, raw.begin() + 1);
    return modbus_send_raw_request(context_, raw.data(), static_cast<int>(1 + request.size)) >= 0;
  }
  // libmodbus would send it under transaction 0, as every raw one (Messaging on TCP/IP V1.0b, 3.1.3).
  ++transaction_;
  const std::size_t follows = 1 + request.size;
  std::array<std::uint8_t, tcp_header + ModbusPdu::most> frame{
      static_cast<std::uint8_t>(transaction_ >> 8U),
      static_cast<std::uint8_t>(transaction_ & 0xFFU),
      0,
      0,
      static_cast<std::uint8_t>(follows >> 8U),
      static_cast<std::uint8_t>(follows & 0xFFU),
      unit_id};
  std::copy_n(request.bytes.begin(), request.size, frame.begin() + tcp_header);
  const std::size_t size = tcp_header + request.size;
  const ssize_t sent = ::send(modbus_get_socket(context_), frame.data(), size, MSG_NOSIGNAL);
  if (sent >= 0 && static_cast<std::size_t>(sent) < size) errno = ECONNABORTED;
  return sent == static_cast<ssize_t>(size);
}

bool ModbusClient::hears_itself(std::uint8_t unit_id, const ModbusPdu& request) const noexcept {
  if (!serial_ || request.is_answered_by_itself()) return false;
  // libmodbus reads as many bytes as the frame of an answer would have, and takes the request's own for its
  // checksum. Of a write, compare those too: a damaged answer repeats address and count, but not what follows
  // them.
  constexpr std::uint8_t last_reading_function = 4;
  const std::size_t compared = request.function() > last_reading_function ? 7 : request.bytes[1] == 0 ? 4 : 5;
  return frame_[0] == unit_id &&
         std::equal(request.bytes.begin(), request.bytes.begin() + compared, frame_.begin() + 1);
}

ModbusReply ModbusClient::exchange(std::uint8_t unit_id, const ModbusPdu& request) noexcept {
  frame_.fill(0);
  answer_ = {};
  const int length = send(unit_id, request) ? modbus_receive_confirmation(context_, frame_.data()) : -1;
  const int error = errno;
  quiet_since_ = now();
  if (length >= 0) return judge(unit_id, request, static_cast<std::size_t>(length));
  if ((error == ETIMEDOUT || error > MODBUS_ENOBASE) && hears_itself(unit_id, request)) return own_echo();
  // An echo comes back within any time-out.
  if (error == ETIMEDOUT) is_without_echo_ = true;
  return failure(error);
}

ModbusReply ModbusClient::own_echo() noexcept {
  is_without_echo_ = false;
  return bad_reply(
      "the line hears itself: what was sent came back; switch the echo of its adapter off, and look after "
      "its "
      "wiring");
}

ModbusReply ModbusClient::judge(std::uint8_t unit_id, const ModbusPdu& request, std::size_t length) noexcept {
  const std::size_t header = serial_ ? 1 : tcp_header;
  const std::size_t trailer = serial_ ? crc_bytes : 0;
  if (frame_[header - 1] != unit_id)
    return bad_reply("an answer of unit %u came; is there another master, or a gateway that mixes them up?",
                     unsigned{frame_[header - 1]});
  if (length < header + trailer) return bad_reply("the answer is cut short");
  if (!serial_) {
    if (frame_[0] * 256U + frame_[1] != transaction_)
      return bad_reply("the answer is to another request (transaction %u instead of %u)",
                       frame_[0] * 256U + frame_[1], unsigned{transaction_});
    if (frame_[2] != 0 || frame_[3] != 0 || frame_[4] * 256U + frame_[5] != length - (tcp_header - 1))
      return bad_reply("the answer's header is none of Modbus TCP, or tells another length");
  }
  answer_ = std::span(frame_).subspan(header, length - header - trailer);
  const ModbusJudgement judgement = judge_answer(request, answer_);
  if (judgement.kind == ModbusJudgement::Kind::other) {
    return hears_itself(unit_id, request) ? own_echo()
                                          : bad_reply("the answer does not fit: %s", judgement.why);
  }
  is_without_echo_ = true;
  return judgement.kind == ModbusJudgement::Kind::exception ? exception(judgement.exception) : ModbusReply{};
}

ModbusReply ModbusClient::exception(int code) noexcept {
  ModbusReply reply;
  reply.cause = cause_.data();
  const char* const words = modbus_strerror(MODBUS_ENOBASE + code);
  if (code == MODBUS_EXCEPTION_GATEWAY_PATH || code == MODBUS_EXCEPTION_GATEWAY_TARGET) {
    reply.outcome = ModbusOutcome::unreachable;
    std::snprintf(cause_.data(), cause_.size(),
                  "a gateway answers in its place: %s; is the unit id right, and the station behind it on?",
                  words);
    return reply;
  }
  reply.outcome = ModbusOutcome::exception;
  reply.exception = static_cast<std::uint8_t>(code);
  if (code <= 0 || code >= MODBUS_EXCEPTION_MAX) {
    std::snprintf(cause_.data(), cause_.size(),
                  "the station refuses: exception %d, which the standard does not have", code);
    return reply;
  }
  const char* advice = code == MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS
                           ? "; is the register map that of this station?"
                       : reply.is_of_unknown_function() ? "; the station does not know this kind of register"
                                                        : "";
  std::snprintf(cause_.data(), cause_.size(), "the station refuses: %s%s", words, advice);
  return reply;
}

ModbusReply ModbusClient::failure(int error) noexcept {
  if (error > MODBUS_ENOBASE)
    return bad_reply("the answer is damaged: %s%s", modbus_strerror(error),
                     serial_ ? "; check baud rate, parity, wiring and termination" : "");
  ModbusReply reply;
  reply.cause = cause_.data();
  if (error == ETIMEDOUT) {
    reply.outcome = ModbusOutcome::timeout;
    std::snprintf(cause_.data(), cause_.size(),
                  "no whole answer within %.3g s; is the station on, and its unit id right?",
                  seconds(waits_));
  } else {
    reply.outcome = ModbusOutcome::lost;
    std::snprintf(cause_.data(), cause_.size(), "%s was lost: %s", where_.data(), modbus_strerror(error));
  }
  return reply;
}

template <class... Values>
ModbusReply ModbusClient::bad_reply(const char* format, Values... values) noexcept {
  std::snprintf(cause_.data(), cause_.size(), format, values...);
  ModbusReply reply;
  reply.outcome = ModbusOutcome::bad_reply;
  reply.cause = cause_.data();
  return reply;
}

/// A late answer on TCP stays in the stream, so the connection is ended with it.
void ModbusClient::resynchronise() noexcept {
  if (!serial_) return close();
  modbus_flush(context_);
  quiet_since_ = now();
}

}  // namespace flexrf
