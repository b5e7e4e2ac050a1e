# Compilations go through ccache or sccache where one of them is found and no other launcher was chosen.
option(MIXCONTACT_COMPILER_CACHE "Compile through ccache or sccache where one of them is found" ON)

if(MIXCONTACT_COMPILER_CACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(MIXCONTACT_CACHE_PROGRAM NAMES ccache sccache DOC "Compiler cache")
  mark_as_advanced(MIXCONTACT_CACHE_PROGRAM)
  if(MIXCONTACT_CACHE_PROGRAM)
    message(STATUS "Compiler cache: ${MIXCONTACT_CACHE_PROGRAM}")
    set(CMAKE_CXX_COMPILER_LAUNCHER "${MIXCONTACT_CACHE_PROGRAM}")
  endif()
endif()
