// Fields over time in one file, run.vtkhdf (VTKHDF 2.0, transient), beside it run.xdmf for older readers; every frame is whole on disk before the next.
//
// /VTKHDF/{Points, Connectivity, Offsets, Types, CellData/region}   the mesh, once; region has the attribute `names`
// /VTKHDF/PointData/NAME [frames * nodes, components] float32       all frames one after the other; attribute `unit`
// /VTKHDF/Steps/...                                                 times and offsets; the attribute NSteps counts the frames that are whole
// /frames/NNNNNN/NAME [nodes, components]                           one frame, no data of its own; the group has time, step and perhaps breakdown = 1
#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/output_field.hpp"

namespace nanson {

inline constexpr int most_patience = 200;  // [ms] a frame waits for a reader to let go of the file

/// Names of the fields of a file, sorted. Throws std::runtime_error with the reason where it cannot be read.
std::vector<std::string> fields_in(const std::filesystem::path& file);

struct EarlierFrames {
  std::filesystem::path file;
  std::size_t frames = 0, bytes = 0;  // how many there are to go on from, and the size that the file then had
};

class FieldWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;
  /// A field's values in mesh order, the components of a node together; they must live until the next call.
  using GetField = std::function<std::span<const float>(const Field&)>;

  /// Creates run.vtkhdf (one that exists is an error) and run.xdmf in a folder that exists. `attributes` go to "/"; `compress` is a gzip level, 0 for none.
  FieldWriter(const std::filesystem::path& folder, const Mesh& mesh, std::vector<Field> fields,
              const Attributes& attributes, int compress);

  /// Goes on after the first frames of another file of the same mesh and fields, or of this folder's own. To its last byte the file becomes what it was when it had
  /// these frames: as it is where its size is still the same, otherwise they are written anew. Attributes stay as they are.
  /// Throws FolderError with the reason; the earlier file then stands as it was.
  FieldWriter(const std::filesystem::path& folder, const Mesh& mesh, std::vector<Field> fields,
              const Attributes& attributes, int compress, const EarlierFrames& earlier);

  /// Appends a frame; the file is closed again afterwards. Throws std::runtime_error with the reason when it cannot be written: the frames before stay
  /// readable, and the frame can be tried again.
  void frame(double t, long step, bool breakdown, const GetField& get);

  /// run.xdmf with every frame so far: between its ends it may lag behind, by a second or an eighth of the frames, as each time the whole of it is written.
  void finish();
  ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  std::size_t frames() const { return frames_; }
  std::size_t bytes() const;  // of the file

 private:
  void create(const Mesh& mesh, const Attributes& attributes);
  void take(const EarlierFrames& earlier, bool anew, const Mesh& mesh, Attributes attributes);
  void count_frame(double t, bool breakdown);
  void append(double t, long step, bool breakdown, const GetField& get);

  std::filesystem::path path_;
  std::vector<Field> fields_;
  std::size_t nodes_, tets_;
  int compress_;
  int patience_ = most_patience;  // [ms] to wait for another program that holds the file
  std::size_t frames_ = 0;
  std::string xdmf_frames_;     // the text of the frames so far, so that a frame costs its own text only
  std::size_t xdmf_count_ = 0;  // frames in run.xdmf
  std::chrono::steady_clock::time_point xdmf_written_{};
  std::chrono::steady_clock::duration xdmf_cost_{};  // of writing it
};

}  // namespace nanson
