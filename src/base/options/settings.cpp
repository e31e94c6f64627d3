#include "base/options/settings.hpp"

#include <petscsys.h>
#include <strings.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "base/options/options.hpp"
#include "base/options/yaml.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "base/system/unreadable.hpp"

namespace squeal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largestFile =
    10'000'000;  // bytes; a mesh given by mistake is not read to its end
constexpr std::size_t mostOptions =
    500;  // PETSc's database holds 512, some of which it sets itself

struct Word {
  std::string text;
  bool quoted = false;
  int line = 0;  ///< in a file, from 1
};

bool same(const std::string& a, const char* b) {
  return strcasecmp(a.c_str(), b) == 0;
}  // as PETSc compares names

bool isName(const std::string& word) {
  PetscBool valid = PETSC_FALSE;
  check(PetscOptionsValidKey(word.c_str(), &valid));
  return valid;
}

std::string prefixed(const std::string& place, const std::string& message) {
  return place.empty() ? message : place + ": " + message;
}

/// Returns the words of a text, which are separated by blanks. A word that begins with a quote ends
/// at the next one of its kind in the line. With `comments`, as in files, `#` begins a comment.
/// Throws Error, with `name` and the line, for an open quote and for a control character.
std::vector<Word> wordsOf(const std::string& text, const std::string& name, bool comments) {
  std::vector<Word> words;
  const auto blank = [&](std::size_t i) {
    return std::strchr(" \t\r\n", text[i]) && text[i] != '\0';
  };
  int line = 1;
  const auto fail = [&](const std::string& message) {
    throw Error(formatted("%s, line %d: %s", name.c_str(), line, message.c_str()));
  };
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') ++line;
    if (blank(i)) {
      ++i;
    } else if (comments && text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (text[i] == '"' || text[i] == '\'') {
      const auto end = text.find_first_of(std::string(1, text[i]) + "\n", i + 1);
      if (end == std::string::npos || text[end] == '\n') fail("a quote is left open");
      if (end + 1 < text.size() && !blank(end + 1)) fail("text follows a closing quote");
      words.push_back({text.substr(i + 1, end - i - 1), true, line});
      i = end + 1;
    } else {
      std::size_t end = i;
      while (end < text.size() && !blank(end) && !(comments && text[end] == '#')) {
        const unsigned char character = text[end];
        if (std::iscntrl(character)) fail("a control character; an options file is text");
        ++end;
      }
      words.push_back({text.substr(i, end - i), false, line});
      i = end;
    }
  }
  return words;
}

/// Returns the words as if they stood in one line: line breaks mean no more than blanks.
std::vector<Word> onOneLine(std::vector<Word> words) {
  for (auto& word : words) word.line = 0;
  return words;
}

/// Returns the rule for names of options, and of groups and interfaces in them, that a name (no
/// dash) breaks; empty if none.
std::string brokenRule(const std::string& name) {
  for (const unsigned char c : name) {
    if (c == ' ') return "it holds a blank; write _ for a blank in the name of a group";
    if (std::iscntrl(c))
      return formatted("it holds the control character \\u%04x; rename the group", c);
    if (std::strchr("\"'#,", c))
      return formatted("it holds '%c', which no name may hold; rename the group", c);
  }
  return isName("-" + name) ? "" : "it must begin with a letter";
}

/// Returns the text with line breaks and tabs as escapes.
std::string withoutBreaks(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\n' ? "\\n" : c == '\t' ? "\\t" : std::string(1, c);
  return line;
}

/// Throws Error for a setting that PETSc's database, or the record of the run, would not keep as it
/// is.
void requireSound(const Setting& setting) {
  const auto fail = [&](const std::string& message) {
    throw Error(prefixed(setting.place(), message));
  };
  const std::string& name = setting.name;
  if (const auto equals = name.find('='); equals != std::string::npos)
    fail("option -" + name + ": a blank separates name and value: -" + name.substr(0, equals) +
         " " + name.substr(equals + 1));
  if (const std::string broken = brokenRule(name); !broken.empty())
    fail("'" + withoutBreaks(name) + "' is not the name of an option: " + broken);
  if (name.size() >= PETSC_MAX_OPTION_NAME)
    fail(formatted("the name of option -%s… is too long: %zu characters, at most %d are allowed",
                   name.substr(0, 40).c_str(), name.size(), PETSC_MAX_OPTION_NAME - 1));
  const std::string& value = setting.value;
  if (std::any_of(value.begin(), value.end(),
                  [](unsigned char c) { return std::iscntrl(c) && c != '\t'; }))
    fail("option -" + name + ": its value holds a line break or another control character");
  if (value.find('"') != std::string::npos && value.find('\'') != std::string::npos)
    fail("option -" + name + ": its value holds both kinds of quotes");
}

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

class Reader {
 public:
  std::vector<Setting> settings;

  void readWords(const std::vector<Word>& words, const std::string& file) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Word& word = words[i];
      if (word.quoted || !isName(word.text)) rejectStray(words, i, file);
      Setting setting{word.text.substr(1), "", file, word.line};
      if (i + 1 < words.size() && words[i + 1].line == word.line &&
          (words[i + 1].quoted || !isName(words[i + 1].text)))
        setting.value = words[++i].text;
      add(setting);
    }
  }

  void readYaml(const std::string& text, const std::string& name) {
    for (const auto& setting : settingsOfYaml(text, name)) add(setting);
  }

  /// Reads a file that PETSc reads by default, if it exists. Throws Error if it cannot be read.
  void readIfThere(const std::string& file) {
    std::error_code unknown;
    if (readFile(file, false) || !fs::is_regular_file(file, unknown)) return;
    throw Error(file + ": " + whyUnreadable(file) + "; -skip_petscrc leaves it out");
  }

  /// Reads an options file. Returns false if it cannot be opened.
  bool readFile(std::string file, bool yaml) {
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
      readWords(wordsOf(text, file, true), file);
    return true;
  }

 private:
  [[noreturn]] void rejectStray(const std::vector<Word>& words, std::size_t i,
                                const std::string& file) const {
    const std::string& stray = words[i].text;
    const std::string place = Setting{"", "", file, words[i].line}.place();
    if (i < 2 || words[i - 1].line != words[i].line)
      throw Error(
          prefixed(place, "'" + stray + "' is not an option: those begin with a dash" +
                              (file.empty() ? "; a case is named by -options_file " + stray : "")));
    const std::string last = words[i - 2].text + " " + words[i - 1].text;
    throw Error(prefixed(place, "'" + stray + "' follows option " + last +
                                    ", which has its value; a list is separated by commas, with "
                                    "blanks only inside of quotes"));
  }

  void add(const Setting& setting) {
    requireSound(setting);
    const std::string& name = setting.name;
    if (same(name, "options_file") || same(name, "options_file_yaml"))
      return addFile(setting, same(name, "options_file_yaml"));
    if (same(name, "options_string_yaml"))
      return readYaml(setting.value, "option -options_string_yaml");
    for (const char* ofCall : {"help", "h", "version", "skip_petscrc"})
      if (same(name, ofCall))
        throw Error(prefixed(setting.place(), "option -" + name + " belongs on the command line"));
    if (same(name, "prefix_push")) {
      if (!isName("-" + setting.value))
        throw Error(prefixed(setting.place(), "option -prefix_push '" + setting.value +
                                                  "': must begin with a letter"));
      prefixes_.push_back(setting.value);
    } else if (same(name, "prefix_pop")) {
      if (prefixes_.empty())
        throw Error(prefixed(setting.place(), "option -prefix_pop without -prefix_push"));
      prefixes_.pop_back();
    } else {
      settings.push_back(setting);
      settings.back().name = joined(prefixes_, "") + name;
      if (FileOption::isOne(settings.back().name))
        settings.back().value = located(setting.value, setting.file);
    }
  }

  void addFile(const Setting& setting, bool yaml) {
    const auto fail = [&](const std::string& message) {
      throw Error(prefixed(setting.place(),
                           "option -" + setting.name + " " + setting.value + ": " + message));
    };
    if (setting.value.empty()) fail("no file is named");
    const std::string file = located(setting.value, setting.file);
    if (std::find(open_.begin(), open_.end(), file) != open_.end() || open_.size() > 20)
      fail("the file reads itself");
    open_.push_back(file);
    const auto before = settings.size();
    if (!readFile(file, yaml)) {
      std::error_code unknown;
      if (fs::is_directory(file, unknown)) fail("this is a folder");
      const std::string why = whyUnreadable(file);
      fail(why.empty() ? "cannot be read" : why);
    }
    if (settings.size() == before) fail("the file holds no option");
    open_.pop_back();
  }

  std::vector<std::string> prefixes_, open_;
};

/// Takes `-skip_petscrc [flag]` out of the words. Returns the flag; the last one counts.
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

void requireRoom(const std::vector<Setting>& settings) {
  const auto less = [](const std::string& a, const std::string& b) {
    return strcasecmp(a.c_str(), b.c_str()) < 0;
  };
  std::map<std::string, const Setting*, decltype(less)> known(less);
  for (const auto& setting : settings) {
    const auto [earlier, isNew] = known.insert({setting.name, &setting});
    if (!isNew && earlier->first != setting.name)
      throw Error(prefixed(setting.place(),
                           "options -" + earlier->first + " and -" + setting.name +
                               " differ by capital letters alone, which PETSc takes for the same"));
  }
  if (known.size() > mostOptions)
    throw Error(formatted("%zu options are given; PETSc keeps no more than %zu", known.size(),
                          mostOptions));
}

/// The options of this run, as PETSc's database holds them.
struct Record {
  std::map<std::string, std::string> values;  ///< by name
  std::map<std::string, Setting> places;      ///< where they stand, by name
  std::map<std::string, Setting> fromFiles;   ///< settings of files that were replaced, by name
};

Record& record() {
  static Record options;
  return options;
}

}  // namespace

std::string Setting::place() const {
  return file.empty() ? "" : formatted("%s, line %d", file.c_str(), line);
}

std::string located(const std::string& path, const std::string& namedIn) {
  if (namedIn.empty() || fs::path(path).is_absolute()) return path;
  const fs::path beside = fs::path(namedIn).parent_path() / path;
  std::error_code ignored;
  // A file beside the options file is taken even if it cannot be read or is a broken link.
  if (fs::symlink_status(beside, ignored).type() == fs::file_type::not_found) return path;
  // A file inside of the working folder is named by the short way from there.
  const fs::path inside = fs::proximate(beside, ignored);
  return ignored || inside.empty() || *inside.begin() == ".." ? beside.string() : inside.string();
}

std::vector<Setting> settingsOfCall(const std::vector<std::string>& arguments) {
  std::vector<Word> words;
  for (const auto& argument : arguments) words.push_back({argument, false, 0});
  Reader reader;
  if (!takeSkip(words)) {
    if (const auto home = environment("HOME")) reader.readIfThere(*home + "/.petscrc");
    reader.readIfThere(".petscrc");
    reader.readIfThere("petscrc");
  }
  if (const auto text = environment("PETSC_OPTIONS"))
    reader.readWords(onOneLine(wordsOf(*text, "PETSC_OPTIONS", false)), "");
  if (const auto text = environment("PETSC_OPTIONS_YAML"))
    reader.readYaml(*text, "PETSC_OPTIONS_YAML");
  reader.readWords(words, "");
  requireRoom(reader.settings);
  return reader.settings;
}

std::vector<Setting> settingsOfText(const std::string& text) {
  Reader reader;
  reader.readWords(onOneLine(wordsOf(text, "'" + text + "'", false)), "");
  requireRoom(reader.settings);
  return reader.settings;
}

std::vector<Setting> settingsOfFile(const std::string& file) {
  Reader reader;
  reader.readWords({{"-options_file", false, 0}, {file, true, 0}}, "");
  requireRoom(reader.settings);
  return reader.settings;
}

std::vector<Setting> onAllRanks(MPI_Comm comm, const std::vector<Setting>& ofRankZero) {
  std::string packed;  // no text holds a line break
  if (mpi::rank(comm) == 0)
    for (const auto& setting : ofRankZero)
      packed += setting.name + "\n" + setting.value + "\n" + setting.file + "\n" +
                std::to_string(setting.line) + "\n";
  mpi::broadcast(comm, packed);
  const auto parts = split(packed, '\n');
  std::vector<Setting> settings;
  for (std::size_t i = 0; i + 3 < parts.size(); i += 4)
    settings.push_back({parts[i], parts[i + 1], parts[i + 2], std::stoi(parts[i + 3])});
  return settings;
}

void insert(const std::vector<Setting>& settings) {
  auto& [values, places, fromFiles] = record();
  for (const auto& setting : settings) {
    check(PetscOptionsSetValue(nullptr, ("-" + setting.name).c_str(), setting.value.c_str()));
    values[setting.name] = setting.value;
    Setting& latest = places[setting.name];
    if (!latest.file.empty() && latest.value != setting.value) fromFiles[setting.name] = latest;
    latest = setting;
  }
}

void clearOptions() {
  check(PetscOptionsClear(nullptr));
  record() = {};
}

void removeOption(const std::string& name) {
  check(PetscOptionsClearValue(nullptr, ("-" + name).c_str()));
  auto& [values, places, fromFiles] = record();
  values.erase(name), places.erase(name), fromFiles.erase(name);
}

const std::map<std::string, std::string>& givenOptions() { return record().values; }

void insertFile(MPI_Comm comm, const std::string& file) {
  std::vector<Setting> settings;
  onFirstRank(comm, "", [&] { settings = settingsOfFile(file); });
  insert(onAllRanks(comm, settings));
}

Setting origin(const std::string& name, const std::string& value) {
  const auto& places = record().places;
  const auto known = places.find(name);
  return known != places.end() && known->second.value == value ? known->second
                                                               : Setting{name, value, "", 0};
}

std::string optionText(const std::string& name, const std::string& value,
                       const std::string& given) {
  const std::string place = origin(name, given).place();
  return "option -" + name + (value.empty() ? "" : " " + value) +
         (place.empty() ? "" : " (" + place + ")");
}

std::vector<std::string> replacedSettings() {
  std::vector<std::string> lines;
  const auto& [values, places, fromFiles] = record();
  for (const auto& [name, earlier] : fromFiles)
    if (const auto& value = values.at(name); value != earlier.value)
      lines.push_back("option -" + name + " " + value + " replaces " + earlier.value + " (" +
                      earlier.place() + ")");
  return lines;
}

std::string optionLine(const std::string& name, const std::string& value) {
  if (value.empty()) return "-" + name + "\n";
  const bool plain = value.find_first_of(" \t#\"'") == std::string::npos && !isName(value);
  const std::string quote = plain ? "" : value.find('"') == std::string::npos ? "\"" : "'";
  return "-" + name + " " + quote + value + quote + "\n";
}

}  // namespace squeal
