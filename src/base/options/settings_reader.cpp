// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/settings_reader.hpp"

#include <petscsys.h>
#include <strings.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/options/option_types.hpp"
#include "base/options/yaml.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "base/system/unreadable.hpp"

namespace squeal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largestFile = 10'000'000;  // bytes; a mesh given by mistake is not read whole
constexpr std::size_t mostOptions = 500;  // PETSc's database stores 512; PETSc sets some itself
constexpr std::size_t deepest = 20;       // of files that include files

bool same(const std::string& a, const char* b) {
  return strcasecmp(a.c_str(), b) == 0;
}  // as PETSc compares names

std::string prefixed(const std::string& place, const std::string& message) {
  return place.empty() ? message : place + ": " + message;
}

/// Splits a text at blanks. A word that begins with a quote ends at the next quote of the same kind
/// in the line. With `comments`, as in files, `#` begins a comment.
class Splitter {
 public:
  Splitter(const std::string& text, const std::string& name, bool comments)
      : text_(text), name_(name), comments_(comments) {}

  std::vector<Word> words() {
    std::vector<Word> words;
    for (std::size_t i = 0; i < text_.size();) {
      if (text_[i] == '\n') ++line_;
      if (isBlank(i)) {
        ++i;
      } else if (beginsComment(i)) {
        i = std::min(text_.find('\n', i), text_.size());
      } else {
        const bool quoted = text_[i] == '"' || text_[i] == '\'';
        const std::size_t begin = quoted ? i + 1 : i, end = quoted ? quoteEnd(i) : wordEnd(i);
        words.push_back({text_.substr(begin, end - begin), quoted, line_});
        i = quoted ? end + 1 : end;
      }
    }
    return words;
  }

 private:
  bool isBlank(std::size_t i) const { return std::strchr(" \t\r\n", text_[i]) && text_[i] != '\0'; }
  bool beginsComment(std::size_t i) const { return comments_ && text_[i] == '#'; }
  std::size_t quoteEnd(std::size_t begin) const {
    const auto end = text_.find_first_of(std::string(1, text_[begin]) + "\n", begin + 1);
    if (end == std::string::npos || text_[end] == '\n') fail("a quote is not closed");
    if (end + 1 < text_.size() && !isBlank(end + 1)) fail("text follows a closing quote");
    return end;
  }
  std::size_t wordEnd(std::size_t end) const {
    for (; end < text_.size() && !isBlank(end) && !beginsComment(end); ++end)
      if (std::iscntrl(static_cast<unsigned char>(text_[end])))
        fail("a control character; an options file is text");
    return end;
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(formatted("%s, line %d: %s", name_.c_str(), line_, message.c_str()));
  }

  const std::string& text_;
  const std::string& name_;
  bool comments_;
  int line_ = 1;
};

/// Returns the rule for names of options, and of groups and interfaces in them, that a name (no
/// dash) violates; empty if none.
std::string violatedRule(const std::string& name) {
  for (const unsigned char c : name) {
    if (c == ' ') return "it contains a blank; write _ for a blank in the name of a group";
    if (std::iscntrl(c))
      return formatted("it contains the control character \\u%04x; rename the group", c);
    if (std::strchr("\"'#,", c))
      return formatted("it contains '%c', which is not allowed in names; rename the group", c);
  }
  return isName("-" + name) ? "" : "it must begin with a letter";
}

/// Returns true for an equation that begins like the name of an option: -a:x + b:y = 0.
bool looksLikeEquation(const Word& word) {
  const auto colon = word.text.find(':');
  return !word.quoted && isName(word.text) && colon != std::string::npos &&
         word.text.find('=', colon) != std::string::npos;
}

/// Throws Error for word i, an option, that such an equation follows.
[[noreturn]] void rejectEquation(const std::vector<Word>& words, std::size_t i,
                                 const std::string& file) {
  const std::string value = words[i + 1].text;
  throw Error(prefixed(Setting{"", "", file, words[i].line}.place(),
                       "option " + words[i].text + ": its value '" + value +
                           "' begins like the name of an option; begin it with a number: '-1*" +
                           value.substr(1) + "'"));
}

/// Returns the text with line breaks and tabs as escapes.
std::string withoutBreaks(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\n' ? "\\n" : c == '\t' ? "\\t" : std::string(1, c);
  return line;
}

/// Throws Error for a setting that PETSc's database, or the record of the run, would change.
void requireSound(const Setting& setting) {
  const auto fail = [&](const std::string& message) {
    throw Error(prefixed(setting.place(), message));
  };
  const std::string& name = setting.name;
  if (const auto equals = name.find('='); equals != std::string::npos)
    fail("option -" + name + ": a blank separates name and value: -" + name.substr(0, equals) +
         " " + name.substr(equals + 1));
  if (const std::string broken = violatedRule(name); !broken.empty())
    fail("'" + withoutBreaks(name) + "' is not the name of an option: " + broken);
  if (name.size() >= PETSC_MAX_OPTION_NAME)
    fail(formatted("the name of option -%s… is too long: %zu characters, at most %d are allowed",
                   name.substr(0, 40).c_str(), name.size(), PETSC_MAX_OPTION_NAME - 1));
  const std::string& value = setting.value;
  if (std::any_of(value.begin(), value.end(),
                  [](unsigned char c) { return std::iscntrl(c) && c != '\t'; }))
    fail("option -" + name + ": its value contains a line break or another control character");
  if (value.find('"') != std::string::npos && value.find('\'') != std::string::npos)
    fail("option -" + name + ": its value contains both kinds of quotes");
}

}  // namespace

bool isName(const std::string& word) {
  PetscBool valid = PETSC_FALSE;
  check(PetscOptionsValidKey(word.c_str(), &valid));
  return valid;
}

std::vector<Word> wordsOfText(const std::string& text, const std::string& name) {
  auto words = Splitter(text, name, false).words();
  for (auto& word : words) word.line = 0;
  return words;
}

bool takeSkip(std::vector<Word>& words) {
  bool skip = false;
  for (std::size_t i = 0; i < words.size();) {
    if (!same(words[i].text, "-skip_petscrc")) {
      ++i;
      continue;
    }
    const bool hasValue = i + 1 < words.size() && !isName(words[i + 1].text);
    const std::string value = hasValue ? words[i + 1].text : "yes";
    skip = !(same(value, "no") || same(value, "false") || same(value, "off") || value == "0");
    const auto name = words.begin() + i;
    words.erase(name, name + (hasValue ? 2 : 1));
  }
  return skip;
}

void SettingsReader::readWords(const std::vector<Word>& words, const std::string& file) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Word& word = words[i];
    if (word.quoted || !isName(word.text)) rejectStray(words, i, file);
    Setting setting{word.text.substr(1), "", file, word.line};
    if (i + 1 < words.size() && looksLikeEquation(words[i + 1])) rejectEquation(words, i, file);
    if (i + 1 < words.size() && words[i + 1].line == word.line &&
        (words[i + 1].quoted || !isName(words[i + 1].text)))
      setting.value = words[++i].text;
    add(setting);
  }
}

void SettingsReader::readYaml(const std::string& text, const std::string& name) {
  for (const auto& setting : settingsOfYaml(text, name)) add(setting);
}

void SettingsReader::readIfThere(const std::string& file) {
  std::error_code unknown;
  if (readFile(file, false) || !fs::is_regular_file(file, unknown)) return;
  throw Error(file + ": " + whyUnreadable(file) + "; -skip_petscrc omits it");
}

/// Reads an options file. Returns false if it cannot be opened.
bool SettingsReader::readFile(std::string file, bool yaml) {
  if (const std::string suffix = ":yaml"; file.size() > suffix.size() && file.ends_with(suffix)) {
    file.resize(file.size() - suffix.size());
    yaml = true;
  }
  std::ifstream stream(file, std::ios::binary);
  std::error_code unknown;
  if (fs::is_directory(file, unknown) || !stream) return false;
  std::string text(largestFile + 1, '\0');
  stream.read(text.data(), text.size());
  text.resize(stream.gcount());
  if (text.size() > largestFile) throw Error(file + ": more than 10 MB is not an options file");
  for (const char* ending : {".yaml", ".yml", ".json"}) yaml = yaml || file.ends_with(ending);
  if (yaml || text.starts_with("%YAML ") || text.starts_with("---"))
    readYaml(text, file);
  else
    readWords(Splitter(text, file, true).words(), file);
  return true;
}

void SettingsReader::rejectStray(const std::vector<Word>& words, std::size_t i,
                                 const std::string& file) const {
  const std::string& stray = words[i].text;
  const std::string place = Setting{"", "", file, words[i].line}.place();
  if (i < 2 || words[i - 1].line != words[i].line)
    throw Error(
        prefixed(place, "'" + stray + "' is not an option: options begin with a dash" +
                            (file.empty() ? "; a case is named by -options_file " + stray : "")));
  const std::string last = words[i - 2].text + " " + words[i - 1].text;
  throw Error(prefixed(place, "'" + stray + "' follows option " + last +
                                  ", which already has a value; a list is separated by commas, "
                                  "and may contain blanks only in quotes"));
}

void SettingsReader::add(const Setting& setting) {
  requireSound(setting);
  const std::string& name = setting.name;
  if (same(name, "options_file") || same(name, "options_file_yaml"))
    return addFile(setting, same(name, "options_file_yaml"));
  if (same(name, "options_string_yaml"))
    return readYaml(setting.value, "option -options_string_yaml");
  for (const char* ofCall : {"help", "h", "version", "skip_petscrc"})
    if (same(name, ofCall))
      throw Error(prefixed(setting.place(), "option -" + name + " belongs on the command line"));
  if (addPrefix(setting)) return;
  settings_.push_back(setting);
  settings_.back().name = joined(prefixes_, "") + name;
  if (FileOption::isDeclared(settings_.back().name))
    settings_.back().value = located(setting.value, setting.file);
}

/// Applies `-prefix_push` or `-prefix_pop`. Returns false for any other setting.
bool SettingsReader::addPrefix(const Setting& setting) {
  if (same(setting.name, "prefix_push")) {
    if (!isName("-" + setting.value))
      throw Error(prefixed(setting.place(), "option -prefix_push '" + setting.value +
                                                "': must begin with a letter"));
    prefixes_.push_back(setting.value);
    return true;
  }
  if (!same(setting.name, "prefix_pop")) return false;
  if (prefixes_.empty())
    throw Error(prefixed(setting.place(), "option -prefix_pop without -prefix_push"));
  prefixes_.pop_back();
  return true;
}

void SettingsReader::addFile(const Setting& setting, bool yaml) {
  const auto fail = [&](const std::string& message) {
    throw Error(prefixed(setting.place(),
                         "option -" + setting.name + " " + setting.value + ": " + message));
  };
  if (setting.value.empty()) fail("no file is named");
  const std::string file = located(setting.value, setting.file);
  if (std::find(open_.begin(), open_.end(), file) != open_.end() || open_.size() > deepest)
    fail("the file includes itself");
  open_.push_back(file);
  const auto before = settings_.size();
  if (!readFile(file, yaml)) {
    std::error_code unknown;
    if (fs::is_directory(file, unknown)) fail("this is a folder");
    const std::string why = whyUnreadable(file);
    fail(why.empty() ? "cannot be read" : why);
  }
  if (settings_.size() == before) fail("the file contains no option");
  open_.pop_back();
}

std::vector<Setting> SettingsReader::all() const {
  const auto less = [](const std::string& a, const std::string& b) {
    return strcasecmp(a.c_str(), b.c_str()) < 0;
  };
  std::map<std::string, const Setting*, decltype(less)> known(less);
  for (const auto& setting : settings_) {
    const auto [earlier, isNew] = known.insert({setting.name, &setting});
    if (!isNew && earlier->first != setting.name)
      throw Error(
          prefixed(setting.place(), "options -" + earlier->first + " and -" + setting.name +
                                        " differ only in capital letters, which PETSc ignores"));
  }
  if (known.size() > mostOptions)
    throw Error(
        formatted("%zu options are given; PETSc stores at most %zu", known.size(), mostOptions));
  return settings_;
}

}  // namespace squeal
