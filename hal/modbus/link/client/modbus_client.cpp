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
/// 6.6, 6.11, 6.12; Modbus over serial line V1.02, 2.5.1).
std::int64_t bytes_of(const ModbusBlock& block, bool writes) noexcept {
  const bool registers =
      block.area == ModbusArea::holding_register || block.area == ModbusArea::input_register;
  const std::int64_t data = registers ? 2 * block.count : (block.count + 7) / 8;
  constexpr std::int64_t address_and_count = 8;
  if (!writes) return address_and_count + 5 + data;
  return block.count == 1 ? 2 * address_and_count : address_and_count + 9 + data;
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
  if (block.area == ModbusArea::holding_register)
    return outcome(modbus_read_registers(context_, block.address, block.count, words));
  if (block.area == ModbusArea::input_register)
    return outcome(modbus_read_input_registers(context_, block.address, block.count, words));
  std::array<std::uint8_t, MODBUS_MAX_READ_BITS> bits{};
  const ModbusReply reply =
      outcome(block.area == ModbusArea::coil
                  ? modbus_read_bits(context_, block.address, block.count, bits.data())
                  : modbus_read_input_bits(context_, block.address, block.count, bits.data()));
  std::copy_n(bits.data(), block.count, words);
  return reply;
}

/// A single one has a request of its own, which the simplest stations know alone.
ModbusReply ModbusClient::write(std::uint8_t unit_id, const ModbusBlock& block,
                                const std::uint16_t* words) noexcept {
  prepare(unit_id, block, true);
  if (block.area == ModbusArea::holding_register) {
    return outcome(block.count == 1 ? modbus_write_register(context_, block.address, words[0])
                                    : modbus_write_registers(context_, block.address, block.count, words));
  }
  if (block.count == 1) return outcome(modbus_write_bit(context_, block.address, words[0] != 0 ? 1 : 0));
  std::array<std::uint8_t, MODBUS_MAX_WRITE_BITS> bits{};
  for (std::size_t i = 0; i < block.count; ++i) bits[i] = words[i] != 0 ? 1 : 0;
  return outcome(modbus_write_bits(context_, block.address, block.count, bits.data()));
}

ModbusReply ModbusClient::outcome(int result) noexcept {
  const int error = errno;
  quiet_since_ = now();
  if (result >= 0) return {};
  ModbusReply reply;
  reply.cause = cause_.data();
  if (error == EMBXGPATH || error == EMBXGTAR) {
    reply.outcome = ModbusOutcome::unreachable;
    std::snprintf(cause_.data(), cause_.size(),
                  "a gateway answers in its place: %s; is the unit id right, and the station behind it on?",
                  modbus_strerror(error));
  } else if (error > MODBUS_ENOBASE && error < MODBUS_ENOBASE + MODBUS_EXCEPTION_MAX) {
    reply.outcome = ModbusOutcome::exception;
    const char* advice = error == EMBXILADD   ? "; is the register map that of this station?"
                         : error == EMBXILFUN ? "; the station does not know this kind of register"
                                              : "";
    std::snprintf(cause_.data(), cause_.size(), "the station refuses: %s%s", modbus_strerror(error), advice);
  } else if (error == ETIMEDOUT) {
    reply.outcome = ModbusOutcome::timeout;
    std::snprintf(cause_.data(), cause_.size(),
                  "no whole answer within %.3g s; is the station on, and its unit id right?",
                  seconds(waits_));
  } else if (error > MODBUS_ENOBASE) {
    reply.outcome = ModbusOutcome::bad_reply;
    std::snprintf(cause_.data(), cause_.size(), "the answer is damaged or another's: %s%s",
                  modbus_strerror(error), serial_ ? "; check baud rate, parity, wiring and termination" : "");
  } else {
    reply.outcome = ModbusOutcome::lost;
    std::snprintf(cause_.data(), cause_.size(), "%s was lost: %s", where_.data(), modbus_strerror(error));
  }
  return reply;
}

/// A late answer on TCP stays in the stream, so the connection is ended with it.
void ModbusClient::resynchronise() noexcept {
  if (!serial_) return close();
  modbus_flush(context_);
  quiet_since_ = now();
}

}  // namespace flexrf
