#[[
Programs of unit tests: one for each folder, and one ctest entry for each file.

mixcontact_unit_tests(program SOURCES test_*.cpp ... LIBRARIES ... [PREFIX text] [SIZE n]) makes the program out of the files.
Each file becomes the test suite of its name, so that `program --run_test=test_name` runs it alone, and gets the ctest entry
`<PREFIX>test_name`.

At most SIZE files (default 6) are compiled at once, through a unit in the build directory that includes them. The unit
includes what they include first, and then each file within the namespace of its suite: files may use the same names.
]]

set(_mixcontact_unit_template "${CMAKE_CURRENT_LIST_DIR}/unit_tests.cpp.in")

# The #include lines of some files, each once, where the compiler has the header.
function(_mixcontact_included_headers result)
  set(lines)
  foreach(source IN LISTS ARGN)
    file(STRINGS "${source}" found REGEX "^#include ")
    list(APPEND lines ${found})
  endforeach()
  list(REMOVE_DUPLICATES lines)
  set(text)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include (.*)$" "\\1" header "${line}")
    string(APPEND text "#if __has_include(${header})\n#include ${header}\n#endif\n")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Writes a unit that holds some files of tests.
function(_mixcontact_write_unit unit)
  _mixcontact_included_headers(HEADERS ${ARGN})
  set(SUITES)
  foreach(source IN LISTS ARGN)
    get_filename_component(name "${source}" NAME_WE)
    string(APPEND SUITES "BOOST_AUTO_TEST_SUITE(${name})\n#include \"${source}\"\nBOOST_AUTO_TEST_SUITE_END()\n\n")
  endforeach()
  configure_file("${_mixcontact_unit_template}" "${unit}" @ONLY)
endfunction()

function(mixcontact_unit_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PREFIX;SIZE" "SOURCES;LIBRARIES")
  if(NOT MIXCONTACT_UNITY_BUILD)
    set(arg_SIZE 1)
  elseif(NOT arg_SIZE)
    set(arg_SIZE 6)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${arg_SOURCES}) # their #include lines stand in the units

  set(units)
  set(rest ${arg_SOURCES})
  while(rest)
    list(SUBLIST rest 0 ${arg_SIZE} batch)
    list(REMOVE_ITEM rest ${batch})
    list(LENGTH units number)
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/${program}_${number}.cpp")
    _mixcontact_write_unit("${unit}" ${batch})
    list(APPEND units "${unit}")
  endwhile()

  add_executable(${program} ${units})
  target_include_directories(${program} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
  target_link_libraries(${program} PRIVATE unit_test_main ${arg_LIBRARIES} mixcontact_options)
  mixcontact_unity_options(${program})
  # The core under test is optimised; its tests compile in four fifths of the time at -O1 and take no longer.
  target_compile_options(${program} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-O1>)

  foreach(source IN LISTS arg_SOURCES)
    get_filename_component(name "${source}" NAME_WE)
    add_test(NAME ${arg_PREFIX}${name} COMMAND ${program} --run_test=${name} --color_output=no)
    # Tests run side by side; OpenMP's threads would wait for each other by spinning. test_parallel sets their number.
    set_tests_properties(${arg_PREFIX}${name} PROPERTIES TIMEOUT 1800 ENVIRONMENT OMP_NUM_THREADS=1)
  endforeach()
endfunction()
