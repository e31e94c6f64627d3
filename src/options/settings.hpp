#pragma once
/// Options as they are given: on the command line, in options files, in the environment. Everything
/// is read here, by rank 0, and then put into PETSc's options database, in the order in which it
/// stands: what comes later wins.
///
/// PETSc's own readers skip words that belong to no option, stop at a NUL byte and end the run with
/// a traceback for an error of syntax; names, files and their meaning are theirs.
#include <mpi.h>

#include <string>
#include <vector>

namespace squeal {

struct Setting {
  std::string name, value;  ///< name without the dash; an empty value: the bare option
  std::string file;         ///< options file that holds it; empty: command line or environment
  int line = 0;             ///< in the file, from 1

  /// "disc.yaml, line 3"; empty if it stands in no file.
  std::string place() const;
};

/// The options of a program call in the order in which they count: PETSc's resource files
/// (~/.petscrc, .petscrc, petscrc; none with
/// `-skip_petscrc`), PETSC_OPTIONS, PETSC_OPTIONS_YAML, the words of the command line with the
/// options files they name. Error with file and line for what cannot be understood.
std::vector<Setting> settingsOfCall(const std::vector<std::string>& words);

/// The words of a command line in one text, values with blanks in quotes.
std::vector<Setting> settingsOfText(const std::string& text);

/// The options of one file: YAML by its name (.yaml, .yml, .json, or `:yaml` at the end of it) or
/// first line (--- or %YAML), otherwise lines
/// `-name value`. Error with file and line for what cannot be understood, and for a file without an
/// option.
std::vector<Setting> settingsOfFile(const std::string& file);

/// Where a file lies that an options file names: beside that file or, if it is not there, in the
/// working folder. `namedIn` empty: the command line names it.
std::string located(const std::string& path, const std::string& namedIn);

/// The options of a YAML text: names of nested maps joined by `_`, items of lists joined by commas.
/// Errors begin with `name`.
std::vector<Setting> settingsOfYaml(const std::string& text, const std::string& name);

/// Collective. The settings of rank 0 on all ranks.
std::vector<Setting> onAllRanks(MPI_Comm comm, const std::vector<Setting>& ofRankZero);

/// Puts options into PETSc's database and remembers where they stand.
void insert(const std::vector<Setting>& settings);

/// Collective. Inserts an options file: `insert` of `settingsOfFile`.
void insertFile(MPI_Comm comm, const std::string& file);

/// Where the value of an option was set, as far as it came through insert() and still holds: an
/// empty file otherwise.
Setting origin(const std::string& name, const std::string& value);

/// One line for each setting of a file that a later one replaced with another value: "option -a 2
/// replaces 1 (case.yaml, line 3)".
std::vector<std::string> replacedSettings();

/// A line of an options file, with quotes where the value needs them.
std::string optionLine(const std::string& name, const std::string& value);

}  // namespace squeal
