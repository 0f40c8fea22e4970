#include "image/boot/tests/grub_script.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <utility>

namespace flexrf::boot {
namespace {

struct Token {
  enum class Kind { word, end_of_command, open, close, end };

  Kind kind = Kind::end;
  int line = 0;
  ScriptWord word;

  /// A word of the language counts as one only without quotes.
  bool is(std::string_view keyword) const {
    return kind == Kind::word && word.size() == 1 && !word[0].is_variable && !word[0].is_quoted &&
           word[0].text == keyword;
  }
};

bool is_name_character(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
}

class Lexer {
 public:
  explicit Lexer(std::string_view source) : source_(source) {}

  Token next() {
    while (place_ < source_.size() && (here() == ' ' || here() == '\t')) ++place_;
    if (place_ < source_.size() && here() == '#')
      place_ = std::min(source_.find('\n', place_), source_.size());
    Token token;
    token.line = line_;
    if (place_ == source_.size()) return token;
    switch (here()) {
      case '\n':
        ++line_;
        [[fallthrough]];
      case ';':
        return sign(token, Token::Kind::end_of_command);
      case '{':
        return sign(token, Token::Kind::open);
      case '}':
        return sign(token, Token::Kind::close);
      default:
        token.kind = Token::Kind::word;
        read_word(token.word);
        return token;
    }
  }

 private:
  char here() const { return source_[place_]; }

  [[noreturn]] void refuse(const std::string& what) const {
    throw ScriptError("line " + std::to_string(line_) + ": " + what);
  }

  Token sign(Token token, Token::Kind kind) {
    ++place_;
    token.kind = kind;
    return token;
  }

  void read_word(ScriptWord& word) {
    constexpr std::string_view ends = "{};\n \t";
    while (place_ < source_.size() && ends.find(here()) == std::string_view::npos) {
      if (here() == '\'')
        read_single_quotes(word);
      else if (here() == '"')
        read_double_quotes(word);
      else if (here() == '$')
        read_variable(word, false);
      else if (std::string_view("|&<>\\").find(here()) != std::string_view::npos)
        refuse(std::string("'") + here() + "' outside of quotes");
      else
        read_bare(word);
    }
  }

  void read_bare(ScriptWord& word) {
    const std::size_t end = std::min(source_.find_first_of("{};\n \t'\"$|&<>\\", place_), source_.size());
    word.push_back({std::string(source_.substr(place_, end - place_)), false, false});
    place_ = end;
  }

  void read_single_quotes(ScriptWord& word) {
    const std::size_t end = source_.find('\'', place_ + 1);
    if (end == std::string_view::npos) refuse("a quote does not end");
    word.push_back({std::string(source_.substr(place_ + 1, end - place_ - 1)), false, true});
    place_ = end + 1;
  }

  void read_double_quotes(ScriptWord& word) {
    word.push_back({"", false, true});  // so that nothing in quotes is a word still
    for (++place_; place_ < source_.size() && here() != '"';) {
      if (here() == '\n' || here() == '\\') refuse("a line feed or a backslash in quotes");
      if (here() == '$') {
        read_variable(word, true);
      } else {
        const std::size_t end = std::min(source_.find_first_of("\"$\n\\", place_), source_.size());
        word.push_back({std::string(source_.substr(place_, end - place_)), false, true});
        place_ = end;
      }
    }
    if (place_ == source_.size()) refuse("a quote does not end");
    ++place_;
  }

  void read_variable(ScriptWord& word, bool is_quoted) {
    const std::size_t begin = ++place_;
    if (begin < source_.size() && std::isdigit(static_cast<unsigned char>(here())) != 0)
      ++place_;
    else
      while (place_ < source_.size() && is_name_character(here())) ++place_;
    if (place_ == begin) refuse("a variable without a name");
    word.push_back({std::string(source_.substr(begin, place_ - begin)), true, is_quoted});
  }

  std::string_view source_;
  std::size_t place_ = 0;
  int line_ = 1;
};

class Parser {
 public:
  explicit Parser(std::string_view source) : lexer_(source) { advance(); }

  ScriptCommands parse_all() {
    ScriptCommands commands = parse_commands({});
    if (token_.kind != Token::Kind::end) refuse("a bracket or a word of the language out of place");
    return commands;
  }

 private:
  void advance() { token_ = lexer_.next(); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw ScriptError("line " + std::to_string(token_.line) + ": " + what);
  }

  void skip_ends() {
    while (token_.kind == Token::Kind::end_of_command) advance();
  }

  void expect(std::string_view keyword) {
    if (!token_.is(keyword)) refuse("'" + std::string(keyword) + "' is missing");
    advance();
  }

  bool is_any(std::initializer_list<std::string_view> keywords) const {
    for (const std::string_view keyword : keywords)
      if (token_.is(keyword)) return true;
    return false;
  }

  ScriptCommands parse_commands(std::initializer_list<std::string_view> ends) {
    ScriptCommands commands;
    for (skip_ends(); token_.kind == Token::Kind::word && !is_any(ends); skip_ends()) {
      commands.push_back(parse_command());
      if (token_.kind == Token::Kind::word || token_.kind == Token::Kind::open)
        refuse("a command does not end");
    }
    return commands;
  }

  ScriptCommand parse_command() {
    if (token_.is("if")) return parse_conditional();
    if (token_.is("function")) return parse_function();
    if (is_any(
            {"then", "elif", "else", "fi", "for", "while", "until", "do", "done", "case", "esac", "select"}))
      refuse("'" + token_.word[0].text + "' out of place");
    ScriptCommand command;
    command.line = token_.line;
    const bool is_menu_entry = token_.is("menuentry");
    while (token_.kind == Token::Kind::word) {
      command.words.push_back(token_.word);
      advance();
    }
    if (is_menu_entry) {
      command.kind = ScriptCommand::Kind::menu_entry;
      command.body = parse_block();
    }
    return command;
  }

  ScriptCommands parse_block() {
    if (token_.kind != Token::Kind::open) refuse("'{' is missing");
    advance();
    ScriptCommands commands = parse_commands({});
    if (token_.kind != Token::Kind::close) refuse("'}' is missing");
    advance();
    if (commands.empty()) refuse("there is nothing between the brackets");
    return commands;
  }

  ScriptCommand parse_function() {
    ScriptCommand command;
    command.kind = ScriptCommand::Kind::function;
    command.line = token_.line;
    advance();
    if (token_.kind != Token::Kind::word) refuse("a function without a name");
    command.words.push_back(token_.word);
    advance();
    skip_ends();
    command.body = parse_block();
    return command;
  }

  ScriptCommand parse_conditional() {
    ScriptCommand command;
    command.kind = ScriptCommand::Kind::conditional;
    command.line = token_.line;
    do {
      advance();  // if, elif
      ScriptBranch branch;
      branch.condition = parse_commands({"then"});
      expect("then");
      branch.body = parse_commands({"elif", "else", "fi"});
      if (branch.condition.empty() || branch.body.empty()) refuse("a branch without a command");
      command.branches.push_back(std::move(branch));
    } while (token_.is("elif"));
    if (token_.is("else")) {
      advance();
      command.otherwise = parse_commands({"fi"});
      if (command.otherwise.empty()) refuse("a branch without a command");
    }
    expect("fi");
    return command;
  }

  Lexer lexer_;
  Token token_;
};

}  // namespace

ScriptCommands parse_script(std::string_view source) {
  return Parser(source).parse_all();
}

}  // namespace flexrf::boot
