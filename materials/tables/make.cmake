# SPDX-License-Identifier: Apache-2.0
# cmake -DMAKE=COMMAND -DSOURCE=ROOT -DKEPT=FOLDER -DTO=FILE -P make.cmake
#
# Runs COMMAND to write the tables to FILE, unless FOLDER (of all builds of this tree; may be empty) holds
# those of these very sources: a minute for the first build, none for the others.
file(GLOB sources ${SOURCE}/materials/*.h ${SOURCE}/materials/tables/*.cpp ${SOURCE}/materials/tables/*.h
     ${SOURCE}/base/*.h)
set(all "")
foreach(source ${sources})
  file(SHA256 ${source} sum)
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
