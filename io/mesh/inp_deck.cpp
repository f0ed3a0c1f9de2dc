// Keyword lines "*ELSET, ELSET=LID, GENERATE", each followed by its data lines; "**" starts a comment.
#include "io/mesh/inp_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "io/text_file.hpp"

namespace nanson {
namespace {

constexpr int deepest = 16;  // *INCLUDE in *INCLUDE

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view text) {
  return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();  // a comma at the end
  return fields;
}

template <class Value>
bool parse(std::string_view text, Value& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::string plain(text);
  for (char& c : plain)
    if (c == 'D' || c == 'd') c = 'e';  // Fortran's exponents
  const char* end = plain.data() + plain.size();
  const auto [stop, problem] = std::from_chars(plain.data(), end, value);
  return problem == std::errc{} && stop == end;
}

/// A keyword line.
struct Card {
  std::string keyword;                         // in capitals, without the star
  std::map<std::string, std::string> options;  // names in capitals; values as they are written

  bool has(const char* option) const { return options.contains(option); }
  std::string at(const char* option) const { return has(option) ? options.at(option) : ""; }
};

bool is_one_of(std::string_view word, const std::set<std::string_view>& words) { return words.contains(word); }

/// Three nodes each, on faces of tets.
bool is_triangle(std::string_view type) {
  static const std::set<std::string_view> types{"S3",   "S3R",  "S3RS",   "STRI3", "CPS3", "CPE3",
                                                "CAX3", "M3D3", "SFM3D3", "R3D3",  "DS3"};
  return is_one_of(type, types);
}

/// Would make or move nodes and elements: to skip it would change the mesh.
bool makes_mesh(std::string_view keyword) {
  static const std::set<std::string_view> words{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
  return is_one_of(keyword, words);
}

class Reader {
 public:
  explicit Reader(InpDeck& deck) : deck_(deck) {}

  void read(const std::filesystem::path& file, int depth) {
    std::string why;
    const std::optional<std::string> text = read_text_file(file, why);
    if (!text && depth > 0) fail(fmt::format("{}: {}", file.string(), why));
    if (!text) throw InpError(fmt::format("{}: {}", file.string(), why));
    const Place above = std::exchange(at_, {file.string(), 0});
    for (std::size_t begin = 0; begin < text->size();) {
      const std::size_t end = std::min(text->find('\n', begin), text->size());
      ++at_.line;
      take(trimmed(std::string_view(*text).substr(begin, end - begin)), file, depth);
      begin = end + 1;
    }
    finish_card();
    handle_ = &Reader::nothing;
    if (depth > 0) at_ = above;
  }

 private:
  struct Place {
    std::string file;
    std::size_t line = 0;
  };

  std::string place() const { return fmt::format("{}:{}", at_.file, at_.line); }
  [[noreturn]] void fail(const std::string& what) const { throw InpError(fmt::format("{}: {}", place(), what)); }

  void take(std::string_view line, const std::filesystem::path& file, int depth) {
    if (line.empty() || line.starts_with("**")) return;
    if (line[0] != '*') return data(fields_of(line));
    finish_card();
    start_card(line.substr(1));
    if (card_.keyword != "INCLUDE") return;
    const std::string input(unquoted(card_.at("INPUT")));
    if (input.empty()) fail("*INCLUDE needs INPUT=FILE");
    if (depth == deepest) fail(fmt::format("files include each other more than {} deep", deepest));
    read(file.parent_path() / input, depth + 1);
  }

  void start_card(std::string_view line) {
    card_ = {};
    const auto fields = fields_of(line);
    if (fields.empty()) fail("a star without a keyword");
    card_.keyword = upper(fields[0]);
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const std::size_t is = fields[i].find('=');
      card_.options[upper(trimmed(fields[i].substr(0, is)))] = is == fields[i].npos
                                                                   ? ""
                                                                   : unquoted(trimmed(fields[i].substr(is + 1)));
    }
    handle_ = &Reader::nothing;
    const std::string& k = card_.keyword;
    if (k == "NODE") start_nodes();
    else if (k == "ELEMENT") start_elements();
    else if (k == "NSET") start_set("NSET", deck_.node_sets);
    else if (k == "ELSET") start_set("ELSET", deck_.element_sets);
    else if (k == "SURFACE") start_surface();
    else if (k == "SOLID SECTION" && card_.has("ELSET")) deck_.sections.push_back(card_.at("ELSET"));
    else if (k == "PART" || k == "INSTANCE") start_body();
    else if (makes_mesh(k)) fail(fmt::format("*{} makes or moves nodes: write the deck with all of them in place", k));
    else if (k != "HEADING" && k != "INCLUDE" && k != "ASSEMBLY" && !k.starts_with("END ")) ++deck_.skipped[k];
  }

  /// All the data of the card must have come.
  void finish_card() {
    if (!element_.empty()) fail("the file goes on before the last element has all its nodes");
  }

  void data(const std::vector<std::string_view>& fields) { (this->*handle_)(fields); }
  void nothing(const std::vector<std::string_view>&) {}

  template <class Value>
  Value number(std::string_view text, const char* what) const {
    Value value{};
    if (!parse(text, value)) fail(fmt::format("\"{}\" is no {}", text, what));
    return value;
  }

  void start_nodes() {
    if (upper(card_.at("SYSTEM")) != "R" && card_.has("SYSTEM"))
      fail("*NODE, SYSTEM: only Cartesian coordinates are read");
    handle_ = &Reader::node;
    set_ = card_.has("NSET") ? &deck_.node_sets.at(card_.at("NSET"), place()) : nullptr;
  }
  void node(const std::vector<std::string_view>& fields) {
    if (fields.size() < 2 || fields.size() > 7) fail("a node is its number and three coordinates");
    Vec3 X{};
    for (std::size_t k = 0; k < 3 && k + 1 < fields.size(); ++k)
      if (!fields[k + 1].empty()) X[k] = number<double>(fields[k + 1], "coordinate");
    deck_.node_tags.push_back(number<std::int64_t>(fields[0], "node number"));
    deck_.X.push_back(X);
    if (set_) set_->members.push_back(deck_.node_tags.back());
  }

  void start_elements() {
    const std::string type = upper(card_.at("TYPE"));
    const std::string shape = type.starts_with("DC3D") ? type.substr(1) : type;
    if (type.empty()) fail("*ELEMENT needs TYPE=");
    if (shape.starts_with("C3D10"))
      fail(fmt::format("elements {} are of second order: write the mesh with C3D4", type));
    if (shape.starts_with("C3D") && !shape.starts_with("C3D4"))
      fail(fmt::format("elements {} are no tetrahedra: mesh with C3D4", type));
    set_ = nullptr;
    element_nodes_ = shape.starts_with("C3D4") ? 4 : is_triangle(type) ? 3 : 0;
    handle_ = element_nodes_ > 0 ? &Reader::element : &Reader::skipped_element;
    if (element_nodes_ == 0) skipped_ = &deck_.skipped_types[type];
    else if (card_.has("ELSET")) {
      set_ = &deck_.element_sets.at(card_.at("ELSET"), place());
      if (element_nodes_ == 4) deck_.own_sets.push_back(set_->name);
    }
  }
  void skipped_element(const std::vector<std::string_view>&) { ++*skipped_; }
  void element(const std::vector<std::string_view>& fields) {  // may go on over lines
    for (const std::string_view f : fields) element_.push_back(number<std::int64_t>(f, "node number"));
    const std::size_t all = 1 + element_nodes_;
    if (element_.size() < all) return;
    if (element_.size() > all) fail(fmt::format("an element is its number and {} nodes", element_nodes_));
    const auto* n = &element_[1];
    if (element_nodes_ == 4) {
      deck_.tets.tags.push_back(element_[0]);
      deck_.tets.nodes.push_back({n[0], n[1], n[2], n[3]});
    } else {
      deck_.triangles.tags.push_back(element_[0]);
      deck_.triangles.nodes.push_back({n[0], n[1], n[2]});
    }
    if (set_) set_->members.push_back(element_[0]);
    element_.clear();
  }

  void start_set(const char* option, InpSets& sets) {
    if (card_.at(option).empty()) fail(fmt::format("*{} needs {}=NAME", card_.keyword, option));
    if (std::string_view(option) == "NSET" && card_.has("ELSET")) fail("*NSET of an ELSET is not read: list the nodes");
    set_ = &sets.at(card_.at(option), place());
    known_ = &sets;
    handle_ = card_.has("GENERATE") ? &Reader::range : &Reader::members;
  }
  void members(const std::vector<std::string_view>& fields) {
    for (const std::string_view f : fields) {
      if (f.empty()) continue;
      std::int64_t tag;
      if (parse(f, tag)) set_->members.push_back(tag);
      else if (const InpSet* other = known_->find(unquoted(f))) {
        const std::vector<std::int64_t> copy = other->members;  // it may be the same set
        set_->members.insert(set_->members.end(), copy.begin(), copy.end());
      } else fail(fmt::format("\"{}\" is neither a number nor a set that stands above", f));
    }
  }
  void range(const std::vector<std::string_view>& fields) {
    if (fields.size() < 2 || fields.size() > 3) fail("GENERATE takes the first number, the last and the step");
    const auto first = number<std::int64_t>(fields[0], "number"), last = number<std::int64_t>(fields[1], "number");
    const auto step = fields.size() > 2 ? number<std::int64_t>(fields[2], "step") : 1;
    constexpr std::int64_t most = 2'147'483'647;
    if (step < 1 || last < first || (last - first) / step >= most)
      fail("GENERATE takes numbers that grow by a step of at least 1");
    for (std::int64_t tag = first; tag <= last; tag += step) set_->members.push_back(tag);
  }

  void start_surface() {
    const std::string type = upper(card_.at("TYPE"));
    if (card_.at("NAME").empty()) fail("*SURFACE needs NAME=");
    if (!type.empty() && type != "ELEMENT" && type != "NODE") {
      ++deck_.skipped["SURFACE, TYPE=" + type];
      return;
    }
    deck_.surfaces.push_back({card_.at("NAME"), type == "NODE", {}});
    handle_ = &Reader::surface_line;
  }
  void surface_line(const std::vector<std::string_view>& fields) {
    if (fields.empty() || fields[0].empty()) fail("a line of a *SURFACE names a set or a number first");
    const bool of_nodes = deck_.surfaces.back().of_nodes;
    deck_.surfaces.back().lines.push_back(
        {std::string(unquoted(fields[0])), fields.size() > 1 && !of_nodes ? upper(fields[1]) : "", place()});
  }

  void start_body() {
    int& seen = card_.keyword == "PART" ? parts_ : instances_;
    if (++seen > 1)
      fail(
          fmt::format("a second *{}: nanson reads one part, or a flat deck (Abaqus: \"Do not use parts and assemblies "
                      "in input files\")",
                      card_.keyword));
    if (card_.keyword == "INSTANCE") handle_ = &Reader::placement;
  }
  void placement(const std::vector<std::string_view>& fields) {
    if (fields.size() > 3) fail("a turned *INSTANCE is not read: write a flat deck");
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const double shift = number<double>(fields[k], "translation");
      for (Vec3& X : deck_.X) X[k] += shift;  // the part stands above
    }
  }

  InpDeck& deck_;
  Place at_;  // the line that is read
  Card card_;
  void (Reader::*handle_)(const std::vector<std::string_view>&) = &Reader::nothing;
  InpSet* set_ = nullptr;  // that data goes to
  const InpSets* known_ = nullptr;
  std::vector<std::int64_t> element_;  // number and nodes so far
  std::size_t element_nodes_ = 0;
  long* skipped_ = nullptr;
  int parts_ = 0, instances_ = 0;
};

}  // namespace

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

InpSet& InpSets::at(std::string_view name, const std::string& place) {
  const auto [at, is_new] = index_.emplace(upper(name), sets_.size());
  if (is_new) sets_.push_back({std::string(name), place, {}});
  return sets_[at->second];
}

const InpSet* InpSets::find(std::string_view name) const {
  auto at = index_.find(upper(name));
  if (const std::size_t dot = name.rfind('.'); at == index_.end() && dot != name.npos)
    at = index_.find(upper(name.substr(dot + 1)));
  return at == index_.end() ? nullptr : &sets_[at->second];
}

InpDeck read_inp_deck(const std::filesystem::path& file) {
  InpDeck deck;
  Reader(deck).read(file, 0);
  return deck;
}

}  // namespace nanson
