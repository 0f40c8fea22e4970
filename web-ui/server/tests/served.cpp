#include "web-ui/server/tests/served.hpp"

#include <cstdlib>
#include <utility>

#include "web-ui/server/encryption.hpp"
#include "web-ui/server/http_problem.hpp"
#include "web-ui/server/server.hpp"

namespace flexrf::panel {
namespace {

const std::string& large() {
  static const std::string text(8U << 20U, 'x');
  return text;
}

}  // namespace

bool TestHandlers::admit(const Request& request, SessionIndex& session, Reply& reply) {
  const bool changes = request.upgrade || request.method == Method::put || request.method == Method::post;
  session = 0;
  if (request.host != "panel.test") {
    answer_problem(reply, 421, "unknown host");
    return false;
  }
  if (changes && !request.origin.empty() && request.origin != "http://panel.test") {
    answer_problem(reply, 403, "foreign origin");
    return false;
  }
  return true;
}

Handled TestHandlers::handle(const Request& request, Reply& reply, Ticket ticket) {
  if (request.path == "/hello") {
    reply.text = R"({"hello":true})";
    reply.etag = "\"1\"";
  } else if (request.path == "/echo") {
    reply.text = request.body;
  } else if (request.path == "/large") {
    reply.fixed = large();
  } else if (request.path == "/later") {
    waiting_.push_back(ticket);
    return Handled::later;
  } else if (request.path == "/never") {
    return Handled::later;
  } else {
    answer_problem(reply, 404, "no such path");
  }
  return Handled::now;
}

void TestHandlers::on_text(LiveLink& link, std::string_view text) {
  ++texts;
  if (text == "close") {
    link.close(4000, "as you wish");
    return;
  }
  left_[link.place()] = text == "flood" ? no_end : text == "much" ? much_messages : 0;
  if (link.is_writing()) return;
  link.buffer() = text;
  link.send(false);
  on_writable(link);
}

void TestHandlers::on_writable(LiveLink& link) {
  while (left_[link.place()] > 0 && !link.is_writing()) send_next(link);
}

void TestHandlers::send_next(LiveLink& link) {
  std::size_t& left = left_[link.place()];
  const std::size_t number = left == no_end ? 0 : much_messages - left;
  if (left != no_end) --left;
  if (number % 2 == 0) {
    link.buffer().assign(much_size, byte_of(number));
    link.send(true);
  } else {
    shared_.assign(LiveLink::head_room + much_size, byte_of(number));
    link.send_shared(shared_);
    shared_.assign(shared_.size(), '?');  // it is the caller's again
  }
}

void TestHandlers::on_close(LiveLink& link) {
  left_[link.place()] = 0;
  ++closed;
}

void TestHandlers::on_tick(Time) {
  for (const Ticket ticket : waiting_) {
    if (Reply* reply = replies->reply_of(ticket); reply != nullptr) {
      reply->text = "later";
      replies->complete(ticket);
    }
  }
  waiting_.clear();
  if (ticked) ticked();
}

Served::Served(const ServerSettings& settings, std::function<void()> ticked,
               const std::string& certificate_file, const std::string& key_file) {
  handlers.ticked = std::move(ticked);
  std::unique_ptr<net::ssl::context> encryption;
  if (!certificate_file.empty()) {
    auto made = make_encryption(certificate_file, key_file);
    if (!made) std::abort();
    encryption = std::move(*made);
  }
  server = std::make_unique<Server>(settings, std::move(encryption), handlers);
  handlers.replies = server.get();
  if (!server->listen({"127.0.0.1", 0})) std::abort();
  thread = std::thread([this] { server->run(); });
}

Served::~Served() {
  stop();
  thread.join();
}

std::uint16_t Served::port() const {
  return server->port();
}

void Served::stop() {
  server->stop();
}

std::string fault_of_encryption(const std::string& certificate_file, const std::string& key_file) {
  const auto made = make_encryption(certificate_file, key_file);
  return made ? "" : made.status().cause();
}

}  // namespace flexrf::panel
