#include "image/claim/claim_page.hpp"

namespace flexrf::claim {
namespace {

/// As text and as an attribute's value in double quotes.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char one : text) {
    switch (one) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += one;
    }
  }
  return safe;
}

std::string page(std::string_view machine, std::string_view body) {
  const std::string name = escaped(machine);
  std::string text = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + name +
                     "</title><meta name=\"viewport\" content=\"width=device-width\"><link "
                     "rel=\"stylesheet\" href=\"/claim.css\">";
  text.append("</head>\n<body><main>\n<h1>").append(name).append("</h1>\n");
  return text.append(body).append("</main></body></html>\n");
}

}  // namespace

std::string form_page(std::string_view machine, std::string_view token, std::string_view user,
                      const Answer* last) {
  std::string body =
      "<p>Nobody has claimed this PC yet. Its screen, or its serial line, shows a code: whoever types it "
      "here sets the "
      "password of the first admin. Nothing runs and nothing moves until then.</p>\n";
  if (last != nullptr) body += "<p class=\"wrong\" role=\"alert\">" + escaped(last->text) + "</p>\n";
  body +=
      "<form method=\"post\" action=\"/claim\" autocomplete=\"off\"><input type=\"hidden\" name=\"token\" "
      "value=\"" +
      escaped(token) +
      "\">\n"
      "<label>Code on the screen<input name=\"code\" required autofocus spellcheck=\"false\" "
      "autocapitalize=\"characters\" "
      "placeholder=\"XXXXX-XXXXX\"></label>\n"
      "<label>User<input name=\"user\" required maxlength=\"31\" autocomplete=\"username\" value=\"" +
      escaped(user) +
      "\"></label>\n"
      "<label>Password, at least 12 characters<input name=\"password\" type=\"password\" required "
      "minlength=\"12\" "
      "maxlength=\"256\" autocomplete=\"new-password\"></label>\n"
      "<label>The same again<input name=\"repeated\" type=\"password\" required maxlength=\"256\" "
      "autocomplete=\"new-password\"></label>\n"
      "<button>Claim this PC</button>\n</form>\n";
  return page(machine, body);
}

std::string done_page(std::string_view machine, std::string_view user, const ReachedBy& reached_by) {
  std::string where;
  if (!reached_by.host.empty()) {
    const std::string host = "<b>" + escaped(reached_by.host) + "</b>";
    where = reached_by.why_not.empty()
                ? "<p>The panel answers at " + host + ", too, by which you opened this page.</p>\n"
                : "<p class=\"wrong\">The panel may not answer at " + host +
                      ", by which you opened this page: " + escaped(reached_by.why_not) +
                      ". Open it by another address then: the PC's screen shows them.</p>\n";
  }
  // It goes nowhere by itself: whoever reads slowly, or hears it read, is not to lose it (WCAG 2.2.1).
  return page(machine, "<p>This PC is claimed. <b>" + escaped(user) + "</b> is its admin.</p>\n" + where +
                           "<p>The cell starts now, which takes some seconds. Then its "
                           "panel is in this page's place: <a href=\"/\">go there</a>.</p>\n");
}

std::string_view page_style() noexcept {
  return "body{margin:0;background:#dfe2e5;color:#1d2126;font:16px/1.4 system-ui,sans-serif}\n"
         "main{max-width:30em;margin:8vh auto;padding:24px 32px;background:#eceef0;border:1px solid #767d86;"
         "border-radius:4px}\n"
         "h1{margin:0 0 .5em;font-size:1.5em}\n"
         "label{display:block;margin-top:16px;color:#4a5058}\n"
         "input{display:block;box-sizing:border-box;width:100%;min-height:40px;margin-top:4px;padding:4px "
         "8px;"
         "border:1px solid #767d86;border-radius:4px;background:#fff;color:#1d2126;font:inherit}\n"
         "input[name=code]{font-family:monospace;font-size:1.25em;letter-spacing:.1em;text-transform:"
         "uppercase}\n"
         "input:focus-visible,button:focus-visible,a:focus-visible{outline:3px solid "
         "#0b57a4;outline-offset:1px}\n"
         "button{min-height:48px;margin-top:24px;padding:0 "
         "24px;border:0;border-radius:4px;background:#0b57a4;"
         "color:#fff;font:inherit;font-weight:600}\n"
         ".wrong{padding:8px 12px;border-left:4px solid #a8001c;background:#fff;color:#a8001c}\n"
         "@media (prefers-color-scheme:dark){body{background:#17191c;color:#e6e8ea}main{background:#212529}"
         "label{color:#b3b9c0}input{background:#2c3136;color:#e6e8ea}button{background:#7fb8f5;color:#10161c}"
         ".wrong{background:#2c3136;color:#ff8f94}a{color:#7fb8f5}}\n";
}

}  // namespace flexrf::claim
