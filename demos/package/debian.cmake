# Debian packages by `cpack` in the build folder: carom, the program with its scenes, and libcarom-dev, the static
# libraries with their headers. Needs dpkg-dev, which finds out what the program's libraries are called.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME carom)
set(CPACK_PACKAGE_CONTACT "Carom maintainers <carom@packages.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME carom)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# One of these makes the GL context when frames are drawn; what draws nothing runs without.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Simulates scenes of rigid bodies by impulses, with exact closest features
between convex polyhedra and exact times of impact, and draws them to PNG
frames on machines without display or graphics card.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcarom-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "carom (= ${PROJECT_VERSION}), libeigen3-dev, libqhull-dev, libpng-dev, libcairo2-dev, pkgconf | pkg-config")
if(ISAL_FOUND)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libisal-dev")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries, headers, and files for CMake and pkg-config of Carom's
engine of rigid bodies and of its off-screen renderer.")

# Debian wants a copyright, a changelog and compressed pages of each package.
foreach(component program development)
  string(TOUPPER ${component} COMPONENT)
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright DESTINATION ${documents} COMPONENT ${component})
endforeach()
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian-documents.cmake)
include(CPack)
