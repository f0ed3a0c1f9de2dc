// What an input deck of Abaqus or CalculiX (.inp) says of the mesh; everything else in it is counted and skipped.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene.hpp"

namespace nanson {

/// What is wrong with a deck: "file:12: ...".
struct InpError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Tags of nodes or elements under a name.
struct InpSet {
  std::string name;   // as it is written first; upper and lower case do not matter to a deck
  std::string place;  // "deck.inp:12"
  std::vector<std::int64_t> members;
};

/// Sets by name, in the order of the deck.
class InpSets {
 public:
  InpSet& at(std::string_view name, const std::string& place);  // made where there is none
  const InpSet* find(std::string_view name) const;              // also "INSTANCE.NAME"; nullptr
  const std::vector<InpSet>& all() const { return sets_; }

 private:
  std::vector<InpSet> sets_;
  std::map<std::string, std::size_t> index_;  // by name in capitals
};

/// A line of a *SURFACE.
struct InpSurfaceLine {
  std::string of;     // a set or a tag
  std::string face;   // S1 to S4; empty: the whole set
  std::string place;  // "deck.inp:12"
};
struct InpSurface {
  std::string name;
  bool of_nodes = false;
  std::vector<InpSurfaceLine> lines;
};

template <std::size_t n>
struct InpElements {
  std::vector<std::int64_t> tags;
  std::vector<std::array<std::int64_t, n>> nodes;
};

struct InpDeck {
  std::vector<std::int64_t> node_tags;
  std::vector<Vec3> X;  // [m]
  InpElements<4> tets;
  InpElements<3> triangles;
  InpSets node_sets, element_sets;
  std::vector<InpSurface> surfaces;
  std::vector<std::string> sections;          // element sets of *SOLID SECTION
  std::vector<std::string> own_sets;          // those that an *ELEMENT names itself
  std::map<std::string, long> skipped;        // keywords that say nothing of the mesh, how often
  std::map<std::string, long> skipped_types;  // elements that are neither tets nor triangles
};

/// Reads a deck and what it includes. Throws InpError.
InpDeck read_inp_deck(const std::filesystem::path& file);

/// In capitals.
std::string upper(std::string_view text);

}  // namespace nanson
