#[[
What this project asks of FEBio's classes, compiled against the headers that were found.

febio_missing_hooks(include_dir result) gives a list of the hooks that the headers do not have, in words; empty where all
are there. A hook is a virtual function that FEBio calls and the adapter overrides; "override" makes the compiler say
whether it is one. All are asked for at once, and one by one only where that fails.
]]

include(CheckCXXSourceCompiles)

# class | header | hook
set(_febio_hooks
    "FESurfacePairConstraint|FECore/FESurfacePairConstraint.h|int InitEquations(int)"
    "FESurfacePairConstraint|FECore/FESurfacePairConstraint.h|void PrepStep()"
    "FESurfacePairConstraint|FECore/FESurfacePairConstraint.h|void Update(const std::vector<double>&, const std::vector<double>&)"
    "FESurfacePairConstraint|FECore/FESurfacePairConstraint.h|void UpdateIncrements(std::vector<double>&, const std::vector<double>&)"
    "FESurfacePairConstraint|FECore/FESurfacePairConstraint.h|bool Augment(int, const FETimeInfo&)"
    "FEContactInterface|FEBioMech/FEContactInterface.h|void LoadVector(FEGlobalVector&, const FETimeInfo&)"
    "FEContactInterface|FEBioMech/FEContactInterface.h|void StiffnessMatrix(FELinearSystem&, const FETimeInfo&)"
    "FEBiphasicContactSurface|FEBioMix/FEBiphasicContactSurface.h|vec3d GetFluidForce()")

# The source that compiles where the headers have the given hooks.
function(_febio_probe result)
  set(includes "#include <vector>\n")
  set(classes)
  set(number 0)
  foreach(entry IN LISTS ARGN)
    string(REGEX MATCH "^([^|]*)[|]([^|]*)[|](.*)$" entry "${entry}")
    string(APPEND includes "#include <${CMAKE_MATCH_2}>\n")
    string(APPEND classes "struct Probe${number} : ${CMAKE_MATCH_1} { ${CMAKE_MATCH_3} override; };\n")
    math(EXPR number "${number} + 1")
  endforeach()
  set(${result} "${includes}${classes}" PARENT_SCOPE)
endfunction()

# Whether the headers have the given hooks. Remembered for these headers: another FEBio is asked anew.
function(_febio_has_hooks include_dir result)
  _febio_probe(source ${ARGN})
  file(SHA1 "${include_dir}/FECore/FESurfacePairConstraint.h" contents)
  string(SHA1 key "${include_dir} ${contents} ${source}")
  check_cxx_source_compiles("${source}" FEBio_hooks_${key})
  set(${result} "${FEBio_hooks_${key}}" PARENT_SCOPE)
endfunction()

function(febio_missing_hooks include_dir result)
  set(CMAKE_REQUIRED_INCLUDES "${include_dir}")
  set(CMAKE_REQUIRED_QUIET ON)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # compiled, not linked
  if(UNIX AND NOT APPLE)
    set(CMAKE_REQUIRED_DEFINITIONS -DLINUX)
  endif()
  set(missing)
  _febio_has_hooks("${include_dir}" has_all ${_febio_hooks})
  if(NOT has_all)
    foreach(hook IN LISTS _febio_hooks)
      _febio_has_hooks("${include_dir}" has_it "${hook}")
      if(NOT has_it)
        string(REGEX REPLACE "[|].*[|]" ": " hook "${hook}")
        list(APPEND missing "${hook}")
      endif()
    endforeach()
  endif()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction()
