// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads the options given on the command line, in options files and in the environment. Rank 0
/// reads all options. They are inserted into PETSc's options database in the order in which they
/// are given, so the last setting of an option takes effect.
///
/// The options that name options files, and the format of these files, are those of PETSc. PETSc's
/// own readers are not used because they skip words that belong to no option, stop at a NUL byte,
/// and end the run with a traceback on a syntax error.
#include <mpi.h>

#include <map>
#include <string>
#include <vector>

namespace squeal {

/// An option with its value, as given in one place.
struct Setting {
  std::string name, value;  ///< name without the dash; the value is empty if only the name is given
  std::string file;         ///< options file that contains it; empty outside of files
  int line = 0;             ///< line in the file, from 1; 0 outside of files

  /// Returns a text such as "disc.yaml, line 3"; empty if the setting is in no file.
  std::string place() const;
};

/// Returns the options of a program call in order of increasing priority: PETSc's resource files
/// (~/.petscrc, .petscrc, petscrc; none with `-skip_petscrc`), PETSC_OPTIONS, PETSC_OPTIONS_YAML,
/// then the command line with its options files. Throws Error, with file and line, for text that
/// cannot be parsed.
std::vector<Setting> settingsOfCall(const std::vector<std::string>& words);

/// Returns the settings of a command line given as one text, with quotes around values that contain
/// blanks. Throws Error for text that cannot be parsed.
std::vector<Setting> settingsOfText(const std::string& text);

/// Returns the options of one file. The file is read as YAML if its name (.yaml, .yml, .json, or
/// the suffix `:yaml`) or its first line (--- or %YAML) indicates this; otherwise it must consist
/// of lines `-name value`. Throws Error, with file and line, for text that cannot be parsed, and
/// for a file without options.
std::vector<Setting> settingsOfFile(const std::string& file);

/// Returns the path at which to open a file that the options file `namedIn` names by `path`. `path`
/// is relative to the folder of `namedIn` or, if the file is not there, to the working folder.
/// `namedIn` is empty if `path` is given on the command line.
std::string located(const std::string& path, const std::string& namedIn);

/// Collective. Returns the settings of rank 0 on all ranks.
std::vector<Setting> onAllRanks(MPI_Comm comm, const std::vector<Setting>& ofRankZero);

/// Not collective. Inserts options into PETSc's database on this rank and records where they were
/// given.
void insert(const std::vector<Setting>& settings);

/// Not collective. Removes all options on this rank.
void clearOptions();
/// Not collective. Removes the option of this name on this rank.
void removeOption(const std::string& name);

/// Returns the name and value of every given option, including those of PETSc. Borrowed until the
/// next insert().
const std::map<std::string, std::string>& givenOptions();

/// Collective. Reads an options file on rank 0 and inserts its settings on all ranks.
void insertFile(MPI_Comm comm, const std::string& file);

/// Returns the last setting of the option if it gave this value; otherwise a setting with this
/// value and without a file.
Setting origin(const std::string& name, const std::string& value);

/// Returns a text such as "option -a 2 (case.yaml, line 3)". An empty `value` is omitted. The
/// parentheses give the place where a file sets the option to `given`; they are omitted if there is
/// none.
std::string optionText(const std::string& name, const std::string& value, const std::string& given);

/// Returns a line for each setting of a file that a later setting has replaced by another value:
/// "option -a 2 replaces 1 (case.yaml, line 3)".
std::vector<std::string> replacedSettings();

/// Returns the line of an options file that sets this option, with quotes if the value needs them.
std::string optionLine(const std::string& name, const std::string& value);

}  // namespace squeal
