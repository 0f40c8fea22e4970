#include "image/helper/answer.hpp"

#include "base/json_writer.hpp"

namespace flexrf::helper {

std::string Answer::text() const {
  JsonWriter json{std::string{}};
  json.begin_object().member("ok", is_done());
  if (!is_done()) json.member("status", status).member("why", why);
  if (retry_after_s > 0) json.member("retry_after", retry_after_s);
  if (!upload.empty()) json.member("upload", upload);
  if (freed) json.member("freed", *freed);
  if (received) json.member("received", *received);
  json.end_object();
  return json.release();
}

}  // namespace flexrf::helper
