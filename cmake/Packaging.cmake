#[[
What `cmake --install` puts into a prefix and CPack into an archive, beside the plugin's target FEBioMixtureContact:
  lib/     the plugin
  share/FEBioMixtureContact/  models, documentation, licence, citation, and a febio.xml that imports the plugin

The archive is named by the plugin's version, by FEBio's release and by that of its SDK: febio4 loads no other SDK, and the
plugin lets no other release load it.
]]

include(GNUInstallDirs)
set(share "${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}")

install(TARGETS FEBioMixtureContact LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/models" DESTINATION ${share})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION ${share})
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/LICENSE"
              "${PROJECT_SOURCE_DIR}/CITATION.cff" DESTINATION ${share})

set(package "${PROJECT_NAME}-${PROJECT_VERSION}-febio")
if(FEBio_VERSION) # an SDK need not say it
  string(APPEND package "-${FEBio_VERSION}")
endif()
string(APPEND package "-sdk-${FEBio_SDK_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")

# febio.xml names the plugin by its full path; that of an archive, whose place is not known, from the archive's directory.
set(plugin_file "${CMAKE_INSTALL_LIBDIR}/${CMAKE_SHARED_LIBRARY_PREFIX}FEBioMixtureContact${CMAKE_SHARED_LIBRARY_SUFFIX}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/install_febio_xml.cmake.in" install_febio_xml.cmake @ONLY)
install(SCRIPT "${CMAKE_CURRENT_BINARY_DIR}/install_febio_xml.cmake")

set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_NAME ${PROJECT_NAME})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_FILE_NAME "${package}")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
include(CPack)
