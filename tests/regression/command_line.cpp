// The program as it is called: options files, words of the command line, and what is said of mistakes in them.
#include "support/bad_input.hpp"

namespace squeal::test {
namespace {

// PETSc's reader ends with a traceback, or skips what it does not understand.
TEST(CommandLine, OptionsFilesThatCannotBeRead) {
  const fs::path place = placeFor("command_line/files");
  const auto file = [&](const std::string& name, const std::string& text) {
    writeText(place / name, text);
    return with({}, {{"options_file", (place / name).string()}});
  };
  expectExplained({
      {"yaml_tab", file("tab.yaml", "mesh:\n\tfile: x\n"), {"tab.yaml, line 2", "tab"}},
      {"yaml_quote", file("quote.yaml", "mesh:\n  file: \"x\nquiet:\n"), {"quote.yaml, line", "begins in line 2", "quote"}},
      {"yaml_list", file("list.yaml", "- mesh\n"), {"list.yaml, line 1", "a list at the top"}},
      {"yaml_binary", file("binary.yaml", std::string("mesh: \0\1\2", 9)), {"binary.yaml, line 1", "text in UTF-8"}},
      {"yaml_duplicate", file("twice.yaml", "mesh:\n  file: x\nmesh_file: y\n"), {"twice.yaml, line 3", "-mesh_file", "line 2"}},
      {"yaml_empty", file("empty.yaml", "# nothing\n"), {"-options_file", "empty.yaml", "no option"}},
      {"yaml_rule",
       with(without(layer, {"material_layer_density"}), file("rule.yaml", "material:\n  layer:\n    density: -1\n")),
       {"-material_layer_density -1", "rule.yaml, line 3", "must be a number > 0"}},
      {"lines_stray",
       file("stray.txt", "-quiet\n-flutter_friction 0 0.2\n"),
       {"stray.txt, line 2", "'0.2'", "-flutter_friction 0"}},
      {"lines_many",
       file("many.txt",
            [] {
              std::string text;
              for (int i = 0; i < 600; ++i) text += "-material_" + std::to_string(i) + "_young 1\n";
              return text;
            }()),
       {"601 options"}},
      {"folder", with({}, {{"options_file", place.string()}}), {"-options_file " + place.string(), "folder"}},
  });
}

TEST(CommandLine, StrayWords) {
  expectExplained({
      {"list_as_words", with(layer, {{"flutter_friction", "0.2' '0.4"}}), {"'0.4'", "-flutter_friction 0.2", "commas"}},
      {"list_split", with(layer, {{"flutter_friction", "0,' '0.4"}}), {"'0.4'", "-flutter_friction 0,", "quotes"}},
      {"flag_with_word", with(without(layer, {"quiet"}), {{"quiet", "disc_brake"}}), {"-quiet disc_brake", "on or off"}},
      {"equals", with(without(layer, {"modes_count"}), {{"modes_count=5", ""}}), {"-modes_count=5", "-modes_count 5"}},
      {"capitals", with(layer, {{"material_Layer_young", "2"}}), {"-material_Layer_young", "-material_layer_young", "capital"}},
  });
}

}  // namespace
}  // namespace squeal::test
