# SPDX-License-Identifier: Apache-2.0
# What other programs get: one header, libmms as a shared library beside that of its tables and as one
# static library, a CMake package and a pkg-config file, all of which may be moved together; and the command.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# One library of the objects of the folders, so that nothing of their division is seen outside.
set(objects "")
foreach(folder base vm lang materials stdlib api)
  list(APPEND objects $<TARGET_OBJECTS:mms_${folder}>)
endforeach()

add_library(mms_lib_shared SHARED ${objects})
target_link_libraries(mms_lib_shared PRIVATE mms_tables)
add_library(mms_lib_static STATIC ${objects} $<TARGET_OBJECTS:mms_tables>)
foreach(form shared static)
  set_target_properties(mms_lib_${form} PROPERTIES OUTPUT_NAME mms LINKER_LANGUAGE CXX)
  target_link_libraries(mms_lib_${form} PRIVATE fmt::fmt Threads::Threads)
  target_include_directories(mms_lib_${form} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS mms_lib_${form} EXPORT mms_${form})
  install(EXPORT mms_${form} NAMESPACE mms:: FILE mms-${form}.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mms)
endforeach()
set_target_properties(mms_lib_static PROPERTIES EXPORT_NAME mms_static)
install(TARGETS mms_tables EXPORT mms_shared)

# Before 1.0 every minor version may break the interface, so it is in the name that programs load.
set(map ${CMAKE_CURRENT_LIST_DIR}/mms.map)
set_target_properties(mms_lib_shared mms_tables PROPERTIES
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set_target_properties(mms_tables PROPERTIES EXPORT_NAME tables)
set_target_properties(mms_lib_shared PROPERTIES EXPORT_NAME mms LINK_DEPENDS ${map} INSTALL_RPATH "$ORIGIN")
target_link_options(mms_lib_shared PRIVATE "-Wl,--version-script=${map}")
if(NOT MMS_SANITIZE)  # a sanitizer's own symbols are in the program that loads the library
  target_link_options(mms_lib_shared PRIVATE -Wl,--no-undefined)
endif()

install(FILES ${PROJECT_SOURCE_DIR}/api/mms.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET mms_images)  # what reads images for scripts
  set_target_properties(mms_images PROPERTIES INSTALL_RPATH "$ORIGIN/..")
  install(TARGETS mms_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/mms)
endif()
file(RELATIVE_PATH libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
foreach(command mms mms-render)  # `mms render` starts the other
  if(TARGET ${command})
    set_target_properties(${command} PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
    install(TARGETS ${command})
  endif()
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/mms)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mms-config.cmake.in mms-config.cmake
  INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(mms-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mms-config.cmake ${PROJECT_BINARY_DIR}/mms-config-version.cmake
        DESTINATION ${package})

file(RELATIVE_PATH MMS_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/mms.pc.in mms.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/mms.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
