#include "web-ui/server/access/login_body.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>

namespace flexrf::panel {
namespace {

constexpr std::size_t longest_body = 1024;

/// Stops at the first thing that does not belong.
class Reader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Reader(LoginBody& body) : body_(body) {}
  bool is_complete() const noexcept { return has_user_ && has_password_; }

  bool start_object(std::size_t) override {
    const bool is_first = !is_open_;
    is_open_ = true;
    return is_first;
  }
  bool key(std::string& name) override {
    value_ = nullptr;
    if (name == "user" && !has_user_) {
      has_user_ = true;
      value_ = &body_.user;
    }
    if (name == "password" && !has_password_) {
      has_password_ = true;
      value_ = &body_.password;
    }
    return value_ != nullptr;
  }
  bool string(std::string& text) override {
    if (value_ == nullptr) return false;
    *value_ = text;
    return true;
  }
  bool end_object() override { return true; }
  bool null() override { return false; }
  bool boolean(bool) override { return false; }
  bool number_integer(number_integer_t) override { return false; }
  bool number_unsigned(number_unsigned_t) override { return false; }
  bool number_float(number_float_t, const std::string&) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool start_array(std::size_t) override { return false; }
  bool end_array() override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  LoginBody& body_;
  std::string* value_ = nullptr;
  bool is_open_ = false;
  bool has_user_ = false;
  bool has_password_ = false;
};

}  // namespace

bool read_login_body(std::string_view text, LoginBody& body) {
  if (text.size() > longest_body) return false;
  Reader reader(body);
  return nlohmann::json::sax_parse(text.begin(), text.end(), &reader) && reader.is_complete();
}

}  // namespace flexrf::panel
