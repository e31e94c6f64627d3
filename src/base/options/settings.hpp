#pragma once
/// These functions read options as they are given: on the command line, in options files, in the
/// environment. Everything is read here, by rank 0, and then put into PETSc's options database, in
/// the order in which it stands: the later one of two settings wins.
///
/// PETSc's own readers skip words that belong to no option, stop at a NUL byte and end the run with
/// a traceback for an error of syntax. The names of options and files and their meaning are
/// PETSc's.
#include <mpi.h>

#include <map>
#include <string>
#include <vector>

namespace squeal {

/// An option as it is given once.
struct Setting {
  std::string name, value;  ///< name without the dash; the value is empty for a bare option
  std::string file;         ///< options file that holds it; empty outside of files
  int line = 0;             ///< line in the file, from 1; 0 outside of files

  /// Returns a text such as "disc.yaml, line 3"; empty if the setting is in no file.
  std::string place() const;
};

/// Returns the options of a program call in the order in which they count: PETSc's resource files
/// (~/.petscrc, .petscrc, petscrc; none with `-skip_petscrc`), PETSC_OPTIONS, PETSC_OPTIONS_YAML,
/// then the words of the command line with the options files that they name. Throws Error, with
/// file and line, for text that cannot be understood.
std::vector<Setting> settingsOfCall(const std::vector<std::string>& words);

/// Returns the settings of a command line given as one text, with quotes around values with blanks.
/// Throws Error for text that cannot be understood.
std::vector<Setting> settingsOfText(const std::string& text);

/// Returns the options of one file. It is YAML by its name (.yaml, .yml, .json, or `:yaml` at its
/// end) or first line (--- or %YAML); otherwise it has lines `-name value`. Throws Error, with file
/// and line, for text that cannot be understood, and for a file without an option.
std::vector<Setting> settingsOfFile(const std::string& file);

/// Returns the path of a file that an options file names: beside that file or, if it is not there,
/// in the working folder. An empty `namedIn` says that the command line names it.
std::string located(const std::string& path, const std::string& namedIn);

/// Collective. Returns the settings of rank 0 on all ranks.
std::vector<Setting> onAllRanks(MPI_Comm comm, const std::vector<Setting>& ofRankZero);

/// Not collective. Puts options into PETSc's database on this rank and records their places.
void insert(const std::vector<Setting>& settings);

/// Not collective. Removes all options on this rank.
void clearOptions();
/// Not collective. Removes the option of this name on this rank.
void removeOption(const std::string& name);

/// Returns name and value of every given option, those of PETSc included, whether from a file or
/// the command line. Borrowed until the next insert().
const std::map<std::string, std::string>& givenOptions();

/// Collective. Reads an options file on rank 0 and inserts its settings on all ranks.
void insertFile(MPI_Comm comm, const std::string& file);

/// Returns the place where this value of an option was set; a setting without a file if the option
/// does not have this value.
Setting origin(const std::string& name, const std::string& value);

/// Returns "option -a 2 (case.yaml, line 3)", with the place where the value `given` stands if it
/// stands in a file; an empty `value` is left out.
std::string optionText(const std::string& name, const std::string& value, const std::string& given);

/// Returns a line for each setting of a file that a later one has replaced by another value:
/// "option -a 2 replaces 1 (case.yaml, line 3)".
std::vector<std::string> replacedSettings();

/// Returns a line of an options file, with quotes where the value needs them.
std::string optionLine(const std::string& name, const std::string& value);

}  // namespace squeal
