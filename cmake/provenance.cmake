# Run at build time with cmake -P: writes HEADER with what the build is made of. The file is touched only when its text changes.
# In: SOURCE_DIR HEADER VERSION COMPILER COMPILER_NAME FLAGS CPU
set(COMMIT "unknown")
find_program(GIT git)
if(GIT)
  # no locks: a build must not get in the way of a git command that runs beside it
  macro(git result output)
    execute_process(COMMAND "${GIT}" --no-optional-locks -C "${SOURCE_DIR}" ${ARGN}
                    RESULT_VARIABLE ${result} OUTPUT_VARIABLE ${output} OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endmacro()
  # sources that were unpacked inside another repository are not of its commit
  git(failed top rev-parse --show-toplevel)
  file(REAL_PATH "${SOURCE_DIR}" source)
  if(failed EQUAL 0 AND top STREQUAL source)
    git(failed commit rev-parse --short=12 HEAD)
    git(failed_status changes status --porcelain --untracked-files=no)
    if(failed EQUAL 0 AND failed_status EQUAL 0)
      set(COMMIT "${commit}")
      if(changes)
        string(APPEND COMMIT "+")
      endif()
    endif()
  endif()
endif()

# what "native" is on this machine: gcc passes it on as -march=, clang as -target-cpu
if(CPU STREQUAL "native")
  execute_process(COMMAND "${COMPILER}" -march=native "-###" -E -x c++ /dev/null OUTPUT_QUIET ERROR_VARIABLE calls)
  string(REGEX REPLACE "-march=native" "" calls "${calls}")
  if(calls MATCHES "(-march=|\"-target-cpu\" \")([a-z0-9_.-]+)")
    set(CPU "native (${CMAKE_MATCH_2})")
  endif()
endif()

file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
// Written by cmake/provenance.cmake.
#pragma once
namespace nanson::build {
inline constexpr char version[] = R"nanson(@VERSION@)nanson";
inline constexpr char commit[] = R"nanson(@COMMIT@)nanson";
inline constexpr char compiler[] = R"nanson(@COMPILER_NAME@)nanson";
inline constexpr char flags[] = R"nanson(@FLAGS@)nanson";
inline constexpr char cpu[] = R"nanson(@CPU@)nanson";
}  // namespace nanson::build
]])
