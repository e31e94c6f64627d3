// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads settings from command lines, options files and the environment.
#include <optional>
#include <string>
#include <vector>

#include "base/options/settings.hpp"

namespace squeal {

/// A word of a command line or of an options file.
struct Word {
  std::string text;
  bool quoted = false;
  int line = 0;  ///< line in the file, from 1; 0 outside of files
};

/// Returns true if PETSc interprets the word, which includes the dash, as the name of an option.
bool isName(const std::string& word);

/// Returns the words of a text that has no comments, as if it were one line: line breaks separate
/// words as blanks do. Throws Error, with `name` and the line, if a quote is not closed or a word
/// contains a control character.
std::vector<Word> wordsOfText(const std::string& text, const std::string& name);

/// Removes every `-skip_petscrc [flag]` from the words. Returns the last flag, where a missing flag
/// means true; returns false if the option is not given.
bool takeSkip(std::vector<Word>& words);

/// Collects the settings of several sources in order. Throws Error, with file and line, for text
/// that it cannot parse.
class SettingsReader {
 public:
  /// Reads the words of a command line, or of a file.
  void readWords(const std::vector<Word>& words, const std::string& file);
  void readYaml(const std::string& text, const std::string& name);
  /// Reads one of PETSc's resource files, if it exists. Throws Error if it exists but cannot be
  /// read.
  void readIfThere(const std::string& file);
  /// Returns the settings. Throws Error if there are more than PETSc's database can store, or if
  /// two names differ only in upper and lower case.
  std::vector<Setting> all() const;

 private:
  bool readFile(std::string file, bool yaml);
  [[noreturn]] void rejectStray(const std::vector<Word>& words, std::size_t i,
                                const std::string& file) const;
  void add(const Setting& setting);
  bool addPrefix(const Setting& setting);
  void addFile(const Setting& setting, bool yaml);

  std::vector<Setting> settings_;
  std::vector<std::string> prefixes_;  // of -prefix_push
  std::vector<std::string> open_;      // files that are being read
};

}  // namespace squeal
