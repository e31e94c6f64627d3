// SPDX-License-Identifier: BSD-2-Clause
// Options as they are given: words of the command line, options files in YAML and in lines, and
// the messages on mistakes in them.
#include "base/options/settings.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cstdlib>

#include "base/options/options.hpp"
#include "base/options/yaml.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::contains;
using test::errorOf;
using Pairs = std::vector<std::pair<std::string, std::string>>;

Pairs pairs(const std::vector<Setting>& settings) {
  Pairs list;
  for (const auto& setting : settings) list.emplace_back(setting.name, setting.value);
  return list;
}

Pairs yaml(const std::string& text) { return pairs(settingsOfYaml(text, "case.yaml")); }
std::string yamlError(const std::string& text) {
  return errorOf([&] { settingsOfYaml(text, "case.yaml"); });
}

/// Collective. Each text gets its own file, since another rank may still be reading the last one.
std::string fileWith(const std::string& text, const std::string& suffix = ".txt") {
  static int count = 0;
  return test::writeFile("settings_" + std::to_string(count++) + suffix, text);
}

TEST(Yaml, NestedNamesAreJoined) {
  EXPECT_EQ(yaml("# comment\na:\n  b:\n    c: 1.5  # m\n  d: x y\nquiet:\ne_f: -1\n"),
            (Pairs{{"a_b_c", "1.5"}, {"a_d", "x y"}, {"quiet", ""}, {"e_f", "-1"}}));
  EXPECT_EQ(yaml("{\"a\": {\"b\": 1, \"c\": \"two\"}}"),
            (Pairs{{"a_b", "1"}, {"a_c", "two"}}));  // JSON
  EXPECT_EQ(yaml(""), Pairs{});
  EXPECT_EQ(yaml("# nothing\n"), Pairs{});
}

// At every level, in block and in flow style, and as one quoted text.
TEST(Yaml, ListsAreJoinedByCommas) {
  EXPECT_EQ(yaml("a: [0, 0.2,0.4]\n"), (Pairs{{"a", "0,0.2,0.4"}}));
  EXPECT_EQ(yaml("a:\n  b:\n    - 0\n    - -0.01\n    - 1e3\n"), (Pairs{{"a_b", "0,-0.01,1e3"}}));
  EXPECT_EQ(yaml("a: {b: {c: [x, y]}}\n"), (Pairs{{"a_b_c", "x,y"}}));
  EXPECT_EQ(yaml("a: \"0, 0.2\"\n"), (Pairs{{"a", "0, 0.2"}}));
  EXPECT_EQ(yaml("a: 0, 0.2\n"), (Pairs{{"a", "0, 0.2"}}));
  EXPECT_EQ(yaml("a: [0:0.6:0.1]\n"), (Pairs{{"a", "0:0.6:0.1"}}));
}

// PETSc's reader supports them as well.
TEST(Yaml, AliasesAndMergeKeys) {
  const std::string iron = "hat: &iron\n  young: 1\n  density: 7\n";
  EXPECT_EQ(
      yaml(iron + "disc: *iron\n"),
      (Pairs{
          {"hat_young", "1"}, {"hat_density", "7"}, {"disc_young", "1"}, {"disc_density", "7"}}));
  const Pairs expected{
      {"hat_young", "1"}, {"hat_density", "7"}, {"disc_young", "2"}, {"disc_density", "7"}};
  EXPECT_EQ(yaml(iron + "disc:\n  <<: *iron\n  young: 2\n"), expected);
  // Entries next to the merge key have priority, also those before it.
  EXPECT_EQ(yaml(iron + "disc:\n  young: 2\n  <<: [*iron]\n"), expected);
  EXPECT_TRUE(contains(yamlError(iron + "disc:\n  <<: *iron\n  young: 2\n  young: 3\n"),
                       "case.yaml, line 7: a second value of -disc_young"));
}

TEST(Yaml, MistakesAreNamedWithTheirLine) {
  const std::vector<std::tuple<std::string, std::string, std::string>> mistakes{
      {"a:\n\tb: 1\n", "line 2", "tab"},
      {"a:\n  b: 1\n   c: 2\n", "line 3", "indented wrongly"},
      {"a:\n    b: 1\n  c: 2\n", "line 3", "indented wrongly"},
      {"a: 1\nb: \"x\nc: 2\n", "begins in line 2", "quote"},
      {"a: 1\nb: [1, 2\nc: 2\n", "line", "bracket left open"},
      {"- a\n- b\n", "line 1", "a list at the top"},
      {"hello\n", "line 1", "a text at the top"},
      {"a: 1\nb: 2\na: 3\n", "line 3", "a second value of -a, already set in line 1"},
      {"a:\n  b: 1\na_b: 1\n", "line 3", "a second value of -a_b, already set in line 2"},
      {"a:\n  b: 1\nc: 2\na:\n  d: 1\n", "line 4", "'a' is given twice, first in line 1"},
      {"a:\n  b: {c: 1}\n  b: {d: 2}\n", "line 3", "'b' is given twice, first in line 2"},
      {"a: 1\na: {b: 2}\n", "line 2", "'a' is given twice, first in line 1"},
      {"a: {b: 2}\n\na: 1\n", "line 3", "'a' is given twice, first in line 1"},
      {"a: &a {b: 1}\nc: &c {b: 2}\nd:\n  <<: *a\n  <<: *c\n", "line 5", "'<<' is given twice"},
      {"a: 1\n---\nb: 2\n", "line", "second document"},
      {"a: 1\nb: *c\n", "line 2", "undefined alias"},
      {"a: 1\nb: &b\n  c: *b\n", "line", "alias contain itself"},
      {"a: 1\nb: !include c.yaml\n", "line 2", "tag '!include'"},
      {"a: 1\nb: {}\n", "line 2", "without entries"},
      {"a: 1\nb: []\n", "line 2", "list of -b is empty"},
      {"a: 1\nb: [1, '', 2]\n", "line 2", "list of -b contains an empty item"},
      {"a:\n  b: [1, [2, 3]]\n", "line 2", "list of -a_b contains a list"},
      {"a: 1\n? [b]\n: 2\n", "line 2", "in place of a name"},
      {std::string("a: 1\nb: \0\1\2\n", 12), "line 2", "control characters"},
      {"a: 1\nb: \xff\xfe\n", "line 2", "UTF-8"},
  };
  for (const auto& [text, line, what] : mistakes) {
    const std::string message = yamlError(text);
    EXPECT_TRUE(contains(message, "case.yaml, ") && contains(message, line) &&
                contains(message, what))
        << text << ": " << message;
    EXPECT_FALSE(contains(message, "\n")) << message;
  }
}

// Aliases of aliases multiply; a file of a hundred bytes must not fill the memory.
TEST(Yaml, AliasesDoNotMultiplyWithoutEnd) {
  std::string text = "a0: &a0 {x: 1, y: 2}\n";
  for (int i = 1; i < 40; ++i)
    text += formatted("a%d: &a%d {x: *a%d, y: *a%d}\n", i, i, i - 1, i - 1);
  EXPECT_TRUE(contains(yamlError(text), "more than 10000 options"));
}

TEST(Words, NamesAndValues) {
  EXPECT_EQ(pairs(settingsOfCall({"-a", "1", "-quiet", "-b", "-1e3,2", "-c", "-.5", "-d", "0, 0.2",
                                  "-e", "-inf", "-f", ""})),
            (Pairs{{"a", "1"},
                   {"quiet", ""},
                   {"b", "-1e3,2"},
                   {"c", "-.5"},
                   {"d", "0, 0.2"},
                   {"e", "-inf"},
                   {"f", ""}}));
  EXPECT_EQ(pairs(settingsOfCall({"-prefix_push", "a_", "-b", "1", "-prefix_push", "c_", "-d", "2",
                                  "-prefix_pop", "-prefix_pop", "-e", "3"})),
            (Pairs{{"a_b", "1"}, {"a_c_d", "2"}, {"e", "3"}}));
  EXPECT_EQ(pairs(settingsOfCall({"-options_string_yaml", "{a: {b: 1}}", "-c", "2"})),
            (Pairs{{"a_b", "1"}, {"c", "2"}}));
}

// The name of a group, too, is part of the name of an option.
TEST(Words, RefusedNamesAreGivenWithTheirRule) {
  const auto message = [](const std::string& name) {
    return errorOf([&] { settingsOfCall({name, "1"}); });
  };
  const std::string is = "' is not the name of an option: ";
  EXPECT_EQ(
      message("-contact_a,b_pad"),
      "'contact_a,b_pad" + is + "it contains ',', which is not allowed in names; rename the group");
  EXPECT_EQ(message("-material_disc#1_young"),
            "'material_disc#1_young" + is +
                "it contains '#', which is not allowed in names; rename the group");
  EXPECT_EQ(message("-material_a\x1b[31m_young"),
            "'material_a\x1b[31m_young" + is +
                "it contains the control character \\u001b; rename the group");
  EXPECT_EQ(yamlError("material:\n  disc:\n    young: 1\n"), "");
  const auto file = fileWith("material:\n  the disc:\n    young: 1\n", ".yaml");
  EXPECT_EQ(errorOf([&] { settingsOfFile(file); }),
            file + ", line 3: 'material_the disc_young" + is +
                "it contains a blank; write _ for a blank in the name of a group");
  EXPECT_TRUE(contains(message("-" + std::string(600, 'a')),
                       "is too long: 600 characters, at most 511 are allowed"));
  test::setOptions("-contact__pad top");
  EXPECT_EQ(errorOf(rejectUnknownOptions),
            "option -contact__pad: the name in it is empty; it should be "
            "-contact_<interface>_pad");
}

// Characters that would turn or hide parts of a line are printed as escapes, letters as they are.
// An equation that begins with a sign and a letter would be the name of an option.
TEST(Words, EquationsThatBeginLikeNames) {
  const auto message = [](const std::vector<std::string>& words) {
    return errorOf([&] { settingsOfCall(words); });
  };
  EXPECT_EQ(message({"-equation_q", "-tip:z = -1e-3"}),
            "option -equation_q: its value '-tip:z = -1e-3' begins like the name of an option; "
            "begin it with a number: '-1*tip:z = -1e-3'");
  EXPECT_EQ(message({"-equation_q", "-1*tip:z = -1e-3"}), "");
}

TEST(Text, HiddenCharactersAreEscaped) {
  EXPECT_EQ(escaped("disc \u00e4\u05d0\u4e2d\U0001f600\n\t1"),
            "disc \u00e4\u05d0\u4e2d\U0001f600\n\t1");
  EXPECT_EQ(escaped("a\u202eb\u200bc\ufeffd\u2066e"), "a\\u202eb\\u200bc\\ufeffd\\u2066e");
  EXPECT_EQ(escaped("a\x1b[31m\x7f\u009b\r"), "a\\u001b[31m\\u007f\\u009b\\u000d");
  EXPECT_EQ(escaped("\U000e0041"), "\\udb40\\udc41");
  EXPECT_EQ(escaped("\xff\xe4\xc3"), "\\xff\\xe4\\xc3");
  const auto printed = test::warningsOf([] { printWarning(PETSC_COMM_WORLD, "group 'a\u202eb'"); });
  EXPECT_EQ(printed, "squeal: group 'a\\u202eb'\n");
}

TEST(Words, StrayOnesAreNamedWithTheOptionBeforeThem) {
  const auto message = [](const std::vector<std::string>& words) {
    return errorOf([&] { settingsOfCall(words); });
  };
  const auto list = message({"-flutter_friction", "0.2", "0.4"});
  EXPECT_TRUE(contains(list, "'0.4' follows option -flutter_friction 0.2") &&
              contains(list, "commas"))
      << list;
  const auto split = message({"-quiet", "-flutter_friction", "0,", "0.4"});
  EXPECT_TRUE(contains(split, "'0.4' follows option -flutter_friction 0,") &&
              contains(split, "quotes"))
      << split;
  const auto first = message({"disc_brake", "-quiet"});
  EXPECT_TRUE(contains(first, "'disc_brake' is not an option") &&
              contains(first, "-options_file disc_brake"))
      << first;
  EXPECT_TRUE(contains(message({"-a=1"}), "-a 1"));
  EXPECT_TRUE(contains(message({"-my disc_young", "1"}), "it contains a blank"));
  EXPECT_TRUE(contains(message({"-a", "1\n2"}), "line break"));
  EXPECT_TRUE(contains(message({"-a", "'\""}), "both kinds of quotes"));
  EXPECT_TRUE(contains(message({"-prefix_pop"}), "without -prefix_push"));
  EXPECT_TRUE(contains(message({"-options_file"}), "no file is named"));
  EXPECT_TRUE(contains(message({"-a_young", "1", "-A_young", "1"}), "capital letters"));
}

TEST(Files, LinesOfNamesAndValues) {
  const auto file = fileWith(
      "# comment\n-a 1  # one\n\n  -b \"0, 0.2\"\r\n-c\n-d '-x.msh'\n-e -1 -f 2\n-g 'a#b \"c\"'\n");
  EXPECT_EQ(pairs(settingsOfFile(file)), (Pairs{{"a", "1"},
                                                {"b", "0, 0.2"},
                                                {"c", ""},
                                                {"d", "-x.msh"},
                                                {"e", "-1"},
                                                {"f", "2"},
                                                {"g", "a#b \"c\""}}));
  EXPECT_EQ(settingsOfFile(file)[1].place(), file + ", line 4");
}

// Any value that optionLine() writes is read back unchanged.
TEST(Files, LinesRepeatTheirValues) {
  const Pairs values{{"a", ""},   {"b", "0, 0.2"},      {"c", "-x y"},
                     {"d", "-x"}, {"e", "it's # here"}, {"f", "a \"b\""},
                     {"g", "-1"}, {"k", "'x'"}};
  std::string text;
  for (const auto& [name, value] : values) text += optionLine(name, value);
  EXPECT_EQ(pairs(settingsOfFile(fileWith(text))), values);
}

TEST(Files, MistakesAreNamedWithTheirLine) {
  const std::vector<std::pair<std::string, std::string>> mistakes{
      {"-a 1\n-b 0 0.2\n", "line 2: '0.2' follows option -b 0"},
      {"-a 1\nb 2\n", "line 2: 'b' is not an option"},
      {"-a 1\n-b\n2\n", "line 3: '2' is not an option"},
      {"-a 1\n-b \"2\n", "line 2: a quote is not closed"},
      {"-a 1\n-b \"2\"3\n", "line 2: text follows"},
      {std::string("-a 1\n-b \0\n", 10), "line 2: a control character"},
      {"alias -a -b\n", "line 1: 'alias' is not an option"},
      {"-help\n", "line 1: option -help belongs on the command line"},
      {"-skip_petscrc\n", "belongs on the command line"},
      {"# nothing\n", "contains no option"}};
  for (const auto& [text, what] : mistakes) {
    const auto file = fileWith(text);
    const auto message = errorOf([&] { settingsOfFile(file); });
    EXPECT_TRUE(contains(message, file) && contains(message, what)) << text << ": " << message;
  }
  EXPECT_TRUE(contains(errorOf([] { settingsOfFile("nosuch.txt"); }),
                       "-options_file nosuch.txt: there is no such file"));
  EXPECT_TRUE(contains(errorOf([] { settingsOfFile("tests"); }), "this is a folder"));
  const auto large = fileWith("# " + std::string(11'000'000, 'x') + "\n-a 1\n");
  EXPECT_TRUE(contains(errorOf([&] { settingsOfFile(large); }), "10 MB"));
}

// PETSc's database would end the run with a traceback.
TEST(Files, ManyOptionsAreRefused) {
  std::string text;
  for (int i = 0; i < 600; ++i) text += formatted("-a_%d 1\n", i);
  const auto file = fileWith(text);
  EXPECT_TRUE(contains(errorOf([&] { settingsOfFile(file); }), "600 options"));
}

TEST(Files, KindIsToldByNameAndByContent) {
  const std::string text = "a: {b: 1}\n";
  const Pairs expected{{"a_b", "1"}};
  for (const std::string suffix : {".yaml", ".yml", ".json"})
    EXPECT_EQ(pairs(settingsOfFile(fileWith(text, suffix))), expected);
  EXPECT_EQ(pairs(settingsOfFile(fileWith("---\n" + text))), expected);
  EXPECT_EQ(pairs(settingsOfFile(fileWith("%YAML 1.1\n---\n" + text))), expected);
  EXPECT_EQ(pairs(settingsOfFile(fileWith(text) + ":yaml")), expected);
  EXPECT_EQ(pairs(settingsOfCall({"-options_file_yaml", fileWith(text)})), expected);
}

// The later setting wins, in the order of files and words. A file that includes another one finds
// it in its own folder.
TEST(Files, CountInTheOrderInWhichTheyStand) {
  const auto base = test::writeFile("base.yaml", "a: 1\nb: 1\nc: 1\n");
  const auto file = fileWith("-a 2\n-options_file base.yaml\n-b 3\n");
  const Pairs all{{"a", "2"}, {"a", "1"}, {"b", "1"}, {"c", "1"}, {"b", "3"}};
  EXPECT_EQ(pairs(settingsOfFile(file)), all);
  EXPECT_EQ(pairs(settingsOfFile(fileWith("options_file: base.yaml\nb: 3\n", ".yaml"))),
            (Pairs{{"a", "1"}, {"b", "1"}, {"c", "1"}, {"b", "3"}}));
  EXPECT_EQ(pairs(settingsOfCall({"-c", "0", "-options_file", base, "-a", "9"})),
            (Pairs{{"c", "0"}, {"a", "1"}, {"b", "1"}, {"c", "1"}, {"a", "9"}}));
  const auto loop = test::writeFile("loop.txt", "-options_file loop.txt\n");
  EXPECT_TRUE(contains(errorOf([&] { settingsOfFile(loop); }), "includes itself"));
}

TEST(Text, IsACommandLine) {
  EXPECT_EQ(pairs(settingsOfText("-a '0, 1'\n -b \"x\" -c")),
            (Pairs{{"a", "0, 1"}, {"b", "x"}, {"c", ""}}));
  EXPECT_EQ(pairs(settingsOfText("")), Pairs{});
  EXPECT_TRUE(contains(errorOf([] { settingsOfText("-a 1 2"); }), "'2' follows option -a 1"));
}

TEST(Environment, ComesBeforeTheCommandLine) {
  setenv("PETSC_OPTIONS", "-a 1 -b \"0, 1\"", 1);
  setenv("PETSC_OPTIONS_YAML", "{c: [1, 2]}", 1);
  EXPECT_EQ(pairs(settingsOfCall({"-a", "2"})),
            (Pairs{{"a", "1"}, {"b", "0, 1"}, {"c", "1,2"}, {"a", "2"}}));
  setenv("PETSC_OPTIONS", "-a 1 2", 1);
  EXPECT_TRUE(contains(errorOf([] { settingsOfCall({}); }), "'2' follows option -a 1"));
  unsetenv("PETSC_OPTIONS");
  unsetenv("PETSC_OPTIONS_YAML");
}

// The database returns values unchanged: with blanks, with a leading dash, longer than any buffer.
TEST(Database, KeepsValuesAsTheyAre) {
  const std::string lengthy(20000, 'x');
  clearOptions();
  insert({{"probe_a", "0, 0.2", "", 0},
          {"probe_b", "-x y -z", "", 0},
          {"probe_c", "", "", 0},
          {"probe_d", lengthy, "", 0}});
  EXPECT_EQ(
      givenOptions(),
      (std::map<std::string, std::string>{
          {"probe_a", "0, 0.2"}, {"probe_b", "-x y -z"}, {"probe_c", ""}, {"probe_d", lengthy}}));
  clearOptions();
}

TEST(Database, KnowsThePlaceOfAValue) {
  const auto file = test::writeFile("origin.yaml", "a:\n  b: 1\n");
  clearOptions();
  insertFile(PETSC_COMM_WORLD, file);
  EXPECT_EQ(givenOptions(), (std::map<std::string, std::string>{{"a_b", "1"}}));
  EXPECT_EQ(origin("a_b", "1").place(), file + ", line 2");
  EXPECT_EQ(origin("a_b", "2").place(), "");  // set to another value
  clearOptions();
}

// If the command line overrides a case, the program reports it; the same value twice is not a
// conflict.
TEST(Database, ReportsReplacedSettingsOfFiles) {
  const auto file =
      test::writeFile("replaced.yaml", "probe:\n  first: 1\n  second: 2\n  third: 3\n");
  clearOptions();
  insertFile(PETSC_COMM_WORLD, file);
  EXPECT_EQ(replacedSettings(), std::vector<std::string>{});
  insert({{"probe_first", "1", "", 0}, {"probe_second", "5", "", 0}, {"probe_other", "4", "", 0}});
  EXPECT_EQ(replacedSettings(),
            std::vector<std::string>{"option -probe_second 5 replaces 2 (" + file + ", line 3)"});
  clearOptions();
}

}  // namespace
}  // namespace squeal
