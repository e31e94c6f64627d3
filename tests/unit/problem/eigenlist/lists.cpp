// SPDX-License-Identifier: BSD-2-Clause
// Lists of eigenvalues: the same two eigenvalues in the layout of each program, and lists that are
// refused by name.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "base/system/error.hpp"
#include "problem/eigenlist/list.hpp"

namespace {

using namespace squeal;
using eigenlist::Format, eigenlist::Unit;

constexpr double turn = 2 * std::numbers::pi;

// s = 12.5 ± 6283.1853 i (1000 Hz, growing) and −3 ± 12566.3706 i (2000 Hz).
const std::string abaqus = R"(
          E I G E N V A L U E    O U T P U T
 MODE NO      EIGENVALUE              FREQUENCY         GENERALIZED MASS   COMPOSITE MODAL DAMPING
                             (RAD/TIME)   (CYCLES/TIME)
       1      3.94784E+07        6283.2        1000.0        1.0000         0.0000

          C O M P L E X   E I G E N V A L U E   O U T P U T
 MODE NO      REAL PART OF EIGENVALUE      FREQUENCY           DAMPING RATIO
                                    (RAD/TIME)   (CYCLES/TIME)
       1       12.500             6283.2        1000.0       -3.97887E-03
       2      -3.0000             12566.        2000.0        4.77465E-04

     THE ANALYSIS HAS BEEN COMPLETED
       1  2  3  4  5
)";
const std::string calculix = R"(
     E I G E N V A L U E   O U T P U T
 MODE NO    EIGENVALUE                       FREQUENCY
                                     REAL PART            IMAGINARY PART
                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)
     1   0.3947842E+08   0.6283185E+04   0.1000000E+04   0.0000000E+00

    E I G E N V A L U E   O U T P U T

MODE NO                     FREQUENCY
                     REAL PART         IMAGINARY PART
            (RAD/TIME)   (CYCLES/TIME)   (RAD/TIME)

      1   0.6283185E+04   0.1000000E+04  -0.1250000E+02
      2   0.1256637E+05   0.2000000E+04   0.3000000E+01
)";
const std::string nastran = R"(
                         C O M P L E X   E I G E N V A L U E   S U M M A R Y
0   ROOT     EXTRACTION          EIGENVALUE             FREQUENCY      DAMPING
   NO.        ORDER        (REAL)           (IMAG)           (CYCLES)         COEFFICIENT
   1           2         1.250000E+01   -6.283185E+03         1.000000E+03       -3.978874E-03
   2           1         1.250000E+01    6.283185E+03         1.000000E+03       -3.978874E-03
1    BRAKE                                       OCTOBER  12, 2020  MSC NASTRAN   PAGE    12
                         C O M P L E X   E I G E N V A L U E   S U M M A R Y
0   ROOT     EXTRACTION          EIGENVALUE             FREQUENCY      DAMPING
   NO.        ORDER        (REAL)           (IMAG)           (CYCLES)         COEFFICIENT
   3           3        -3.000000E+00    1.256637E+04         2.000000E+03        4.774648E-04
)";
const std::string ansys = R"(
  MODE       COMPLEX FREQUENCY (HERTZ)              MODAL DAMPING RATIO
     1    1.9894368       1000.0000     j       -0.19894329E-02
          1.9894368      -1000.0000     j       -0.19894329E-02
     2  -0.47746483       2000.0000     j        0.23873241E-03
        -0.47746483      -2000.0000     j        0.23873241E-03
)";

const std::vector<Complex> expected{{12.5, turn * 1000}, {-3, turn * 2000}};

void expectList(const std::string& text, Format format, std::optional<Unit> unit, double accuracy,
                long conjugates) {
  const auto list = eigenlist::parse(text, format, unit);
  ASSERT_EQ(list.values.size(), expected.size()) << text;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT(std::abs(list.values[i] - expected[i]), accuracy * std::abs(expected[i])) << text;
  EXPECT_EQ(list.conjugates + list.mirrored, conjugates) << text;
}

// Within the digits that each list prints: five, seven, and all.
TEST(Lists, OfEachProgram) {
  expectList(abaqus, Format::automatic, {}, 5e-5, 0);
  expectList(abaqus, Format::abaqus, {}, 5e-5, 0);
  expectList(nastran, Format::automatic, {}, 5e-7, 1);
  expectList(ansys, Format::automatic, {}, 5e-7, 2);
  const std::string complexTable = calculix.substr(calculix.find("    E I G", 20));
  expectList(complexTable, Format::automatic, {}, 5e-7, 0);
}

TEST(Lists, OfColumns) {
  const std::string rows = "12.5 6283.185307179586\n-3, 12566.370614359172\n";
  const std::string hertz = "1.98943678864869e0 1000\n-4.7746482927568601D-1;2000\n";
  expectList(rows, Format::automatic, Unit::radians, 1e-12, 0);
  expectList("real_rad_per_s,imaginary_rad_per_s\n" + rows, Format::automatic, {}, 1e-12, 0);
  expectList("# s in 1/s\n\n" + rows + "12.5 -6283.185307179586\n", Format::columns, {}, 1e-12, 1);
  expectList(hertz, Format::columns, Unit::hertz, 1e-12, 0);
  expectList("% Hz\r\n" + hertz, Format::automatic, {}, 1e-12, 0);
  expectList(
      "friction,speed,mode,growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,name\n"
      "0.6,1,1,12.5,6283.185307179586,1000,\n0.6,1,2,-3,12566.370614359172,2000,\"disc (0,2)\"\n",
      Format::automatic, {}, 1e-12, 0);
  // An empty cell moves none of the others.
  expectList(
      "name,growth_rate_1_per_s,angular_frequency_rad_per_s\n"
      ",12.5,6283.185307179586\n\"disc; (0 2)\",-3,12566.370614359172\n",
      Format::automatic, {}, 1e-12, 0);
  expectList("imaginary_hz;real_hz\n1000;1.98943678864869\n2000;-0.47746482927568601\n",
             Format::automatic, {}, 1e-12, 0);
  expectList("imaginary,real\nHz,Hz\n1000,1.98943678864869\n2000,-0.47746482927568601\n",
             Format::automatic, {}, 1e-12, 0);
  // A tab delimits cells, too.
  expectList(
      "growth_rate_1_per_s\tradius\tangular_frequency_rad_per_s\tname\n"
      "12.5\t\t6283.185307179586\tdisc (0,2)\n-3\t1e-3\t12566.370614359172\t\n",
      Format::automatic, {}, 1e-12, 0);
  // Both names of the first header say "frequency"; comments may name other figures.
  for (const std::string header :
       {"frequency_real_hz,frequency_imag_hz", "Re/Hz;Im/Hz",
        "# complex frequency: real, imaginary, Hz",
        "# 53151 degrees of freedom, disc at 10 rpm\n# cycles per second"})
    expectList(header + "\n" + hertz + "# cut off at 9000 rad/s\n", Format::automatic, {}, 1e-12,
               0);
  expectList("real rad/second; imag radians per sec.\n" + rows, Format::automatic, {}, 1e-12, 0);
  // Conjugates only: both halves have the same eigenvalues.
  expectList("12.5 -6283.185307179586\n-3 -12566.370614359172", Format::columns, Unit::radians,
             1e-12, 2);
}

// The numbers count all eigenvalues of the file, whether they are kept, dropped or mirrored.
TEST(Lists, NumbersAreThoseOfTheFile) {
  const auto list =
      eigenlist::parse("1 -10\n2 20\n2 -20\n0 30\n3 40\n3 -40\n", Format::columns, Unit::radians);
  EXPECT_EQ(list.values, (std::vector<Complex>{{1, 10}, {2, 20}, {0, 30}, {3, 40}}));
  EXPECT_EQ(list.numbers, (std::vector<long>{1, 2, 4, 5}));
  EXPECT_EQ(list.conjugates, 2);
  EXPECT_EQ(list.mirrored, 1);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The heading of a page, or a note, between two rows does not end the table; other rows of numbers
// do. A number without a row is counted.
TEST(Lists, TextBetweenRows) {
  const std::string second = "       2      -3.0000             12566.        2000.0        4.7";
  for (const std::string between :
       {"a note\n", "\n\n1   Abaqus 2022   Date 30-Nov   Page 12\n  MODE NO   REAL PART\n",
        "       1\n  second run\n"})
    expectList(replaced(abaqus, second, between + second), Format::abaqus, {}, 5e-5, 0);
  const std::string nodes = "\n NODE  U1  U2  U3\n  7  1E-3 2E-3 0.0\n  3  1E-3 2E-3 0.0\n";
  expectList(replaced(abaqus, "     THE ANALYSIS", nodes + "     THE ANALYSIS"), Format::abaqus, {},
             5e-5, 0);
  // Without the column in rad/s, figures of other tables must not pass as a third mode.
  const std::string four =
      replaced(replaced(abaqus, "6283.2        1000.0       -3", "1000.0       -3"),
               "12566.        2000.0", "2000.0");
  for (const std::string other :
       {"\n NODE  U1  U2  U3\n  3  1E-3 2E-3 0.0\n  4  1E-3 2E-3 0.0\n", "\n NODE\n  3 0 0 0\n",
        "\n EIGENVALUE OUTPUT\n 1 1. 2. 3. 4. 5.\n 2 1. 2. 3. 4. 5.\n 3 1. 2. 3. 4. 5.\n"})
    expectList(replaced(four, "     THE ANALYSIS", other + "     THE ANALYSIS"), Format::abaqus, {},
               5e-5, 0);
  EXPECT_EQ(eigenlist::parse(replaced(four, "       2      -3.0", "  page\n       4      -3.0"),
                             Format::abaqus, {})
                .skipped,
            2);
  const auto list = eigenlist::parse(replaced(abaqus, "       2      -3.0", "       9      -3.0"),
                                     Format::abaqus, {});
  EXPECT_EQ(list.values.size(), 2u);
  EXPECT_EQ(list.skipped, 7);
}

std::string refusal(const std::string& text, Format format, std::optional<Unit> unit) {
  try {
    eigenlist::parse(text, format, unit);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Lists, RefusedByName) {
  const auto expect = [](const std::string& text, Format format, std::optional<Unit> unit,
                         const std::string& reason) {
    const auto why = refusal(text, format, unit);
    EXPECT_NE(why.find(reason), std::string::npos) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  };
  expect("", Format::automatic, {}, "the file is empty");
  expect("# rad/s\n", Format::automatic, {}, "no eigenvalue was found");
  expect("1 2\n", Format::automatic, {}, "give -referee_unit rad or Hz");
  expect("1/s,Hz\n1 2\n", Format::automatic, {}, "both Hz and rad/s");
  expect("Hz Hz\n1 2\n", Format::automatic, Unit::radians, "another unit than -referee_unit");
  expect("1 nan\n", Format::columns, Unit::radians, "line 1: 'nan' is not a finite number");
  expect("1 2\nend of list\n", Format::columns, Unit::radians, "line 2: 'end'");
  expect("1 1e999\n", Format::columns, Unit::radians, "not a finite number");
  expect("1 2 3\n", Format::columns, Unit::radians, "3 words instead of 2");
  expect("friction,growth_rate_1_per_s,angular_frequency_rad_per_s\n0,1,2\n0.1,1,2\n",
         Format::automatic, {}, "several points");
  expect(abaqus, Format::abaqus, Unit::hertz, "leave -referee_unit out");
  expect(abaqus, Format::nastran, {}, "no eigenvalue was found (Nastran");
  expect(nastran + nastran, Format::automatic, {}, "several tables");
  expect(replaced(abaqus, "12.500", "*****"), Format::abaqus, {}, "'*****' is not a finite");
  expect(replaced(abaqus, "12566.", "12466."), Format::abaqus, {}, "do not agree");
  expect(replaced(abaqus, "-3.97887E-03", "3.97887E-03"), Format::abaqus, {}, "the signs of");
  // Rows that are cut, or whose figures have run together.
  expect(replaced(abaqus, "12566.        2000.0        4.77465E-04", ""), Format::abaqus, {},
         "line 11: this is not a whole row of mode 2: 2 words");
  expect(replaced(abaqus, "2000.0        4.77465E-04", "2000.0"), Format::abaqus, {},
         "line 11: 4 words instead of 5 as in the rows above");
  expect(replaced(nastran, "-3.000000E+00    1.2", "-3.000000E+00+1.2"), Format::nastran, {},
         "this is not a whole row of mode 3: 5 words");
  expect(replaced(abaqus, "6283.2        1000.0       -3.97887E-03", ""), Format::abaqus, {},
         "line 10: this is not a whole row of mode 1: 2 words");
  expect("growth_rate_1_per_second,frequency_hz\n1,2\n", Format::columns, {}, "both Hz and rad/s");
  for (const std::string unit : {"kHz", "MHz", "deg/s", "rpm", "rad/ms", "1/min"})
    expect("real [" + unit + "]; imag [" + unit + "]\n1;2\n", Format::columns, {},
           "the header names the unit ");
  // Units are whole words.
  expect("rad/s\n1 2\n# Hz from here\n3 4\n", Format::columns, {},
         "line 3: this comment between rows names another unit");
  expect("results of Conrad\n1 2\n", Format::columns, {}, "give -referee_unit rad or Hz");
  expect("imag rad/s, real rad/s, of the brake\n1 2\n", Format::columns, {},
         "names the imaginary part first");
  expect("name,growth_rate_1_per_s,angular_frequency_rad_per_s\n1,2\n", Format::columns, {},
         "line 2: 2 cells instead of 3");
}

}  // namespace
