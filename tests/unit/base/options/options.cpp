// SPDX-License-Identifier: BSD-2-Clause
// The options database as the user interface: parsing, checks, names with a placeholder, and the
// messages for mistakes.
#include "base/options/options.hpp"
#include "base/options/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/system/text.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::contains;
using test::errorOf;

// Options of these tests, in addition to those of the method.
const RealOption length("general", "probe_<part>_length", std::nullopt, "m", positive,
                        "length of a part");
const RealOption ratio("general", "probe_ratio", 0.25, "", {-1, 0.5, true, true}, "a ratio");
const RealOption offset("general", "probe_<part>_offset", 0.0, "m", anyReal, "offset of a part");
const IntegerOption count("general", "probe_count", 7, 2, 1'000'000, "a number of things");
const RealListOption sweep("general", "probe_sweep", "0.4", "", sequencesOf(nonNegative),
                           "a sweep");
const RealListOption vector("general", "probe_vector", "0,0,1", "m", anyReal, "a vector");
const FlagOption flag("general", "probe_flag", false, "a flag");
const ChoiceOption choice("general", "probe_choice", {"fast", "exact"}, "exact", "a choice");
const TextOption text("general", "probe_text", std::nullopt, "a text");
const TextOption list("general", "probe_list", "", "a list");
const FileOption file("general", "probe_<part>_file", "a file");
const SolverPrefix solver("general", "probe_solver_", "a solver");

/// The value of the sweep given as `value`.
std::vector<double> swept(const std::string& value) {
  test::setOptions("-probe_sweep " + value);
  return sweep.get();
}

TEST(Lists, RangesEndExactly) {
  const auto values = swept("0:0.6:0.05");
  ASSERT_EQ(values.size(), 13u);
  const double expected[] = {0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6};
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i], expected[i]);  // the doubles that a user would type: 12 × 0.05 is not 0.6
  EXPECT_EQ(swept("0.1:0.7:0.1"), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}));
  EXPECT_EQ(swept("0.3:0.3:1"), (std::vector<double>{0.3}));
  EXPECT_EQ(swept("0:1:0.4"), (std::vector<double>{0, 0.4, 0.8}));  // never beyond the last
  EXPECT_EQ(swept("1e3:3e3:1e3"), (std::vector<double>{1000, 2000, 3000}));
}

TEST(Lists, ValuesAreReadToTheLastDigit) {
  EXPECT_EQ(swept("0.2,0,+.5,1e-3"),
            (std::vector<double>{0.2, 0, 0.5, 0.001}));  // in the order given
  test::setOptions("-probe_vector 0,-0.01,0.1234567890123456");
  EXPECT_EQ(vector.get(), (std::vector<double>{0, -0.01, 0.1234567890123456}));
  test::setOptions("-probe_vector -1,2,3");  // begins like a name
  EXPECT_EQ(vector.get(), (std::vector<double>{-1, 2, 3}));
  test::setOptions("");
  EXPECT_EQ(vector.get(), (std::vector<double>{0, 0, 1}));
}

// Long lists are rejected before their memory is allocated.
TEST(Lists, OfTooManyValuesAreRefused) {
  EXPECT_TRUE(
      contains(errorOf([] { swept("0:1:1e-7"); }),
               "-probe_sweep 0:1:1e-7: 10000001 values; a list may contain at most 100000"));
  EXPECT_TRUE(contains(errorOf([] { swept("0:1e9:1e-9"); }), "a list may contain at most 100000"));
  EXPECT_EQ(swept("1:100000:1").size(), 100000U);
}

// Squares of 1e50, and products of several such numbers, do not overflow.
TEST(Numbers, MagnitudesAreLimited) {
  for (const std::string value : {"1e51", "-1e51", "1e300", "1e-51", "-1e-300"}) {
    test::setOptions("-probe_a_offset " + value);
    const auto message = errorOf([] { offset.get("a"); });
    EXPECT_TRUE(contains(message, "-probe_a_offset " + value) &&
                contains(message, "magnitude between 1e-50 and 1e+50"))
        << message;
    test::setOptions("-probe_vector 0,0," + value);
    EXPECT_TRUE(contains(errorOf([] { vector.get(); }), "magnitude between")) << value;
  }
  test::setOptions("-probe_a_offset -1e50 -probe_b_offset 1e-50 -probe_c_offset 0");
  EXPECT_EQ(offset.get("a"), -1e50);
  EXPECT_EQ(offset.get("b"), 1e-50);
  EXPECT_EQ(offset.get("c"), 0);
}

TEST(Lists, MayHoldBlanks) {
  EXPECT_EQ(swept("'0, 0.2 ,\t0.4'"), (std::vector<double>{0, 0.2, 0.4}));
  EXPECT_EQ(swept("' 0 : 0.2 : 0.1 '"), (std::vector<double>{0, 0.1, 0.2}));
  test::setOptions(
      "-probe_vector ' 0, -0.01 , 1e3' -probe_list 'a, b_c ,d' -probe_count ' 3 ' -probe_flag 'off "
      "'");
  EXPECT_EQ(vector.get(), (std::vector<double>{0, -0.01, 1000}));
  EXPECT_EQ(list.list(), (std::vector<std::string>{"a", "b_c", "d"}));
  EXPECT_EQ(count.get(), 3);
  EXPECT_FALSE(flag.get());
  const auto file = test::writeFile("lists.yaml",
                                    "probe:\n  vector: [0, -0.01, 1e3]\n  list:\n    - a\n    - "
                                    "b_c\n    - d\n  sweep: [0, 0.2]\n");
  clearOptions();
  insertFile(PETSC_COMM_WORLD, file);
  EXPECT_EQ(vector.get(), (std::vector<double>{0, -0.01, 1000}));
  EXPECT_EQ(list.list(), (std::vector<std::string>{"a", "b_c", "d"}));
  EXPECT_EQ(sweep.get(), (std::vector<double>{0, 0.2}));
}

TEST(Lists, EmptyItemsAreRefused) {
  for (const std::string value : {"a,,b", "a,", ",a", "'a, ,b'"}) {
    test::setOptions("-probe_list " + value);
    EXPECT_TRUE(contains(errorOf([] { list.list(); }), "an item of the list is empty")) << value;
  }
  test::setOptions("-probe_list");
  EXPECT_TRUE(contains(errorOf([] { list.list(); }), "-probe_list without a value"));
}

// Next to the options file that names it, then in the working folder; on the command line in the
// working folder.
TEST(Files, AreLookedForBesideTheOptionsFile) {
  const std::string folder = SQUEAL_OUTPUT_DIR "/beside here";
  std::filesystem::create_directories(folder);
  test::writeFile("beside here/probe.msh", "");
  const auto named = [&](const std::string& path) {
    static int number = 0;
    const auto options = test::writeFile(formatted("beside here/options_%d.yaml", number++),
                                         "probe:\n  disc:\n    file: " + path + "\n");
    clearOptions();
    insertFile(PETSC_COMM_WORLD, options);
  };
  named("probe.msh");
  EXPECT_TRUE(std::filesystem::equivalent(file.get("disc"), folder + "/probe.msh"))
      << file.get("disc");
  EXPECT_EQ(errorOf([] { rejectUnknownOptions(); }), "");
  EXPECT_EQ(givenOptions().at("probe_disc_file"),
            file.get("disc"));  // as in the record of the run
  named("../beside here/probe.msh");
  EXPECT_TRUE(std::filesystem::equivalent(file.get("disc"), folder + "/probe.msh"));
  named("meshes/layer.geo");  // the tests run in the root of the repository
  EXPECT_EQ(file.get("disc"), "meshes/layer.geo");
  named("nosuch.msh");
  const auto missing = errorOf([] { rejectUnknownOptions(); });
  EXPECT_TRUE(contains(missing, "-probe_disc_file nosuch.msh") && contains(missing, "line 3") &&
              contains(missing, "no such file") && contains(missing, "neither next to"))
      << missing;
  test::setOptions("-probe_disc_file probe.msh");
  const auto working = errorOf([] { rejectUnknownOptions(); });
  EXPECT_TRUE(contains(working, "-probe_disc_file probe.msh: there is no such file") &&
              !contains(working, "next to"))
      << working;
  test::setOptions("-probe_disc_file meshes");
  EXPECT_TRUE(contains(errorOf([] { rejectUnknownOptions(); }), "this is a folder"));
}

TEST(Lists, BadOnesAreRejectedByName) {
  for (const std::string value :
       {"0,,1", "0,1,", "a", "0.1:0.2", "0:1:0", "0:1:-0.1", "1:0:0.1", "0:1:0.1:2", "0:x:1", "nan",
        "inf", "0;1", "1e999", "0.1.2", "-0.1", "0.4,-0.1"}) {
    const auto message = errorOf([&] { swept(value); });
    EXPECT_TRUE(contains(message, "-probe_sweep")) << value;
    EXPECT_TRUE(contains(message, "first:last:step")) << value << ": " << message;
  }
  // A range, which the option does not declare.
  test::setOptions("-probe_vector 0:1:0.5");
  EXPECT_TRUE(contains(errorOf([] { vector.get(); }), "-probe_vector"));
}

TEST(Numbers, RangesAreOpenOrClosedAsDeclared) {
  const auto ratioOf = [](const std::string& value) {
    test::setOptions("-probe_ratio " + value);
    return ratio.get();
  };
  EXPECT_EQ(ratioOf("0.499999"), 0.499999);
  EXPECT_EQ(ratioOf("-0.999"), -0.999);
  for (const std::string value : {"0.5", "-1", "7", "-1e300", "none", "0.2m", "0,3"}) {
    const auto message = errorOf([&] { ratioOf(value); });
    EXPECT_TRUE(contains(message, "-probe_ratio") && contains(message, "> -1") &&
                contains(message, "< 0.5"))
        << value << ": " << message;
  }
  test::setOptions("-probe_a_length 0");
  EXPECT_TRUE(contains(errorOf([] { length.get("a"); }), "-probe_a_length"));
  EXPECT_TRUE(nonNegative.contains(0) && !nonNegative.contains(-1e-300) && !positive.contains(0) &&
              positive.contains(1e-300));
  EXPECT_FALSE(nonNegative.contains(std::nan("")));
  EXPECT_EQ(nonNegative.text(), "a number >= 0");
}

TEST(Numbers, IntegersAreWholeAndLargeEnough) {
  const auto countOf = [](const std::string& value) {
    test::setOptions("-probe_count " + value);
    return count.get();
  };
  EXPECT_EQ(countOf("2"), 2);
  for (const std::string value :
       {"1", "-3", "2.0", "3e2", "two", "1000001", "2000000000", "99999999999"})
    EXPECT_TRUE(contains(errorOf([&] { countOf(value); }), "-probe_count " + value)) << value;
  test::setOptions("");
  EXPECT_EQ(count.get(), 7);
}

TEST(Words, FlagsAndChoices) {
  for (const auto& [value, expected] : {std::pair{"", true},
                                        {"on", true},
                                        {"true", true},
                                        {"1", true},
                                        {"off", false},
                                        {"no", false},
                                        {"0", false}}) {
    test::setOptions(std::string("-probe_flag ") + value);
    EXPECT_EQ(flag.get(), expected) << value;
  }
  test::setOptions("-probe_flag perhaps");
  EXPECT_TRUE(contains(errorOf([] { flag.get(); }), "-probe_flag perhaps"));
  test::setOptions("-probe_choice fast");
  EXPECT_EQ(choice.get(), "fast");
  test::setOptions("-probe_choice faster");
  const auto message = errorOf([] { choice.get(); });
  EXPECT_TRUE(contains(message, "-probe_choice faster") && contains(message, "fast or exact"))
      << message;
  test::setOptions("-probe_list a,b_c,d");
  EXPECT_EQ(list.list(), (std::vector<std::string>{"a", "b_c", "d"}));
  test::setOptions("");
  EXPECT_TRUE(list.list().empty());
}

TEST(Required, MissingOnesAreNamedWithTheirMeaning) {
  test::setOptions("-probe_pad_offset 1");
  const auto message = errorOf([] { length.get("pad"); });
  EXPECT_TRUE(contains(message, "-probe_pad_length is missing") &&
              contains(message, "length of a part"))
      << message;
  EXPECT_TRUE(contains(errorOf([] { text.get(); }), "-probe_text is missing"));
  EXPECT_FALSE(length.given("pad"));
  EXPECT_TRUE(offset.given("pad"));
}

// Group names may contain underscores, and even words of option names.
TEST(Subjects, AreTheWordsInPlaceOfThePlaceholder) {
  test::setOptions(
      "-probe_back_plate_length 1 -probe_disc_length 2 -probe_the_length_of_it_length 3 "
      "-probe_offset_length 4 -probe_x_offset -5");
  EXPECT_EQ(length.subjects(),
            (std::vector<std::string>{"back_plate", "disc", "offset", "the_length_of_it"}));
  EXPECT_EQ(offset.subjects(), (std::vector<std::string>{"x"}));
  EXPECT_EQ(length.get("the_length_of_it"), 3);
  EXPECT_EQ(offset.get("x"), -5);
  EXPECT_TRUE(length.matches("probe_a_length") && !length.matches("probe_length") &&
              !length.matches("probe__length") && !length.matches("probe_a_lengths") &&
              !length.matches("sprobe_a_length"));
  EXPECT_EQ(length.fullName("back_plate"), "probe_back_plate_length");
}

// A case file nests names; the command line overrides single values.
TEST(CaseFile, NestsAndIsOverridden) {
  const auto file = test::writeFile("options.yaml", R"(
# a comment
probe:
  back_plate:
    length: 2.5   # m
    offset: -1e-3
  disc:
    length: 7
  vector: "0,-0.01,0"
  sweep: "0:0.2:0.1"
  flag: true
)");
  clearOptions();
  insertFile(PETSC_COMM_WORLD, file);
  insert(settingsOfText("-probe_disc_length 8"));
  EXPECT_EQ(length.subjects(), (std::vector<std::string>{"back_plate", "disc"}));
  EXPECT_EQ(length.get("back_plate"), 2.5);
  EXPECT_EQ(length.get("disc"), 8);
  EXPECT_EQ(offset.get("back_plate"), -1e-3);
  EXPECT_EQ(vector.get(), (std::vector<double>{0, -0.01, 0}));
  EXPECT_EQ(sweep.get(), (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_TRUE(flag.get());
  EXPECT_EQ(errorOf([] { rejectUnknownOptions(); }), "");
  EXPECT_EQ(resolvedOptions().at("probe_disc_length"), "8");  // as in the record of the run
}

// PETSc itself accepts a name without its number in place of one with it.
TEST(Subjects, WithNumbersAreNotTakenForOthers) {
  test::setOptions("-probe_length 2 -probe_offset 3");
  EXPECT_FALSE(length.given("1"));
  EXPECT_EQ(offset.get("1"), 0);
  EXPECT_TRUE(contains(errorOf([] { length.get("1"); }), "-probe_1_length is missing"));
  test::setOptions("-probe_1_offset 4");
  EXPECT_EQ(offset.get("1"), 4);
}

// A buffer of fixed length would truncate the list, and thus the sweep.
TEST(Lists, MayBeLong) {
  std::string value = "0";
  for (int i = 1; i < 3000; ++i) value += "," + std::to_string(i);
  EXPECT_EQ(swept(value).size(), 3000U);
}

TEST(Unknown, TypingErrorsStopTheRunWithTheNearestName) {
  test::setOptions("-mesh_fiel brake.msh");
  const auto message = errorOf([] { rejectUnknownOptions(); });
  EXPECT_TRUE(contains(message, "unknown option -mesh_fiel") && contains(message, "-mesh_file"))
      << message;
  test::setOptions("-probe_cuont 3");
  EXPECT_TRUE(contains(errorOf([] { rejectUnknownOptions(); }), "did you mean -probe_count?"));
  test::setOptions("-weather fine");
  const auto far = errorOf([] { rejectUnknownOptions(); });
  EXPECT_TRUE(contains(far, "-weather") && !contains(far, "did you mean")) << far;
  test::setOptions(
      "-probe_disc_length 3 -probe_solver_type lu -probe_count 9");  // declared, though nobody has
                                                                     // asked for them yet
  EXPECT_EQ(errorOf([] { rejectUnknownOptions(); }), "");
}

TEST(Unknown, SolversRejectWhatTheyDidNotRead) {
  test::setOptions("-probe_solver_tpye lu -probe_solver_later_level 2");
  EXPECT_TRUE(contains(errorOf([] { solver.rejectUnused(); }), "-probe_solver_"));
  EXPECT_TRUE(contains(errorOf([] { solver.rejectUnused({"later_"}); }), "-probe_solver_tpye"));
  PetscBool used = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, "-probe_solver_tpye", &used));
  EXPECT_TRUE(contains(errorOf([] { solver.rejectUnused(); }), "-probe_solver_later_level"));
  EXPECT_EQ(errorOf([] { solver.rejectUnused({"later_"}); }), "");
}

TEST(Manual, ListsEveryOptionWithUnitDefaultAndRule) {
  const auto page = manual();
  for (const auto* option : Option::all()) {
    EXPECT_TRUE(contains(page, "-" + option->name)) << option->name;
    EXPECT_FALSE(option->meaning.empty()) << option->name;
  }
  for (const auto* prefix : SolverPrefix::all())
    EXPECT_TRUE(contains(page, "-" + prefix->prefix + "*"));
  EXPECT_TRUE(contains(page, "-probe_<part>_length [m]"));
  const auto line = page.substr(page.find("-probe_ratio"));
  EXPECT_TRUE(contains(line.substr(0, line.find('\n')), "(default 0.25; a number > -1 and < 0.5)"))
      << line.substr(0, line.find('\n'));
}

}  // namespace
}  // namespace squeal
