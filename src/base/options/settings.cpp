// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/settings.hpp"

#include <petscsys.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/options/settings_reader.hpp"
#include "base/petsc/check.hpp"
#include "base/system/stream.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

/// The options of this run, as PETSc's database stores them.
struct Record {
  std::map<std::string, std::string> values;  ///< by name
  std::map<std::string, Setting> places;      ///< where they were set, by name
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
  // A file next to the options file is used even if it cannot be read or is a broken link.
  if (fs::symlink_status(beside, ignored).type() == fs::file_type::not_found) return path;
  // A path into the working folder becomes relative to it.
  const fs::path inside = fs::proximate(beside, ignored);
  return ignored || inside.empty() || *inside.begin() == ".." ? beside.string() : inside.string();
}

std::vector<Setting> settingsOfCall(const std::vector<std::string>& arguments) {
  std::vector<Word> words;
  for (const auto& argument : arguments) words.push_back({argument, false, 0});
  SettingsReader reader;
  if (!takeSkip(words)) {
    if (const auto home = environment("HOME")) reader.readIfThere(*home + "/.petscrc");
    reader.readIfThere(".petscrc");
    reader.readIfThere("petscrc");
  }
  if (const auto text = environment("PETSC_OPTIONS"))
    reader.readWords(wordsOfText(*text, "PETSC_OPTIONS"), "");
  if (const auto text = environment("PETSC_OPTIONS_YAML"))
    reader.readYaml(*text, "PETSC_OPTIONS_YAML");
  reader.readWords(words, "");
  return reader.all();
}

std::vector<Setting> settingsOfText(const std::string& text) {
  SettingsReader reader;
  reader.readWords(wordsOfText(text, "'" + text + "'"), "");
  return reader.all();
}

std::vector<Setting> settingsOfFile(const std::string& file) {
  SettingsReader reader;
  reader.readWords({{"-options_file", false, 0}, {file, true, 0}}, "");
  return reader.all();
}

static void fields(Stream& stream, Setting& setting) {
  stream(setting.name, setting.value, setting.file, setting.line);
}

std::vector<Setting> onAllRanks(MPI_Comm comm, const std::vector<Setting>& ofRankZero) {
  std::vector<Setting> settings;
  if (mpi::rank(comm) == 0) settings = ofRankZero;
  broadcast(comm, settings);
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
