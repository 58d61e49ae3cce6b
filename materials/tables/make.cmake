# SPDX-License-Identifier: Apache-2.0
# cmake -DMAKE=COMMAND -DCOMPILER=CXX -DSOURCES=FILES -DINCLUDE=FOLDERS -DKEPT=FOLDER -DTO=FILE -P make.cmake
#
# Runs COMMAND, a program of the source files FILES, to write the tables to FILE (.inc) and their numbers to
# one beside it (.bin), unless KEPT (of all builds of this tree; may be empty) holds those of these very
# sources and of all that they include, as the compiler says: minutes for the first build, none for the
# others, nor after edits to other headers.
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
set(included ${files})  # tables, of which the numbers count too
list(FILTER included INCLUDE REGEX "_tables[.]inc$")
list(TRANSFORM included REPLACE "[.]inc$" ".bin")
set(all "")
foreach(file ${files} ${included})
  file(SHA256 ${file} sum)
  string(APPEND all ${sum})
endforeach()
string(SHA256 sum "${all}")
string(REGEX REPLACE "[.]inc$" ".bin" numbers ${TO})
set(kept ${KEPT}/${sum})
if(NOT KEPT OR NOT IS_DIRECTORY ${kept})
  execute_process(COMMAND ${MAKE} ${TO} COMMAND_ERROR_IS_FATAL ANY)
  if(KEPT)
    # Whole or not at all: another build may look, or do the same, at the same moment.
    file(GLOB old ${KEPT}/*)
    string(RANDOM LENGTH 8 part)
    file(COPY ${TO} ${numbers} DESTINATION ${KEPT}/${part})
    file(RENAME ${KEPT}/${part} ${kept} RESULT failed)
    if(failed)
      list(APPEND old ${KEPT}/${part})
    endif()
    if(old)
      file(REMOVE_RECURSE ${old})
    endif()
  endif()
else()
  foreach(file ${TO} ${numbers})
    get_filename_component(name ${file} NAME)
    file(COPY_FILE ${kept}/${name} ${file})
  endforeach()
endif()
