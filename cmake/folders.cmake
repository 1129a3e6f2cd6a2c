# How a folder becomes a library, and how everything here is compiled.

# <build>/include/sesame looks like <prefix>/include/sesame after an installation, so that
# `#include <sesame/engine/engine.hpp>` means the same in a project that takes sesame by add_subdirectory.
set(SESAME_BUILD_INCLUDE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${SESAME_BUILD_INCLUDE}/sesame)
configure_file(${PROJECT_SOURCE_DIR}/sparse/version.hpp.in ${SESAME_BUILD_INCLUDE}/sesame/version.hpp @ONLY)
foreach(folder IN LISTS SESAME_FOLDERS)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${SESAME_BUILD_INCLUDE}/sesame/${folder} SYMBOLIC)
endforeach()

function(sesame_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-qual -Wformat=2 -Wundef
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op>
    # g++ 12 sees overlapping copies in `"text" + std::string` where there are none (GCC bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<BOOL:${SESAME_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# sesame_folder(name left sources...): the library of one folder, which links only the folder to its left.
function(sesame_folder name left)
  add_library(sesame_${name} ${ARGN})
  add_library(sesame::${name} ALIAS sesame_${name})
  set_target_properties(sesame_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(sesame_${name} PUBLIC cxx_std_20)
  target_include_directories(sesame_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${SESAME_BUILD_INCLUDE}>
    $<INSTALL_INTERFACE:include> $<INSTALL_INTERFACE:include/sesame>)
  sesame_warnings(sesame_${name})
  if(left)
    target_link_libraries(sesame_${name} PUBLIC sesame_${left})
  endif()
endfunction()
