#[[
Unity builds: the compiler reads Eigen once for several sources, and instantiates its templates once.

mixcontact_unity_build(target [size]) compiles the sources of a target together, folder by folder, at most `size` at a time
(default 6). A name in an anonymous namespace is therefore unique within its folder. With MIXCONTACT_UNITY_BUILD off each
source is compiled by itself: all of them take two to three times as long, and one that was edited takes a fraction.
]]

option(MIXCONTACT_UNITY_BUILD "Compile several sources of a folder at once" ON)

# GCC inlines further where it sees several sources, and then warns of members of std::optional on paths that do not exist.
function(mixcontact_unity_options target)
  if(MIXCONTACT_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()

function(mixcontact_unity_build target)
  set(size ${ARGV1})
  if(NOT size)
    set(size 6)
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cpp$")
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" ABSOLUTE)
    get_filename_component(folder "${folder}" DIRECTORY)
    file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    math(EXPR count_${folder} "${count_${folder}} + 1")
    math(EXPR batch "(${count_${folder}} - 1) / ${size}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_${batch}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MIXCONTACT_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  mixcontact_unity_options(${target})
endfunction()
