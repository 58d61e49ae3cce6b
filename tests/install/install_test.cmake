# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DC=... -DCXX=... -DSANITIZE=... -P install_test.cmake
# Installs into a new prefix, moves it, and builds and runs the programs of examples/embed against
# it as an outside project would: the shared and the static library, by CMake and by pkg-config.
cmake_minimum_required(VERSION 3.25)

# run(COMMAND...): its standard output in `out`; the test fails with what it printed if it fails.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${code}\n${out}\n${err}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/before)
file(RENAME ${WORK}/before ${WORK}/prefix)  # nothing in it may know where it was
set(prefix ${WORK}/prefix)

# One header, and nothing of it needs another of ours.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*)
if(NOT headers STREQUAL "mms.h")
  message(FATAL_ERROR "installed headers: ${headers}")
endif()

# The shared library shows the functions of mms.h, all of them, and nothing else.
file(GLOB_RECURSE shared ${prefix}/libmms.so ${prefix}/*/libmms.so)
file(GLOB_RECURSE static ${prefix}/libmms.a)
run(nm -D --defined-only --format=posix ${shared})
string(REGEX MATCHALL "[^\n]+" lines "${out}")
set(shown "")
foreach(line ${lines})
  string(REGEX MATCH "^[^ @]+" symbol "${line}")
  if(NOT symbol MATCHES "^mms[A-Z]" AND NOT symbol MATCHES "^MMS_0")
    message(FATAL_ERROR "libmms.so shows ${symbol}")
  endif()
  list(APPEND shown ${symbol})
endforeach()
file(READ ${prefix}/include/mms.h header)
string(REGEX MATCH "extern \"C\" {.*} /\\* extern \"C\" \\*/" header "${header}")
string(REGEX MATCHALL "mms[A-Z][A-Za-z]*\\(" declared "${header}")
list(REMOVE_DUPLICATES declared)
foreach(name ${declared})
  string(REPLACE "(" "" name ${name})
  if(NOT name IN_LIST shown)
    message(FATAL_ERROR "mms.h declares ${name}, which libmms.so does not show")
  endif()
endforeach()
list(LENGTH declared count)
run(readelf -d ${shared})
if(NOT out MATCHES "SONAME[^\n]*libmms\\.so\\.[0-9]+\\.[0-9]+\\]")
  message(FATAL_ERROR "no versioned soname:\n${out}")
endif()
foreach(foreign embree OpenImageIO assimp)
  if(out MATCHES "NEEDED[^\n]*${foreign}")
    message(FATAL_ERROR "libmms.so needs ${foreign}")
  endif()
endforeach()
# The tables are there once for all who load them.
foreach(program ${shared} ${prefix}/bin/mms)
  run(readelf -d ${program})
  if(NOT out MATCHES "NEEDED[^\n]*libmms_tables\\.so\\.")
    message(FATAL_ERROR "${program} does not load libmms_tables.so:\n${out}")
  endif()
endforeach()
if(EXISTS ${prefix}/bin/mms-render)  # it starts quickly
  run(readelf -d ${prefix}/bin/mms-render)
  if(out MATCHES "NEEDED[^\n]*OpenImageIO")
    message(FATAL_ERROR "mms-render loads OpenImageIO before it is needed")
  endif()
endif()

set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
cmake_path(GET shared PARENT_PATH lib)
set(env ${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${lib}")

# The C++ program, by find_package.
file(COPY ${SOURCE}/examples/embed DESTINATION ${WORK})
run(${CMAKE_COMMAND} -S ${WORK}/embed -B ${WORK}/embed/build -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${flags} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/embed/build)
foreach(program marble marble_static)
  run(${WORK}/embed/build/${program})
  message("${program} by find_package: ${out}")
endforeach()

# The C program, by pkg-config and the compiler alone.
run(${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${lib}/pkgconfig" pkg-config --cflags --libs mms)
separate_arguments(options UNIX_COMMAND "${out}")
run(${C} -std=c99 -Wall -Wextra -Werror ${flags} ${WORK}/embed/marble.c -o ${WORK}/c_shared ${options} -lm)
run(${env} ${WORK}/c_shared)
message("C by pkg-config, shared:\n${out}")
run(${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${lib}/pkgconfig" pkg-config --static --cflags --libs mms)
string(REPLACE "-lmms" "${static}" out "${out}")  # else the linker takes the shared one beside it
separate_arguments(options UNIX_COMMAND "${out}")
run(${C} -std=c99 -Wall -Wextra -Werror ${flags} ${WORK}/embed/marble.c -o ${WORK}/c_static ${options} -lm)
run(readelf -d ${WORK}/c_static)
if(out MATCHES "NEEDED[^\n]*libmms")
  message(FATAL_ERROR "the static program needs libmms.so")
endif()
run(${WORK}/c_static)

# The command came along.
run(${prefix}/bin/mms check ${SOURCE}/examples/marble.mms)
message("${count} functions; ${prefix} is good")
