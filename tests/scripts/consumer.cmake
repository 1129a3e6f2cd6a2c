# Installs sesame below WORK_DIR and has tests/scripts/consumer/ use it in the three ways that users have:
# find_package, pkg-config, and add_subdirectory (of which only the headers are compiled: the libraries are the same).
# Run with SOURCE_DIR, BUILD_DIR, WORK_DIR, VERSION, CXX, CXX_FLAGS and BUILD_TYPE.
set(consumer ${CMAKE_CURRENT_LIST_DIR}/consumer)
set(prefix ${WORK_DIR}/prefix)
string(CONCAT expected
  "betti 1 0 0\ntorsion of H1 2\nthe loop bounds: 0, twice the loop bounds: 1\nLaplacian 2 -2\n"
  "\"a\" is a simplex of dimension 2 and \"a.0\" a vertex: only cells of the same type can be identified\n"
  "sesame ${VERSION}\n")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(expect_answer program)
  execute_process(COMMAND ${program} OUTPUT_VARIABLE answer COMMAND_ERROR_IS_FATAL ANY)
  if(NOT answer STREQUAL expected)
    message(FATAL_ERROR "${program} printed\n${answer}instead of\n${expected}")
  endif()
endfunction()

string(TOUPPER "${BUILD_TYPE}" kind)
function(configure directory)  # without optimisation: what is tested is that it is found
  run(${CMAKE_COMMAND} -G Ninja -S ${consumer} -B ${directory} -D CMAKE_CXX_COMPILER=${CXX}
      "-D CMAKE_CXX_FLAGS=${CXX_FLAGS}" -D CMAKE_BUILD_TYPE=${BUILD_TYPE}
      -D CMAKE_CXX_FLAGS_${kind}= ${ARGN})
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/first)
file(RENAME ${WORK_DIR}/first ${prefix})  # an installation may be moved

configure(${WORK_DIR}/package -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/package)
expect_answer(${WORK_DIR}/package/consumer)

file(GLOB_RECURSE pc_file ${prefix}/*/sesame.pc)
cmake_path(GET pc_file PARENT_PATH pc_dir)
set(ENV{PKG_CONFIG_PATH} ${pc_dir})
execute_process(COMMAND pkg-config --cflags --libs sesame OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_STRIP_TRAILING_WHITESPACE)
separate_arguments(flags UNIX_COMMAND "${CXX_FLAGS} ${flags}")
run(${CXX} -std=c++20 ${consumer}/main.cpp -o ${WORK_DIR}/by_pkg_config ${flags})
expect_answer(${WORK_DIR}/by_pkg_config)

configure(${WORK_DIR}/subdirectory -D SESAME_SOURCE_DIR=${SOURCE_DIR})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/subdirectory --target CMakeFiles/consumer.dir/main.cpp.o)
