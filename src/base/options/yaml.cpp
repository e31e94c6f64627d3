// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/yaml.hpp"

#include <yaml.h>

#include <algorithm>
#include <map>
#include <new>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

constexpr int deepest = 64;  // an alias may contain itself
constexpr std::size_t mostSettings =
    10000;  // aliases of aliases multiply; PETSc's database stores far fewer

struct Parser {
  explicit Parser(const std::string& text) {
    if (!yaml_parser_initialize(&parser)) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
  }
  ~Parser() { yaml_parser_delete(&parser); }
  Parser(const Parser&) = delete;
  yaml_parser_t parser{};
};

struct Document {
  Document() = default;
  ~Document() { yaml_document_delete(&document); }
  Document(const Document&) = delete;
  yaml_document_t document{};
};

int lineOf(const yaml_mark_t& mark) { return mark.line + 1; }

/// Returns the first line up to `last` that is indented by a tab, from 1; 0 if none is.
int tabbedLine(const std::string& text, int last) {
  std::size_t begin = 0;
  for (int line = 1; line <= last && begin < text.size(); ++line) {
    const auto word = text.find_first_not_of(' ', begin);
    if (word != std::string::npos && text[word] == '\t') return line;
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return 0;
}

[[noreturn]] void fail(const std::string& name, int line, const std::string& message) {
  throw Error(formatted("%s, line %d: %s", name.c_str(), line, message.c_str()));
}

/// Throws Error with the parser's message and the likely cause.
[[noreturn]] void failParsing(const yaml_parser_t& parser, const std::string& text,
                              const std::string& name) {
  if (parser.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
  const std::string problem = parser.problem ? parser.problem : "not YAML";
  if (parser.error == YAML_READER_ERROR) {
    const auto bytes = std::min(parser.problem_offset, text.size());
    fail(name, 1 + std::count(text.begin(), text.begin() + bytes, '\n'),
         problem + "; an options file is text in UTF-8");
  }
  const int line = lineOf(parser.problem_mark);
  if (const int tab = tabbedLine(text, line))
    fail(name, tab, "indented by a tab; YAML is indented only by blanks");
  std::string context;
  if (parser.context)
    context = formatted("%s that begins in line %d, ", parser.context, lineOf(parser.context_mark));
  const char* hint = parser.error == YAML_COMPOSER_ERROR
                         ? ""
                         : "; is a line indented wrongly, a quote or a bracket left open?";
  fail(name, line, context + problem + hint);
}

bool load(Parser& parser, Document& document, const std::string& text, const std::string& name) {
  if (!yaml_parser_load(&parser.parser, &document.document)) failParsing(parser.parser, text, name);
  return yaml_document_get_root_node(&document.document) != nullptr;
}

class Flattening {
 public:
  Flattening(yaml_document_t& document, const std::string& name)
      : document_(document), name_(name) {}

  std::vector<Setting> all() {
    yaml_node_t* root = yaml_document_get_root_node(&document_);
    if (root->type == YAML_SCALAR_NODE && textOf(root).empty()) return {};
    if (root->type != YAML_MAPPING_NODE)
      fail(root, std::string(root->type == YAML_SEQUENCE_NODE ? "a list" : "a text") +
                     " at the top; an options file consists of lines `name: value`");
    addMapping(root, "", false, 0);
    return std::move(settings_);
  }

 private:
  [[noreturn]] void fail(const yaml_node_t* at, const std::string& message) const {
    squeal::fail(name_, lineOf(at->start_mark), message);
  }

  yaml_node_t* node(int index) const { return yaml_document_get_node(&document_, index); }

  std::string textOf(const yaml_node_t* scalar) const {
    static const std::set<std::string> plain{YAML_STR_TAG, YAML_INT_TAG, YAML_FLOAT_TAG,
                                             YAML_BOOL_TAG, YAML_NULL_TAG};
    const std::string tag = scalar->tag ? reinterpret_cast<const char*>(scalar->tag) : YAML_STR_TAG;
    if (!plain.count(tag)) fail(scalar, "the tag '" + tag + "' is not supported");
    return trimmed(std::string(reinterpret_cast<const char*>(scalar->data.scalar.value),
                               scalar->data.scalar.length));
  }

  struct Key {
    int line;
    bool isSection;
  };

  /// Throws Error for a section that is given twice, which YAML forbids and libyaml accepts. add()
  /// checks values, which may have the same name in other sections.
  void requireFirst(std::map<std::string, Key>& keys, const std::string& name,
                    const yaml_node_t* key, bool isSection) const {
    const auto [earlier, isNew] = keys.insert({name, {lineOf(key->start_mark), isSection}});
    if (!isNew && (isSection || earlier->second.isSection))
      fail(key,
           formatted("'%s' is given twice, first in line %d", name.c_str(), earlier->second.line));
  }

  void addMapping(const yaml_node_t* mapping, const std::string& prefix, bool merged, int depth) {
    if (depth > deepest)
      fail(mapping,
           formatted("nested deeper than %d levels; does an alias contain itself?", deepest));
    if (mapping->data.mapping.pairs.start == mapping->data.mapping.pairs.top)
      fail(mapping, "a map without entries");
    std::map<std::string, Key> keys;
    for (const auto* pair = mapping->data.mapping.pairs.start;
         pair < mapping->data.mapping.pairs.top; ++pair) {
      const yaml_node_t *key = node(pair->key), *value = node(pair->value);
      if (key->type != YAML_SCALAR_NODE) fail(key, "a list or a map in place of a name");
      const std::string name = textOf(key);
      requireFirst(keys, name, key, name == "<<" || value->type == YAML_MAPPING_NODE);
      if (name == "<<")
        merge(value, prefix, depth);
      else if (value->type == YAML_MAPPING_NODE)
        addMapping(value, prefix + name + "_", merged, depth + 1);
      else
        add({prefix + name,
             value->type == YAML_SCALAR_NODE ? textOf(value) : list(value, prefix + name), name_,
             lineOf(key->start_mark)},
            merged);
    }
  }

  /// Adds the entries of the merge key of YAML 1.1; an entry next to it has priority.
  void merge(const yaml_node_t* value, const std::string& prefix, int depth) {
    if (value->type == YAML_MAPPING_NODE) return addMapping(value, prefix, true, depth + 1);
    if (value->type != YAML_SEQUENCE_NODE) fail(value, "'<<' merges only maps, and this is a text");
    for (const auto* item = value->data.sequence.items.start; item < value->data.sequence.items.top;
         ++item) {
      if (node(*item)->type != YAML_MAPPING_NODE) fail(node(*item), "'<<' merges only maps");
      addMapping(node(*item), prefix, true, depth + 1);
    }
  }

  std::string list(const yaml_node_t* sequence, const std::string& name) const {
    std::vector<std::string> items;
    for (const auto* item = sequence->data.sequence.items.start;
         item < sequence->data.sequence.items.top; ++item) {
      if (node(*item)->type != YAML_SCALAR_NODE)
        fail(node(*item), "the list of -" + name + " contains a list or a map");
      items.push_back(textOf(node(*item)));
      if (items.back().empty())
        fail(node(*item), "the list of -" + name + " contains an empty item");
    }
    if (items.empty()) fail(sequence, "the list of -" + name + " is empty");
    return joined(items, ",");
  }

  void add(Setting setting, bool merged) {
    const auto [known, isNew] = where_.insert({setting.name, {settings_.size(), merged}});
    auto& [index, wasMerged] = known->second;
    if (isNew) {
      if (settings_.size() >= mostSettings)
        squeal::fail(name_, setting.line, formatted("more than %zu options", mostSettings));
      settings_.push_back(std::move(setting));
    } else if (!merged && !wasMerged) {
      squeal::fail(name_, setting.line,
                   formatted("a second value of -%s, already set in line %d", setting.name.c_str(),
                             settings_[index].line));
    } else if (!merged) {
      settings_[index] = std::move(setting);
      wasMerged = false;
    }
  }

  yaml_document_t& document_;
  const std::string& name_;
  std::vector<Setting> settings_;
  std::map<std::string, std::pair<std::size_t, bool>> where_;  ///< [name] index, merged
};

}  // namespace

std::vector<Setting> settingsOfYaml(const std::string& text, const std::string& name) {
  Parser parser(text);
  Document document, next;
  if (!load(parser, document, text, name)) return {};
  auto settings = Flattening(document.document, name).all();
  if (load(parser, next, text, name))
    fail(name, lineOf(yaml_document_get_root_node(&next.document)->start_mark),
         "a second document begins; an options file contains only one");
  return settings;
}

}  // namespace squeal
