# The launcher, the pages, results read with other programs, where these are installed, and the build's provenance script.
add_test(NAME Launcher COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/launcher_test.sh)

add_test(NAME Completion COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/completion_test.sh ${CMAKE_CURRENT_SOURCE_DIR}/completions/nanson)

# A test passes when the program says this, whatever its exit code.
function(nanson_says name pattern)
  add_test(NAME Program.${name} COMMAND nanson ${ARGN})
  set_tests_properties(Program.${name} PROPERTIES PASS_REGULAR_EXPRESSION "${pattern}")
endfunction()
nanson_says(SuggestsAVerb "rnu: unknown verb, did you mean \"run\"" rnu scene.toml)
nanson_says(TellsItsVerbsWhenNoneIsGiven "run .*study .*check .*keys .*new ")
nanson_says(TellsAKey "material.poissons_ratio: number above -1 and at most 0.5 \\[-\\], required" keys material.poissons_ratio)
nanson_says(TellsWhatAKeyCannotStandBeside "physics.parting beside physics.stabilisation" keys physics.parting)
nanson_says(SuggestsAKey "poisons_ratio: unknown key, did you mean \"poissons_ratio\"" keys poisons_ratio)
nanson_says(TellsItsOutput "P \\(9\\) \\[Pa\\]" keys output)

add_executable(write_sample tests/tools/write_sample.cpp)
target_link_libraries(write_sample PRIVATE nanson_io)

# Debian's own python: another one that comes first in the path may lack h5py
find_program(NANSON_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NANSON_PYTHON)
  execute_process(COMMAND ${NANSON_PYTHON} -c "import h5py, numpy" RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
  if(missing EQUAL 0)
    add_test(NAME Results.ReadWithH5py
             COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/read_with_h5py.py $<TARGET_FILE:write_sample>)
  endif()
endif()

find_program(NANSON_PVPYTHON pvpython)
if(NANSON_PVPYTHON)
  add_test(NAME Results.ReadWithParaView
           COMMAND ${NANSON_PVPYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/read_with_paraview.py $<TARGET_FILE:write_sample>)
endif()

add_test(NAME Provenance.ScriptWithoutGitAndWithoutChange
         COMMAND ${CMAKE_COMMAND} -DSCRIPT=${CMAKE_CURRENT_SOURCE_DIR}/cmake/provenance.cmake -DCOMPILER=${CMAKE_CXX_COMPILER}
                 -DWORK=${CMAKE_CURRENT_BINARY_DIR}/provenance_test -P ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/check_provenance.cmake)

if(NANSON_PYTHON)
  add_test(NAME Pages
           COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/check_pages.py ${CMAKE_CURRENT_SOURCE_DIR} $<TARGET_FILE:nanson>)
  add_test(NAME Program.Faults
           COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/faults_test.py $<TARGET_FILE:nanson>)
  if(missing EQUAL 0)
    add_test(NAME Program.Restart
             COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/restart_test.py $<TARGET_FILE:nanson> ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  add_test(NAME Reference.IsWhatTheProgramTells
           COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/configs/reference.py --check $<TARGET_FILE:nanson>)
  execute_process(COMMAND ${NANSON_PYTHON} -c "import jsonschema, tomllib" RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
  if(missing EQUAL 0)
    add_test(NAME Reference.ScenesAndStudiesKeepToTheirSchemas
             COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/schema_test.py ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  add_test(NAME Includes.NoneRunsUp COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/check_includes.py ${CMAKE_CURRENT_SOURCE_DIR})
  add_test(NAME Study.EndToEnd
           COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/study_test.py $<TARGET_FILE:nanson> ${CMAKE_CURRENT_SOURCE_DIR})
  find_program(NANSON_CHROMIUM NAMES chromium chromium-browser google-chrome)
  if(NANSON_CHROMIUM)
    add_test(NAME Study.PageInChromium
             COMMAND ${NANSON_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/tests/tools/study_page_in_chromium.py $<TARGET_FILE:nanson> ${CMAKE_CURRENT_SOURCE_DIR} ${NANSON_CHROMIUM})
  endif()
endif()
