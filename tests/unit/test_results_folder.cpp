// The results folder: where it is, who may use it, and what a new run removes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "io/results/results_folder.hpp"
#include "tests/support/child.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const FolderError& error) {
    return error.what();
  }
  return "no exception";
}

class CurrentFolder {
 public:
  explicit CurrentFolder(const fs::path& path) : before_(fs::current_path()) { fs::current_path(path); }
  ~CurrentFolder() { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST(ResultsFolder, IsNamedAfterTheSceneUnlessTheUserNamesOne) {
  const test::TemporaryFolder folder;
  const CurrentFolder here(folder.path());
  EXPECT_EQ(ResultsFolder("beam", {}).path(), fs::path("results/beam"));
  EXPECT_TRUE(fs::is_directory(folder / "results/beam"));
  EXPECT_EQ(ResultsFolder("beam", folder / "a/b/c").path(), folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  for (const char* name : {"", ".", "..", "../beam", "a/b"})
    EXPECT_EQ(refusal([&] { ResultsFolder(name, {}); }),
              "the scene's name \"" + std::string(name) + "\" cannot be the name of a folder; name one with --out");
}

TEST(ResultsFolder, EarlierResultsMoveAsideAndNothingElse) {
  const test::TemporaryFolder folder;
  const fs::path beam = folder / "beam";
  for (int run = 0; run < 3; ++run) {
    ResultsFolder results("beam", beam / "");
    const std::string kept = beam.string() + "." + std::to_string(run);
    EXPECT_EQ(results.begin(false), run == 0 ? "" : "earlier results moved to " + kept);
    EXPECT_EQ(results.begin(false), "");
    for (const char* name : {"run.vtkhdf", "run.xdmf", "history.csv", "summary.json"}) {
      EXPECT_FALSE(fs::exists(beam / name)) << name;
      test::write_text(beam / name, std::to_string(run));
      for (int before = 0; before < run; ++before)
        EXPECT_EQ(test::read_text(beam.string() + "." + std::to_string(before + 1) + "/" + name),
                  std::to_string(before));
    }
    test::write_text(beam / "notes.txt", "mine");
  }
  EXPECT_FALSE(fs::exists(beam.string() + ".1/notes.txt"));
}

TEST(ResultsFolder, TheCurrentFolderItselfKeepsEarlierResultsBesideIt) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "here");
  const CurrentFolder here(folder / "here");
  test::write_text("summary.json", "old");
  EXPECT_EQ(ResultsFolder("beam", ".").begin(false),
            "earlier results moved to " + (fs::canonical(folder.path()) / "here.1").string());
  EXPECT_EQ(test::read_text(folder / "here.1/summary.json"), "old");
}

TEST(ResultsFolder, ForceRemovesOnlyWhatARunWrites) {
  const test::TemporaryFolder folder;
  for (const char* name : {"run.vtkhdf", "run.xdmf", "history.csv", "summary.json", "notes.txt", "run.vtkhdf.old"})
    test::write_text(folder / name, "old");
  ResultsFolder results("beam", folder.path());
  EXPECT_EQ(test::read_text(folder / "run.vtkhdf"), "old");
  EXPECT_EQ(results.begin(true), "replaces an earlier run's summary.json history.csv run.xdmf run.vtkhdf");
  for (const char* name : {"run.vtkhdf", "run.xdmf", "history.csv", "summary.json"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const char* name : {"notes.txt", "run.vtkhdf.old"}) EXPECT_EQ(test::read_text(folder / name), "old");
  EXPECT_TRUE(results.begin(true).empty());
  EXPECT_FALSE(fs::exists(folder.path().string() + ".1"));
}

TEST(ResultsFolder, ASecondRunIsRefusedWhileTheFirstOneLives) {
  const test::TemporaryFolder folder;
  const std::string expected = folder.path().string() + ": another run (process " + std::to_string(::getpid())
                               + ") is writing to this folder; wait for it or name another one with --out";
  {
    const ResultsFolder first("beam", folder.path());
    EXPECT_EQ(
        test::run_child([&] { return refusal([&] { ResultsFolder("beam", folder.path()); }) == expected ? 0 : 1; }), 0);
    EXPECT_EQ(refusal([&] { ResultsFolder("beam", folder.path()); }), expected);
  }
  EXPECT_EQ(test::run_child([&] {
              ResultsFolder("beam", folder.path());
              return 0;
            }),
            0);
}

TEST(ResultsFolder, AKilledRunLeavesNoLock) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::run_child([&] {
              const ResultsFolder killed("beam", folder.path());
              return ::kill(::getpid(), SIGKILL);
            }),
            128 + SIGKILL);
  EXPECT_NO_THROW(ResultsFolder("beam", folder.path()));
}

TEST(ResultsFolder, AFileInItsPlaceIsReported) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "file", "");
  EXPECT_EQ(refusal([&] { ResultsFolder("beam", folder / "file"); }),
            (folder / "file").string() + ": is a file, not a folder");
  EXPECT_EQ(refusal([&] { ResultsFolder("beam", folder / "file/below"); }),
            (folder / "file/below").string() + ": the folder could not be created: Not a directory");
  EXPECT_EQ(refusal([&] { ResultsFolder("beam", ""); }), "the name of the results folder is empty");
}

TEST(ResultsFolder, AFolderInPlaceOfAResultIsNotRemoved) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "run.vtkhdf");
  ResultsFolder results("beam", folder.path());
  EXPECT_EQ(refusal([&] { results.begin(false); }),
            (folder / "run.vtkhdf").string() + ": is a folder, where results are to be written");
  EXPECT_TRUE(fs::exists(folder / "run.vtkhdf"));
}

TEST(ResultsFolder, AFolderThatCannotBeWrittenToIsReported) {
  const test::TemporaryFolder folder;
  fs::permissions(folder.path(),
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  const int ended = test::run_child([&] {
    if (::getuid() == 0 && ::setuid(65534) != 0) return 1;  // the administrator may write anywhere
    return refusal([&] { ResultsFolder("beam", folder.path()); })
                   == folder.path().string() + ": the folder cannot be written to: Permission denied"
               ? 0
               : 2;
  });
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(ended, 0);
}

}  // namespace
}  // namespace nanson
