#include "hal/modbus/link/simulator/modbus_server.hpp"

#include <modbus.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace flexrf {
namespace {

constexpr int addresses = 65536;
/// Nobody counts on it: what comes wakes the thread.
constexpr Duration look_interval = std::chrono::seconds(1);

Status failure(const char* what) {
  return Status::error(StatusCode::unavailable, "%s: %s", what, modbus_strerror(errno));
}

std::uint16_t port_of(int listener) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  if (getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.sin_port);
}

}  // namespace

std::optional<ModbusServer::Behaviour> ModbusServer::behaviour_named(std::string_view name) noexcept {
  using enum Behaviour;
  constexpr std::array<std::pair<std::string_view, Behaviour>, 11> names{
      {{"well", well},
       {"silent", silent},
       {"slow", slow},
       {"refuses", refuses},
       {"off_behind_gateway", off_behind_gateway},
       {"damaged", damaged},
       {"truncated", truncated},
       {"other_unit", other_unit},
       {"only_single", only_single},
       {"only_multiple", only_multiple},
       {"cut", cut}}};
  for (const auto& [known, behaviour] : names) {
    if (known == name) return behaviour;
  }
  return std::nullopt;
}

ModbusServer::~ModbusServer() {
  thread_.end();
  end_connection();
  if (listener_ >= 0) close(listener_);
  if (owns_line_) modbus_close(context_);
  if (registers_ != nullptr) modbus_mapping_free(registers_);
  if (context_ != nullptr) modbus_free(context_);
}

Result<std::unique_ptr<ModbusServer>> ModbusServer::begin(std::unique_ptr<ModbusServer> server,
                                                          _modbus* context) {
  server->context_ = context;
  server->registers_ = modbus_mapping_new(addresses, addresses, addresses, addresses);
  if (context == nullptr || server->registers_ == nullptr) return failure("a Modbus server cannot be made");
  if (server->serial_) {
    modbus_set_slave(context, server->unit_id_);
  } else {
    server->listener_ = modbus_tcp_listen(context, 1);
    if (server->listener_ < 0) return failure("a Modbus server cannot listen");
    server->port_ = port_of(server->listener_);
  }
  const Status status = server->thread_.begin<ModbusServer, &ModbusServer::run>("modbus_server", *server);
  if (!status) return status;
  return server;
}

Result<std::unique_ptr<ModbusServer>> ModbusServer::on_tcp(std::uint8_t unit_id, std::uint16_t port) {
  std::unique_ptr<ModbusServer> server(new ModbusServer);
  server->unit_id_ = unit_id;
  return begin(std::move(server), modbus_new_tcp("127.0.0.1", port));
}

Result<std::unique_ptr<ModbusServer>> ModbusServer::on_serial_line(std::uint8_t unit_id,
                                                                   const std::string& device, int baud,
                                                                   char parity) {
  std::unique_ptr<ModbusServer> server(new ModbusServer);
  server->unit_id_ = unit_id;
  server->serial_ = true;
  _modbus* context = modbus_new_rtu(device.c_str(), baud, parity, 8, 1);
  if (context != nullptr && modbus_connect(context) != 0) {
    const Status status = failure(device.c_str());
    modbus_free(context);
    return status;
  }
  server->owns_line_ = context != nullptr;
  if (context != nullptr) server->client_ = modbus_get_socket(context);
  return begin(std::move(server), context);
}

Result<std::unique_ptr<ModbusServer>> ModbusServer::on_descriptor(std::uint8_t unit_id, int descriptor) {
  std::unique_ptr<ModbusServer> server(new ModbusServer);
  server->unit_id_ = unit_id;
  server->serial_ = true;
  server->client_ = descriptor;
  _modbus* context = modbus_new_rtu("/dev/null", 19200, 'E', 8, 1);  // never opened
  if (context != nullptr) modbus_set_socket(context, descriptor);
  return begin(std::move(server), context);
}

void ModbusServer::run() {
  while (true) {
    std::array<pollfd, 2> waits{{{listener_, POLLIN, 0}, {client_, POLLIN, 0}}};
    if (!thread_.wait(look_interval, waits)) return;
    if (waits[0].revents != 0) {
      accept();
      continue;
    }
    if (client_ < 0) continue;
    if (!serial_ && behaviour_.load() == Behaviour::cut) {
      end_connection();
    } else if (waits[1].revents != 0) {
      serve();
    }
  }
}

void ModbusServer::accept() {
  end_connection();
  client_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (client_ >= 0) modbus_set_socket(context_, client_);
}

void ModbusServer::end_connection() noexcept {
  if (serial_) return;
  if (client_ >= 0) close(client_);
  client_ = -1;
}

void ModbusServer::serve() {
  std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request{};
  const int length = modbus_receive(context_, request.data());
  if (length > 0) {
    answer(request.data(), length);
  } else if (length < 0) {
    // A serial line goes on after a damaged request; one that is gone must not be asked without end.
    if (serial_ && errno != EMBBADCRC) thread_.wait(std::chrono::milliseconds(1));
    end_connection();
  }
}

void ModbusServer::answer(std::uint8_t* request, int length) {
  const int header = modbus_get_header_length(context_);
  std::uint8_t& unit = request[header - 1];
  if (unit != unit_id_) return;
  ++requests_;
  switch (behaviour_.load()) {
    case Behaviour::silent:
      return;
    case Behaviour::refuses:
      modbus_reply_exception(context_, request, MODBUS_EXCEPTION_SLAVE_OR_SERVER_FAILURE);
      return;
    case Behaviour::off_behind_gateway:
      modbus_reply_exception(context_, request, MODBUS_EXCEPTION_GATEWAY_TARGET);
      return;
    case Behaviour::damaged: {
      std::array<std::uint8_t, 24> noise{};
      noise.fill(0x55);
      static_cast<void>(!write(client_, noise.data(), noise.size()));
      return;
    }
    case Behaviour::truncated:
      // As far as the function: what it asked for is said to follow, and does not.
      static_cast<void>(!write(client_, request, static_cast<std::size_t>(header) + 1));
      return;
    case Behaviour::cut:
      end_connection();
      return;
    case Behaviour::other_unit:
      ++unit;
      break;
    case Behaviour::slow:
      thread_.wait(slow_delay);
      break;
    case Behaviour::only_single:
    case Behaviour::only_multiple: {
      const int function = request[header];
      const bool is_unknown =
          behaviour_.load() == Behaviour::only_single
              ? function == MODBUS_FC_WRITE_MULTIPLE_COILS || function == MODBUS_FC_WRITE_MULTIPLE_REGISTERS
              : function == MODBUS_FC_WRITE_SINGLE_COIL || function == MODBUS_FC_WRITE_SINGLE_REGISTER;
      if (!is_unknown) break;
      modbus_reply_exception(context_, request, MODBUS_EXCEPTION_ILLEGAL_FUNCTION);
      return;
    }
    case Behaviour::well:
      break;
  }
  const std::lock_guard lock(registers_mutex_);
  follow();
  modbus_reply(context_, request, length, registers_);
  follow();
}

void ModbusServer::follow() noexcept {
  if (model_ != nullptr) model_->follow(MonotonicClock::now(), {registers_->tab_registers, addresses});
}

void ModbusServer::set_model(ModbusStationModel* model) {
  const std::lock_guard lock(registers_mutex_);
  model_ = model;
}

std::uint16_t ModbusServer::word(ModbusArea area, std::uint16_t address) {
  const std::lock_guard lock(registers_mutex_);
  switch (area) {
    case ModbusArea::coil:
      return registers_->tab_bits[address];
    case ModbusArea::discrete_input:
      return registers_->tab_input_bits[address];
    case ModbusArea::holding_register:
      return registers_->tab_registers[address];
    case ModbusArea::input_register:
      break;
  }
  return registers_->tab_input_registers[address];
}

void ModbusServer::put(ModbusArea area, std::uint16_t address, std::uint16_t value) {
  const std::lock_guard lock(registers_mutex_);
  switch (area) {
    case ModbusArea::coil:
      registers_->tab_bits[address] = value != 0 ? 1 : 0;
      break;
    case ModbusArea::discrete_input:
      registers_->tab_input_bits[address] = value != 0 ? 1 : 0;
      break;
    case ModbusArea::holding_register:
      registers_->tab_registers[address] = value;
      break;
    case ModbusArea::input_register:
      registers_->tab_input_registers[address] = value;
      break;
  }
}

void ModbusServer::clear() {
  const std::lock_guard lock(registers_mutex_);
  std::fill_n(registers_->tab_bits, addresses, std::uint8_t{0});
  std::fill_n(registers_->tab_input_bits, addresses, std::uint8_t{0});
  std::fill_n(registers_->tab_registers, addresses, std::uint16_t{0});
  std::fill_n(registers_->tab_input_registers, addresses, std::uint16_t{0});
}

}  // namespace flexrf
