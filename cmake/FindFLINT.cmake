# FLINT, the fast library for number theory, which has neither a CMake package nor, before version 3, a pkg-config file.
# Defines FLINT::FLINT, FLINT_FOUND and FLINT_VERSION.
find_path(FLINT_INCLUDE_DIR flint/fmpz_mat.h)
find_library(FLINT_LIBRARY flint)
mark_as_advanced(FLINT_INCLUDE_DIR FLINT_LIBRARY)

if(FLINT_INCLUDE_DIR)
  file(STRINGS ${FLINT_INCLUDE_DIR}/flint/flint.h flint_version_line REGEX "define FLINT_VERSION ")
  string(REGEX MATCH "[0-9]+\\.[0-9.]+" FLINT_VERSION "${flint_version_line}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FLINT REQUIRED_VARS FLINT_LIBRARY FLINT_INCLUDE_DIR VERSION_VAR FLINT_VERSION)

if(FLINT_FOUND AND NOT TARGET FLINT::FLINT)
  add_library(FLINT::FLINT UNKNOWN IMPORTED)
  set_target_properties(FLINT::FLINT PROPERTIES IMPORTED_LOCATION ${FLINT_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${FLINT_INCLUDE_DIR})
endif()
