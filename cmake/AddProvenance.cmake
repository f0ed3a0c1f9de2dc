# add_provenance(TARGET): TARGET can include nanson_build.hpp, which cmake/provenance.cmake writes at every build (and touches only when it changes).
set(NANSON_PROVENANCE_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/provenance.cmake)
function(add_provenance target)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/generated/nanson_build.hpp)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}" flags)
  add_custom_target(nanson_provenance BYPRODUCTS ${header} VERBATIM COMMENT ""
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR} -DHEADER=${header} -DVERSION=${PROJECT_VERSION}
            -DCOMPILER=${CMAKE_CXX_COMPILER} "-DCOMPILER_NAME=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
            "-DFLAGS=${flags} $<JOIN:$<TARGET_PROPERTY:nanson_flags,INTERFACE_COMPILE_OPTIONS>, >" -DCPU=${NANSON_CPU} -P ${NANSON_PROVENANCE_SCRIPT})
  add_dependencies(${target} nanson_provenance)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
endfunction()
