# Installation, the package for find_package(sesame CONFIG) and the file for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# A static library hands on what it links: the packages that the folders' third-party targets come from, and for
# pkg-config those of them that are more than headers, and Eigen, which a header of ours includes. GMP and
# FLINT, which have no CMake packages, are in sesameConfig.cmake.in.
set(third_party "")
foreach(library IN LISTS SESAME_LIBRARIES)
  get_target_property(linked ${library} LINK_LIBRARIES)
  list(APPEND third_party ${linked})
endforeach()
set(SESAME_FIND_DEPENDENCIES "")
set(SESAME_PC_REQUIRES gmp)
foreach(package IN ITEMS Boost Eigen3 fmt spdlog nlohmann_json simdjson Threads ZLIB)
  if("${third_party}" MATCHES "(^|;)${package}::")
    string(APPEND SESAME_FIND_DEPENDENCIES "find_dependency(${package})\n")
    if(package MATCHES "^(Eigen3|fmt|simdjson|spdlog|ZLIB)$")
      string(TOLOWER " ${package}" module)
      string(APPEND SESAME_PC_REQUIRES "${module}")
    endif()
  endif()
endforeach()

set(SESAME_PC_LIBS "")
foreach(library IN LISTS SESAME_LIBRARIES)
  string(PREPEND SESAME_PC_LIBS " -l${library}")  # a static library stands before those that it uses
endforeach()
string(APPEND SESAME_PC_LIBS " -lflint")

file(RELATIVE_PATH SESAME_PC_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" SESAME_PC_UP "${SESAME_PC_UP}")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sesame)
configure_package_config_file(cmake/sesameConfig.cmake.in ${PROJECT_BINARY_DIR}/cmake/sesameConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/sesameConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(cmake/sesame.pc.in ${PROJECT_BINARY_DIR}/cmake/sesame.pc @ONLY)

install(TARGETS sesame_all ${SESAME_LIBRARIES} EXPORT sesameTargets)
install(EXPORT sesameTargets NAMESPACE sesame:: DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/cmake/sesameConfig.cmake ${PROJECT_BINARY_DIR}/cmake/sesameConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindFLINT.cmake
        DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/cmake/sesame.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${SESAME_BUILD_INCLUDE}/sesame/version.hpp DESTINATION include/sesame)
install(DIRECTORY ${SESAME_FOLDERS} DESTINATION include/sesame
        FILES_MATCHING PATTERN "*.hpp" PATTERN examples EXCLUDE
        REGEX "/page/(src|test|bundle|node_modules)$" EXCLUDE)
install(DIRECTORY replay/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/sesame/examples)
install(FILES LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(SESAME_TOOLS)
  install(TARGETS sesame)
endif()
