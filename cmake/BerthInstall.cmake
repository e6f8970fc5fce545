# find_package(berth) gives berth::berth, all that computes on the processor, and berth::io;
# find_package(berth COMPONENTS opengl) berth::opengl as well.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/berth)
get_property(core GLOBAL PROPERTY BERTH_LIBRARIES_OF_core)
get_property(opengl GLOBAL PROPERTY BERTH_LIBRARIES_OF_opengl)
# As long as the pipeline itself is linked with OpenGL, nobody can do without.
get_target_property(pipeline_libraries berth_pipeline LINK_LIBRARIES)
if("berth::opengl" IN_LIST pipeline_libraries)
  set(BERTH_CORE_NEEDS_OPENGL ON)
  list(APPEND core ${opengl})
else()
  set(BERTH_CORE_NEEDS_OPENGL OFF)
  install(TARGETS ${opengl} EXPORT berthOpenglTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT berthOpenglTargets NAMESPACE berth:: DESTINATION ${package})
endif()
install(TARGETS ${core} EXPORT berthTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT berthTargets NAMESPACE berth:: DESTINATION ${package})

# When it is installed, since an edit of a header does not configure anew.
install(CODE "
  include(${PROJECT_SOURCE_DIR}/cmake/PublicHeaders.cmake)
  berth_with_includes(headers ${PROJECT_SOURCE_DIR}/src \${BERTH_PUBLIC_HEADERS})
  foreach(header IN LISTS headers)
    cmake_path(GET header PARENT_PATH folder)
    file(INSTALL ${PROJECT_SOURCE_DIR}/src/\${header} DESTINATION \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/\${folder})
  endforeach()")

configure_file(${PROJECT_SOURCE_DIR}/cmake/berthConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/berthConfig.cmake @ONLY)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/berthConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/berthConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/berthConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/BerthDependencies.cmake ${PROJECT_SOURCE_DIR}/cmake/BerthOpenglDependencies.cmake
        DESTINATION ${package})
