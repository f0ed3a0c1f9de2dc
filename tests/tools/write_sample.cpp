// write_sample FOLDER: a complete set of results with known values, for the tests that read them with other programs.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "io/provenance.hpp"
#include "io/results/results_folder.hpp"
#include "io/results/write_fields.hpp"
#include "io/results/write_history.hpp"
#include "io/results/write_summary.hpp"
#include "tests/support/sample_results.hpp"

int main(int count, char** arguments) {
  using namespace nanson;
  if (count != 2) return 2;
  const Mesh mesh = test::beam(2, 2, 12);
  const std::vector<Field> fields{field_named("displacement"), field_named("velocity"), field_named("pressure"),
                                  field_named("P")};
  const auto from = provenance();
  ResultsFolder folder("sample", arguments[1]);
  folder.begin(true);
  FieldWriter writer(folder.path(), mesh, fields, results_attributes(from, 2, "scene = \"sample\"  # \u00e9\n"), 0);
  HistoryWriter history(folder.path() / "history.csv", {{"t", "s"}, {"third", "-"}, {"broken", "-"}});
  constexpr int frames = 5;
  for (int i = 0; i < frames; ++i) {
    const double t = 0.25 * i;
    std::vector<float> values;
    writer.frame(t, 100 * i, i + 1 == frames, [&](const Field& field) {
      values = test::sample_values(mesh, field, t);
      return std::span<const float>(values);
    });
    history.row(std::array{t, t / 3, i + 1 == frames ? std::numeric_limits<double>::quiet_NaN() : 1.0});
  }
  Summary summary;
  summary.status = "breakdown";
  summary.reason = "det F = NaN at node 7, \"top\"\n";
  summary.cause = "detF";
  summary.scene = "sample";
  summary.nodes = long(mesh.X.size());
  summary.tets = long(mesh.tets.size());
  summary.t_end = 1.0;
  summary.wall_s = 0.1 + 0.2;
  summary.min_detF = std::numeric_limits<double>::quiet_NaN();
  summary.energy.initial = 2.0;
  summary.energy.external_work = 0.5;
  summary.errors = {{"p1_L2", 1.0 / 3}, {"P11_L2", std::numeric_limits<double>::infinity()}};
  summary.probes["tip"] = {{"x", {1.0, 2.0, 3.0}}, {"pressure", {-0.5}}};
  summary.peak_bytes = 234e3;
  summary.setup = {{"metis", 0.25}};
  summary.sweeps = {{"edge_flux", 0.75}};
  summary.fields_left_out = {"H"};
  write_summary(folder.path() / "summary.json", summary, from);
  return 0;
}
