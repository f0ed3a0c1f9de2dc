# Every combination of traits, explicitly: the same table as engine/registry.cpp, which does not link when a line is missing here.
set(PART_INSTANCES "")
function(add_instance name header)
  set(INSTANCE_HEADER ${header})
  string(JOIN "\n" INSTANCE_LINES ${ARGN})
  configure_file(${CMAKE_CURRENT_SOURCE_DIR}/engine/instance.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/instances/${name}.cpp @ONLY)
  set(PART_INSTANCES ${PART_INSTANCES} ${CMAKE_CURRENT_BINARY_DIR}/instances/${name}.cpp PARENT_SCOPE)
endfunction()

set(SWEEP "const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&, const Coefficients&")
foreach(traits true:true:none true:false:none false:true:none false:false:none false:true:limiter false:false:limiter false:false:laplacian)
  string(REPLACE ":" ";" t ${traits})
  list(GET t 0 tensor)
  list(GET t 1 full)
  list(GET t 2 weights)
  add_instance(gradient_${tensor}_${full}_${weights} gradient_part.hpp "template void gradient_part<${tensor}, ${full}, NodeWeights::${weights}>(${SWEEP})\;")
endforeach()

foreach(evolves_J true false)
  add_instance(edge_flux_jst_${evolves_J} jst.hpp "template double edge_flux_jst_part<${evolves_J}>(${SWEEP}, const Scratch&)\;")
endforeach()

set(constant_corrections none)
set(linear_corrections none finds_pressure finds_full takes_pressure)
set(limited_corrections ${linear_corrections})
foreach(metric deformed paper)
  foreach(reconstruction constant linear limited)
    foreach(rest false:scalar:none true:scalar:none true:tensor:none false:scalar:edge true:scalar:edge)
      string(REPLACE ":" ";" t ${rest})
      list(GET t 0 evolves_J)
      list(GET t 1 jump)
      list(GET t 2 fix)
      if(NOT ("${jump}" STREQUAL "tensor" AND "${reconstruction}" STREQUAL "limited"))  # quoted: tensor is a variable too
        set(tag ${evolves_J}_${jump}_${metric}_${fix})
        set(others "")  # in one unit: fewer units build faster
        foreach(correction ${${reconstruction}_corrections})
          set(traits "Reconstruction::${reconstruction}, EdgeCorrection::${correction}, ${evolves_J}, PressureJump::${jump}, UpwindMetric::${metric}, EntropyFix::${fix}")
          set(edge_flux "template double edge_flux_part<${traits}, false>(${SWEEP}, const Scratch&)\;")
          if(correction STREQUAL none)
            add_instance(edge_flux_${reconstruction}_${tag} edge_flux_part.hpp "${edge_flux}")
          else()
            string(APPEND others "${edge_flux}\n")
          endif()
          string(APPEND others "template double edge_flux_part<${traits}, true>(${SWEEP}, const Scratch&)\;\n")
        endforeach()
        add_instance(edge_flux_${reconstruction}_${tag}_others edge_flux_part.hpp "${others}")
      endif()
    endforeach()
  endforeach()
endforeach()

foreach(reconstruction constant linear)
  foreach(metric deformed paper)
    foreach(audits false true)
      add_instance(current_flux_${reconstruction}_${metric}_${audits} current_flux_part.hpp
        "template double current_flux_part<Reconstruction::${reconstruction}, UpwindMetric::${metric}, ${audits}>(${SWEEP}, const Scratch&)\;")
    endforeach()
  endforeach()
endforeach()
add_instance(accumulate_update_current accumulate_update_part.hpp
  "template void accumulate_update_part<Formulation::pFJ, GradientCorrection::none, Areas::current>(const Part&, const EdgeArrays&, const NodeLists&, const Rows&, const Coefficients&, const Constraint*, double*, const Scratch&)\;")
set(CAUCHY "")  # in one unit: each is a call of the stress and the same short loop
foreach(material hencky_j2:quadratic:F neo_hookean:quadratic:F neo_hookean:barrier:F neo_hookean:quadratic:J neo_hookean:barrier:J
        mooney_rivlin:quadratic:F mooney_rivlin:barrier:F mooney_rivlin:quadratic:J mooney_rivlin:barrier:J)
  string(REPLACE ":" ";" triple ${material})
  list(GET triple 0 law)
  list(GET triple 1 volumetric)
  list(GET triple 2 isochoric)
  string(APPEND CAUCHY "template PartReport stress_part<Law::${law}, Volumetric::${volumetric}, Isochoric::${isochoric}, Formulation::pFJ, Areas::current>(const Part&, const Rows&, const Coefficients&, const double*)\;\n")
endforeach()
add_instance(cauchy_stress stress_part.hpp "${CAUCHY}")
# Several materials: a density a node, impedances an edge.
foreach(reconstruction constant linear)
  foreach(evolves_J true false)
    foreach(audits false true)
      add_instance(edge_flux_${reconstruction}_${evolves_J}_several_${audits} edge_flux_part.hpp
        "template double edge_flux_part<Reconstruction::${reconstruction}, EdgeCorrection::none, ${evolves_J}, PressureJump::scalar, UpwindMetric::deformed, EntropyFix::none, ${audits}, Materials::several>(${SWEEP}, const Scratch&)\;")
    endforeach()
  endforeach()
endforeach()
foreach(formulation pF pFJ)
  add_instance(accumulate_update_${formulation}_several accumulate_update_part.hpp
    "template void accumulate_update_part<Formulation::${formulation}, GradientCorrection::none, Areas::undeformed, Materials::several>(const Part&, const EdgeArrays&, const NodeLists&, const Rows&, const Coefficients&, const Constraint*, double*, const Scratch&)\;")
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
    if(law MATCHES "hencky_j2|neo_hookean|mooney_rivlin" AND volumetric STREQUAL quadratic AND isochoric STREQUAL F AND NOT formulation STREQUAL pF)
      add_instance(stress_${law}_${volumetric}_${isochoric}_${formulation}_parting stress_part.hpp
        "template PartReport stress_part<${traits}, Areas::undeformed, Parting::energy>(const Part&, const Rows&, const Coefficients&, const double*)\;"
        "template double strain_energy_part<${traits}, Parting::energy>(const Part&, const Rows&, const Coefficients&)\;")
    endif()
  endforeach()
endforeach()
