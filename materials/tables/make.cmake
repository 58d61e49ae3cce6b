# SPDX-License-Identifier: Apache-2.0
# cmake -DMAKE=COMMAND -DCOMPILER=CXX -DSOURCES=FILES -DINCLUDE=FOLDERS -DKEPT=FOLDER -DTO=FILE -P make.cmake
#
# Runs COMMAND, a program of the source files FILES, to write the tables to FILE, unless KEPT (of all builds
# of this tree; may be empty) holds those of these very sources and of all that they include, as the compiler
# says: minutes for the first build, none for the others, nor after edits to other headers.
list(FILTER SOURCES INCLUDE REGEX "[.]cpp$")
foreach(folder ${INCLUDE})
  list(APPEND search -I${folder})
endforeach()
execute_process(COMMAND ${COMPILER} -std=c++20 -MM ${search} ${SOURCES}
                OUTPUT_VARIABLE rules COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[^ \n]+\\.o:|\\\\\n" " " files "${rules}")
separate_arguments(files UNIX_COMMAND "${files}")
list(SORT files)
list(REMOVE_DUPLICATES files)
set(all "")
foreach(file ${files})
  file(SHA256 ${file} sum)
  string(APPEND all ${sum})
endforeach()
string(SHA256 sum "${all}")
set(kept ${KEPT}/${sum}.inc)
if(NOT KEPT OR NOT EXISTS ${kept})
  execute_process(COMMAND ${MAKE} ${TO} COMMAND_ERROR_IS_FATAL ANY)
  if(KEPT)
    # Whole or not at all: another build may look at the same moment.
    string(RANDOM LENGTH 8 part)
    file(COPY_FILE ${TO} ${KEPT}/${part})
    file(GLOB old ${KEPT}/*.inc)
    if(old)
      file(REMOVE ${old})
    endif()
    file(RENAME ${KEPT}/${part} ${kept})
  endif()
else()
  file(COPY_FILE ${kept} ${TO})
endif()
