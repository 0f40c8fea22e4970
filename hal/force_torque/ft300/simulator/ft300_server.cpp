#include "hal/force_torque/ft300/simulator/ft300_server.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

constexpr Duration period = std::chrono::milliseconds(10);
/// So many bytes of ones in a row end the stream.
constexpr int ending_ones = 20;

std::int16_t counts_of(double value, double counts) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value * counts, -32768.0, 32767.0)));
}

void say(int line, std::span<const std::uint8_t> bytes) {
  static_cast<void>(!write(line, bytes.data(), bytes.size()));
}

}  // namespace

Result<std::unique_ptr<Ft300Server>> Ft300Server::on_descriptor(int descriptor, std::uint8_t unit_id) {
  std::unique_ptr<Ft300Server> server(new Ft300Server);
  server->line_ = descriptor;
  server->unit_id_ = unit_id;
  return begin(std::move(server));
}

Result<std::unique_ptr<Ft300Server>> Ft300Server::on_serial_line(const std::string& device,
                                                                 std::uint8_t unit_id) {
  std::unique_ptr<Ft300Server> server(new Ft300Server);
  if (const Status status = server->port_.open(device.c_str()); !status) return status;
  server->line_ = server->port_.descriptor();
  server->unit_id_ = unit_id;
  return begin(std::move(server));
}

Result<std::unique_ptr<Ft300Server>> Ft300Server::begin(std::unique_ptr<Ft300Server> server) {
  const Status status = server->thread_.begin<Ft300Server, &Ft300Server::run>("ft300_server", *server);
  if (!status) return status;
  return server;
}

void Ft300Server::run() {
  Time due = MonotonicClock::now();
  while (true) {
    const Time now = MonotonicClock::now();
    if (now >= due) {
      send();
      due = std::max(due + period, now);
    }
    pollfd line{line_, POLLIN, 0};
    if (!thread_.wait(due - now, {&line, 1}) || (line.revents & (POLLERR | POLLNVAL)) != 0) return;
    if ((line.revents & POLLIN) != 0) receive();
  }
}

void Ft300Server::receive() {
  std::array<std::uint8_t, 64> bytes{};
  const ssize_t count = read(line_, bytes.data(), bytes.size());
  for (ssize_t i = 0; i < count; ++i) heed(bytes[static_cast<std::size_t>(i)]);
}

void Ft300Server::heed(std::uint8_t byte) {
  ones_ = byte == ft300::stop_byte ? ones_ + 1 : 0;
  heard_.push_back(byte);
  if (heard_.size() > ft300::request_bytes) heard_.erase(heard_.begin());
  const ft300::RequestBytes request = ft300::stream_request(unit_id_);
  const std::lock_guard lock(mutex_);
  if (ones_ >= ending_ones) streams_ = false;
  if (streams_ || behaviour_ == Behaviour::silent ||
      !std::equal(heard_.begin(), heard_.end(), request.begin(), request.end()))
    return;
  streams_ = true;
  // The answer to a request to write: what was written where, without the values.
  std::array<std::uint8_t, 8> answer{};
  std::copy_n(request.begin(), 6, answer.begin());
  const std::uint16_t crc = ft300::crc16(std::span(answer).first<6>());
  answer[6] = static_cast<std::uint8_t>(crc & 0xFFU);
  answer[7] = static_cast<std::uint8_t>(crc >> 8U);
  say(line_, answer);
}

void Ft300Server::send() {
  const std::lock_guard lock(mutex_);
  if (!streams_ || behaviour_ == Behaviour::silent) return;
  ft300::FrameBytes bytes = ft300::encode(frame_);
  if (behaviour_ == Behaviour::damaged) bytes[7] ^= 0x04U;
  const std::size_t size = behaviour_ == Behaviour::truncated ? bytes.size() - 5 : bytes.size();
  say(line_, std::span(bytes).first(size));
}

void Ft300Server::set_load(const std::array<double, 3>& force, const std::array<double, 3>& torque) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < 3; ++i) {
    frame_.force[i] = counts_of(force[i], 100);
    frame_.torque[i] = counts_of(torque[i], 1000);
  }
}

void Ft300Server::set_behaviour(Behaviour behaviour) {
  const std::lock_guard lock(mutex_);
  behaviour_ = behaviour;
}

void Ft300Server::switch_off_and_on() {
  const std::lock_guard lock(mutex_);
  streams_ = false;
}

bool Ft300Server::streams() {
  const std::lock_guard lock(mutex_);
  return streams_;
}

}  // namespace flexrf
