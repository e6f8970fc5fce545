include(CMakePackageConfigHelpers)
get_property(libraries GLOBAL PROPERTY BERTH_LIBRARIES)
install(TARGETS ${libraries} EXPORT berthTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/berth DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
install(EXPORT berthTargets NAMESPACE berth:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/berth)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/berthConfig.cmake
"include(\${CMAKE_CURRENT_LIST_DIR}/BerthDependencies.cmake)
include(\${CMAKE_CURRENT_LIST_DIR}/berthTargets.cmake)
")
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/berthConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/berthConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/berthConfigVersion.cmake
        ${PROJECT_SOURCE_DIR}/cmake/BerthDependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/berth)
