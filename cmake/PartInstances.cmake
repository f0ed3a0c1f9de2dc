# Every combination of traits, explicitly: the same table as engine/registry.cpp, which does not link when a line is missing here.
set(PART_INSTANCES "")
function(add_instance name header)
  set(INSTANCE_HEADER ${header})
  string(JOIN "\n" INSTANCE_LINES ${ARGN})
  configure_file(${CMAKE_CURRENT_SOURCE_DIR}/engine/instance.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/instances/${name}.cpp @ONLY)
  set(PART_INSTANCES ${PART_INSTANCES} ${CMAKE_CURRENT_BINARY_DIR}/instances/${name}.cpp PARENT_SCOPE)
endfunction()

set(SWEEP "const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&, const Coefficients&")
foreach(traits true:true:none true:false:none false:true:none false:false:none true:true:limiter true:false:limiter false:true:limiter false:false:limiter
        false:false:laplacian)
  string(REPLACE ":" ";" t ${traits})
  list(GET t 0 tensor)
  list(GET t 1 full)
  list(GET t 2 weights)
  add_instance(gradient_${tensor}_${full}_${weights} gradient_part.hpp "template void gradient_part<${tensor}, ${full}, NodeWeights::${weights}>(${SWEEP})\;")
endforeach()

# What an edge loop loads: see edge_flux_part. The correction is made of gradients, current areas want the plain jumps.
foreach(gathered constant:none linear:none linear:pressure linear:full limited:none limited:pressure limited:full)
  string(REPLACE ":" ";" t ${gathered})
  list(GET t 0 reconstruction)
  list(GET t 1 found)
  set(lines "")
  foreach(rest scalar:false:undeformed scalar:true:undeformed tensor:false:undeformed tensor:true:undeformed scalar:true:current)
    string(REPLACE ":" ";" t ${rest})
    list(GET t 0 jump)
    list(GET t 1 plain)
    list(GET t 2 areas)
    string(APPEND lines "template double edge_flux_part<Reconstruction::${reconstruction}, FluxCorrection::${found}, PressureJump::${jump}, ${plain}, Areas::${areas}>(${SWEEP}, const Scratch&)\;\n")
  endforeach()
  add_instance(edge_flux_${reconstruction}_${found} edge_flux_part.hpp "${lines}")
endforeach()

foreach(law neo_hookean mooney_rivlin)
  add_instance(projected_stress_${law} projected_stress_part.hpp
    "template PartReport projected_stress_part<Law::${law}>(const Part&, const Rows&, const Coefficients&, const double*)\;"
    "template double projected_energy_part<Law::${law}>(const Part&, const Rows&, const Coefficients&)\;")
endforeach()

foreach(formulation pF pFJ pFHJ)
  foreach(correction none lagged found)
    add_instance(accumulate_update_${formulation}_${correction} accumulate_update_part.hpp
      "template void accumulate_update_part<Formulation::${formulation}, GradientCorrection::${correction}>(const Part&, const EdgeArrays&, const NodeLists&, const Rows&, const Coefficients&, const Constraint*, double*, const Scratch&)\;")
  endforeach()
  foreach(material linear_elastic:quadratic:F hencky_j2:quadratic:F neo_hookean:quadratic:F neo_hookean:barrier:F neo_hookean:quadratic:J neo_hookean:barrier:J
          mooney_rivlin:quadratic:F mooney_rivlin:barrier:F mooney_rivlin:quadratic:J mooney_rivlin:barrier:J)
    string(REPLACE ":" ";" triple ${material})
    list(GET triple 0 law)
    list(GET triple 1 volumetric)
    list(GET triple 2 isochoric)
    if(NOT (isochoric STREQUAL J AND formulation STREQUAL pF))
      set(traits "Law::${law}, Volumetric::${volumetric}, Isochoric::${isochoric}, Formulation::${formulation}")
      add_instance(stress_${law}_${volumetric}_${isochoric}_${formulation} stress_part.hpp
        "template PartReport stress_part<${traits}>(const Part&, const Rows&, const Coefficients&, const double*)\;"
        "template double strain_energy_part<${traits}>(const Part&, const Rows&, const Coefficients&)\;")
    endif()
  endforeach()
endforeach()
