# find_package(berth) gives berth::berth and berth::files; find_package(berth COMPONENTS scene) berth::scene as well, which runs
# scene files.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/berth)
foreach(component core scene)
  get_property(libraries GLOBAL PROPERTY BERTH_LIBRARIES_OF_${component})
  if(libraries)
    install(TARGETS ${libraries} EXPORT berth_${component}_targets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT berth_${component}_targets NAMESPACE berth:: DESTINATION ${package})
  endif()
endforeach()

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
              ${PROJECT_SOURCE_DIR}/cmake/BerthDependencies.cmake
        DESTINATION ${package})
