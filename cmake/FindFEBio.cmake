#[[
Finds the headers and libraries of an FEBio installation.

Where it looks, in this order:
  FEBIO_ROOT (CMake cache, then environment; where it is given, nowhere else), ~/febio4, /usr/local/febio4,
  /opt/febio4, ~/FEBioStudio, ~/FEBioStudio2, /opt/FEBioStudio, and their sub-directories febio and sdk.
Layouts: an installation prefix (bin/, include/FECore, lib/) and FEBio's own SDK (sdk/include/FECore, sdk/lib).

Gives:
  FEBio_FOUND, FEBio_ROOT_DIR, FEBio_EXECUTABLE (may be NOTFOUND)
  FEBio_SDK_VERSION  the version that a plugin reports to febio4, from FECore/version.h
  FEBio_VERSION      the release the headers belong to, from FEBioLib/version.h (empty where that is not installed)
  FEBio::FECore, FEBio::FEBioMech, FEBio::FEBioMix  imported targets
  FEBio::FEBioPlot, FEBio::FEBioXML, FEBio::FEBioLib  imported targets where the SDK has them
What counts is not a number but what the headers offer: an FEBio without the hooks of FEBioHooks.cmake is an error that
names them, and one that has them is taken, with a notice where it is not the tested release.
]]

set(FEBio_TESTED_VERSION 4.11)
include(FEBioHooks)

set(FEBIO_ROOT "" CACHE PATH "FEBio installation prefix or SDK (empty: environment, then usual places)")

if(FEBIO_ROOT)
  set(_febio_bases "${FEBIO_ROOT}")
elseif(DEFINED ENV{FEBIO_ROOT} AND NOT "$ENV{FEBIO_ROOT}" STREQUAL "")
  set(_febio_bases "$ENV{FEBIO_ROOT}")
else()
  set(_febio_bases "$ENV{HOME}/febio4" /usr/local/febio4 /opt/febio4 "$ENV{HOME}/FEBioStudio" "$ENV{HOME}/FEBioStudio2"
                   /opt/FEBioStudio)
endif()

set(_febio_roots)
foreach(_base IN LISTS _febio_bases)
  file(TO_CMAKE_PATH "${_base}" _base)
  list(APPEND _febio_roots "${_base}" "${_base}/sdk" "${_base}/febio" "${_base}/febio/sdk")
endforeach()

# Searched anew in every configuration, so that a changed FEBIO_ROOT takes effect without emptying the cache.
unset(FEBio_INCLUDE_DIR CACHE)
find_path(FEBio_INCLUDE_DIR FECore/version.h PATHS ${_febio_roots} PATH_SUFFIXES include NO_DEFAULT_PATH)
mark_as_advanced(FEBio_INCLUDE_DIR)

set(_febio_missing)
set(FEBio_ROOT_DIR)
if(FEBio_INCLUDE_DIR)
  get_filename_component(FEBio_ROOT_DIR "${FEBio_INCLUDE_DIR}" DIRECTORY)
else()
  list(APPEND _febio_missing "the header FECore/version.h")
endif()

foreach(_name IN ITEMS FECore FEBioMech FEBioMix FEBioPlot FEBioXML FEBioLib)
  string(TOLOWER "${_name}" _lname)
  unset(FEBio_${_name}_LIBRARY CACHE)
  set(_febio_lib_dirs)
  if(FEBio_ROOT_DIR)
    set(_febio_lib_dirs "${FEBio_ROOT_DIR}" "${FEBio_ROOT_DIR}/..")
  endif()
  find_library(
    FEBio_${_name}_LIBRARY
    NAMES ${_lname}
    PATHS ${_febio_lib_dirs}
    PATH_SUFFIXES lib lib/Release
    NO_DEFAULT_PATH)
  mark_as_advanced(FEBio_${_name}_LIBRARY)
  if(FEBio_INCLUDE_DIR AND _name MATCHES "^(FECore|FEBioMech|FEBioMix)$")
    if(NOT FEBio_${_name}_LIBRARY)
      list(APPEND _febio_missing "the library ${_lname}")
    endif()
    if(NOT IS_DIRECTORY "${FEBio_INCLUDE_DIR}/${_name}")
      list(APPEND _febio_missing "the headers of ${_name}")
    endif()
  endif()
endforeach()

unset(FEBio_EXECUTABLE CACHE)
if(FEBio_ROOT_DIR)
  find_program(FEBio_EXECUTABLE febio4 PATHS "${FEBio_ROOT_DIR}/bin" "${FEBio_ROOT_DIR}/../bin" NO_DEFAULT_PATH)
endif()
mark_as_advanced(FEBio_EXECUTABLE)

# The numbers behind the given macros of a header, joined with dots; empty where the header is missing.
function(_febio_read_version header result)
  set(numbers)
  if(EXISTS "${header}")
    foreach(macro IN LISTS ARGN)
      file(STRINGS "${header}" line REGEX "^#define[ \t]+${macro}[ \t]")
      if(line MATCHES "${macro}[ \t]+([0-9]+)")
        list(APPEND numbers "${CMAKE_MATCH_1}")
      endif()
    endforeach()
  endif()
  list(JOIN numbers "." version)
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

set(FEBio_FOUND FALSE)
set(_febio_notice_file "${PROJECT_BINARY_DIR}/febio-not-found.txt")

if(_febio_missing)
  if(FEBio_INCLUDE_DIR)
    list(JOIN _febio_missing ", " _febio_what)
    set(_febio_what "an FEBio installation stands at ${FEBio_ROOT_DIR}, but these parts of it are missing: ${_febio_what}")
  else()
    list(JOIN _febio_bases ", " _febio_where)
    set(_febio_what "no FECore/version.h in an include directory under any of: ${_febio_where}")
  endif()
  string(
    CONCAT _febio_notice
           "FEBio was not found: ${_febio_what}. The plugin library is left out, and so is everything that runs a model "
           "in febio4; the contact core and its unit tests are built all the same. To get the plugin, install FEBio "
           "${FEBio_TESTED_VERSION} with its SDK (headers and libraries) from its own download page, or build it "
           "after its own guide, and set FEBIO_ROOT to the directory that holds bin, include and lib.")
  message(NOTICE "${_febio_notice}")
  file(WRITE "${_febio_notice_file}" "${_febio_notice}\n")
  if(FEBio_FIND_REQUIRED)
    message(FATAL_ERROR "FEBio is required here.")
  endif()
  return()
endif()
file(REMOVE "${_febio_notice_file}")

_febio_read_version("${FEBio_INCLUDE_DIR}/FECore/version.h" FEBio_SDK_VERSION FE_SDK_MAJOR_VERSION FE_SDK_SUB_VERSION
                    FE_SDK_SUBSUB_VERSION)
_febio_read_version("${FEBio_INCLUDE_DIR}/FEBioLib/version.h" FEBio_VERSION VERSION SUBVERSION SUBSUBVERSION)

set(_febio_release "${FEBio_VERSION}")
if(NOT _febio_release)
  set(_febio_release "(release not stated: no FEBioLib/version.h)")
endif()
message(STATUS "FEBio ${_febio_release}, plugin SDK ${FEBio_SDK_VERSION}: ${FEBio_ROOT_DIR}")

febio_missing_hooks("${FEBio_INCLUDE_DIR}" _febio_missing_hooks)
if(_febio_missing_hooks)
  list(JOIN _febio_missing_hooks "\n  " _febio_what)
  message(
    FATAL_ERROR
      "This FEBio is not supported: FEBio ${_febio_release}, plugin SDK ${FEBio_SDK_VERSION}, at ${FEBio_ROOT_DIR}. Its "
      "classes lack what this contact needs of them:\n  ${_febio_what}\nRelease 4.11 is the first that has it all. Set "
      "FEBIO_ROOT to FEBio ${FEBio_TESTED_VERSION} or newer, or leave the plugin out with -DMIXCONTACT_BUILD_PLUGIN=OFF.")
endif()
if(NOT FEBio_VERSION MATCHES "^${FEBio_TESTED_VERSION}(\\.|$)" OR NOT FEBio_SDK_VERSION VERSION_EQUAL 4.10)
  message(NOTICE "FEBio ${_febio_release} with plugin SDK ${FEBio_SDK_VERSION} has what this contact needs, but the plugin "
                 "was not tested with it: it was with release ${FEBio_TESTED_VERSION}, whose plugin SDK is 4.10.0. "
                 "`scripts/mixcontact test --all` tests it.")
endif()

foreach(_name IN ITEMS FECore FEBioMech FEBioMix FEBioPlot FEBioXML FEBioLib)
  if(FEBio_${_name}_LIBRARY AND NOT TARGET FEBio::${_name})
    add_library(FEBio::${_name} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(
      FEBio::${_name}
      PROPERTIES IMPORTED_LOCATION "${FEBio_${_name}_LIBRARY}"
                 # An imported target's include directories are system ones: no warnings from FEBio's headers.
                 INTERFACE_INCLUDE_DIRECTORIES "${FEBio_INCLUDE_DIR}")
    if(UNIX AND NOT APPLE)
      set_property(TARGET FEBio::${_name} PROPERTY INTERFACE_COMPILE_DEFINITIONS LINUX)
    endif()
  endif()
endforeach()
foreach(_name IN ITEMS FEBioMech FEBioMix)
  set_property(TARGET FEBio::${_name} APPEND PROPERTY INTERFACE_LINK_LIBRARIES FEBio::FECore)
endforeach()
set(FEBio_FOUND TRUE)
