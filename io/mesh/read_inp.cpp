// Tags become indices, sets become names of boundary triangles and of tets.
#include "io/mesh/read_inp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "engine/complaints.hpp"
#include "engine/mesh/mesh_faces.hpp"
#include "io/mesh/inp_deck.hpp"
#include "io/mesh/msh_content.hpp"

namespace nanson {
namespace {

/// Nodes of S1 to S4 of a tet (Abaqus, C3D4).
constexpr std::array<std::array<int, 3>, 4> element_faces{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

std::size_t size(int i) { return static_cast<std::size_t>(i); }

class Builder {
 public:
  Builder(const InpDeck& deck, const std::filesystem::path& file, const UsedNames& used,
          std::vector<std::string>& errors)
      : deck_(deck), file_(file.string()), used_(used), errors_(errors) {}

  RawMesh build(std::vector<std::string>& notes) {
    index(deck_.node_tags, nodes_, "node");
    index(deck_.tets.tags, tets_, "element");
    if (!errors_.empty()) return {};
    resolve_tets();
    if (!errors_.empty()) return {};
    drop_unused_nodes(notes);
    name_regions();
    for (const InpSurface& s : deck_.surfaces) add_surface(s);
    add_triangles();
    add_node_sets();
    tell_skipped(notes);
    return std::move(mesh_);
  }

 private:
  void fail(const std::string& place, const std::string& what) {
    errors_.push_back(fmt::format("{}: {}", place, what));
  }

  void index(const std::vector<std::int64_t>& tags, NodeIndex& index, const char* what) {
    if (tags.size() > size(std::numeric_limits<int>::max()))
      return fail(file_, fmt::format("{} {}s are more than can be numbered", tags.size(), what));
    const auto [tag, twice] = index.build(tags);
    if (twice) fail(file_, fmt::format("{} {} is given twice", what, tag));
  }

  void resolve_tets() {
    Complaints strangers("tets with nodes that do not exist");
    for (std::size_t t = 0; t < deck_.tets.tags.size(); ++t) {
      std::array<int, 4> tet{};
      for (std::size_t v = 0; v < 4; ++v) {
        tet[v] = nodes_.find(deck_.tets.nodes[t][v]);
        if (tet[v] < 0)
          strangers.add([&] {
            return fmt::format("{}: element {} has the node {}, which the deck does not give", file_,
                               deck_.tets.tags[t], deck_.tets.nodes[t][v]);
          });
      }
      mesh_.tets.push_back(tet);
    }
    strangers.append_to(errors_);
  }

  /// Reference points, and nodes of elements that were left out.
  void drop_unused_nodes(std::vector<std::string>& notes) {
    now_.assign(deck_.X.size(), -1);
    for (const auto& tet : mesh_.tets)
      for (const int a : tet) now_[size(a)] = 0;
    int kept = 0;
    for (std::size_t a = 0; a < now_.size(); ++a)
      if (now_[a] == 0) {
        now_[a] = kept++;
        mesh_.X.push_back(deck_.X[a]);
      }
    for (auto& tet : mesh_.tets)
      for (int& a : tet) a = now_[size(a)];
    if (size(kept) < now_.size())
      notes.push_back(fmt::format("{}: {} nodes of no tet were left out", file_, now_.size() - size(kept)));
  }

  /// Index in the mesh; -1 where no tet has the node.
  int node(std::int64_t tag) const {
    const int a = nodes_.find(tag);
    return a < 0 ? -1 : now_[size(a)];
  }

  void take_region(const InpSet& set, bool must_be_free) {
    const int region = static_cast<int>(mesh_.region_names.size());
    bool taken = false;
    for (const std::int64_t tag : set.members) {
      const int t = tets_.find(tag);
      if (t < 0) continue;
      int& of_tet = mesh_.tet_region[size(t)];
      if (of_tet >= 0 && must_be_free && of_tet != region)
        return fail(set.place,
                    fmt::format("element {} is in the sets \"{}\" and \"{}\", and the scene has a material for each",
                                tag, mesh_.region_names[size(of_tet)], set.name));
      if (of_tet >= 0) continue;
      of_tet = region;
      taken = true;
    }
    if (taken) mesh_.region_names.push_back(set.name);
  }

  /// Sets that the scene names go first, then those of the sections, then those of the elements.
  void name_regions() {
    mesh_.tet_region.assign(mesh_.tets.size(), -1);
    for (const std::string& name : used_.regions)
      if (const InpSet* set = deck_.element_sets.find(name); set && set->name == name) take_region(*set, true);
    for (const auto* names : {&deck_.sections, &deck_.own_sets})
      for (const std::string& name : *names)
        if (const InpSet* set = deck_.element_sets.find(name)) take_region(*set, false);
    if (std::find(mesh_.tet_region.begin(), mesh_.tet_region.end(), -1) == mesh_.tet_region.end()) return;
    std::replace(mesh_.tet_region.begin(), mesh_.tet_region.end(), -1, static_cast<int>(mesh_.region_names.size()));
    mesh_.region_names.push_back("unnamed");
  }

  /// -1 when a name that upper and lower case do not tell apart is there already.
  int new_patch(const std::string& name) {
    for (const std::string& known : mesh_.patch_names)
      if (upper(known) == upper(name)) return -1;
    mesh_.patch_names.push_back(name);
    return static_cast<int>(mesh_.patch_names.size()) - 1;
  }
  void add(const std::array<int, 3>& triangle, int patch) {
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_patch.push_back(patch);
  }

  /// Faces of tets that lie between two are dropped when the mesh is finished.
  void add_faces_of(std::int64_t element, const InpSurfaceLine& line, int patch) {
    const int t = tets_.find(element);
    if (t < 0) return;
    for (std::size_t f = 0; f < 4; ++f) {
      if (!line.face.empty() && line.face != fmt::format("S{}", f + 1)) continue;
      const auto& tet = mesh_.tets[size(t)];
      add({tet[size(element_faces[f][0])], tet[size(element_faces[f][1])], tet[size(element_faces[f][2])]}, patch);
    }
  }

  void add_surface(const InpSurface& surface) {
    const int patch = new_patch(surface.name);
    if (patch < 0) return;
    std::vector<char> marked;
    if (surface.of_nodes) marked.assign(mesh_.X.size(), 0);
    for (const InpSurfaceLine& line : surface.lines) {
      if (!surface.of_nodes && !line.face.empty()
          && (line.face.size() != 2 || line.face[0] != 'S' || line.face[1] < '1' || line.face[1] > '4'))
        return fail(line.place, fmt::format("\"{}\" is no face of a tet, allowed: S1 | S2 | S3 | S4", line.face));
      for (const std::int64_t tag : members_of(surface.of_nodes ? deck_.node_sets : deck_.element_sets, line)) {
        if (!surface.of_nodes) add_faces_of(tag, line, patch);
        else if (const int a = node(tag); a >= 0) marked[size(a)] = 1;
      }
    }
    if (surface.of_nodes) add_marked(marked, patch);
  }

  std::vector<std::int64_t> members_of(const InpSets& sets, const InpSurfaceLine& line) {
    std::int64_t tag;
    const char* end = line.of.data() + line.of.size();
    if (const auto [stop, problem] = std::from_chars(line.of.data(), end, tag); problem == std::errc{} && stop == end)
      return {tag};
    if (const InpSet* set = sets.find(line.of)) return set->members;
    fail(line.place, fmt::format("there is no set \"{}\"", line.of));
    return {};
  }

  /// Triangle elements: a face for each set that they are in.
  void add_triangles() {
    if (deck_.triangles.tags.empty()) return;
    NodeIndex triangles;
    index(deck_.triangles.tags, triangles, "element");
    for (const InpSet& set : deck_.element_sets.all()) {
      int patch = -2;
      for (const std::int64_t tag : set.members) {
        const int t = triangles.find(tag);
        if (t < 0) continue;
        const auto& tags = deck_.triangles.nodes[size(t)];
        const std::array<int, 3> nodes{node(tags[0]), node(tags[1]), node(tags[2])};
        if (std::find(nodes.begin(), nodes.end(), -1) != nodes.end()) continue;  // of no tet
        if (patch == -2) patch = new_patch(set.name);
        if (patch >= 0) add(nodes, patch);
      }
    }
  }

  /// A set of nodes is the face of the boundary triangles whose nodes are all in it.
  void add_node_sets() {
    for (const InpSet& set : deck_.node_sets.all()) {
      std::vector<char> marked(mesh_.X.size(), 0);
      for (const std::int64_t tag : set.members)
        if (const int a = node(tag); a >= 0) marked[size(a)] = 1;
      if (const int patch = new_patch(set.name); patch >= 0) add_marked(marked, patch);
    }
  }

  void add_marked(const std::vector<char>& marked, int patch) {
    for (const auto& t : boundary())
      if (marked[size(t[0])] && marked[size(t[1])] && marked[size(t[2])]) add(t, patch);
  }

  /// Faces of one tet only.
  const std::vector<std::array<int, 3>>& boundary() {
    if (!boundary_.empty()) return boundary_;
    const FaceTable table = face_table(mesh_.X.size(), mesh_.tets);
    for (int a = 0; a < static_cast<int>(mesh_.X.size()); ++a) {
      const auto row = table.row(a);
      for (std::size_t begin = 0, end; begin < row.size(); begin = end) {
        end = begin + 1;
        while (end < row.size() && row[end].key() == row[begin].key()) ++end;
        if (end == begin + 1)
          boundary_.push_back({a, static_cast<int>(row[begin].middle), static_cast<int>(row[begin].largest)});
      }
    }
    return boundary_;
  }

  void tell_skipped(std::vector<std::string>& notes) const {
    const auto told = [](const std::map<std::string, long>& counts, const char* star) {
      std::string text;
      for (const auto& [word, count] : counts)
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", star, word,
                            count > 1 ? fmt::format(" ({})", count) : "");
      return text;
    };
    if (!deck_.skipped_types.empty())
      notes.push_back(fmt::format("{}: elements that are neither tets nor triangles were left out: {}", file_,
                                  told(deck_.skipped_types, "")));
    if (!deck_.skipped.empty())
      notes.push_back(
          fmt::format("{}: only the mesh is read of it, materials, supports and loads are the scene's; skipped: {}",
                      file_, told(deck_.skipped, "*")));
  }

  const InpDeck& deck_;
  std::string file_;
  const UsedNames& used_;
  std::vector<std::string>& errors_;
  NodeIndex nodes_, tets_;
  std::vector<int> now_;  // index in the mesh of a node of the deck
  RawMesh mesh_;
  std::vector<std::array<int, 3>> boundary_;
};

}  // namespace

RawMesh read_inp(const std::filesystem::path& file, const UsedNames& used, std::vector<std::string>& errors,
                 std::vector<std::string>& notes) {
  std::vector<std::string> problems;
  RawMesh mesh;
  try {
    const InpDeck deck = read_inp_deck(file);
    mesh = Builder(deck, file, used, problems).build(notes);
  } catch (const InpError& problem) {
    problems.push_back(problem.what());
  }
  errors.insert(errors.end(), problems.begin(), problems.end());
  return mesh;
}

}  // namespace nanson
