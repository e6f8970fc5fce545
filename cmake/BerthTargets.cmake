# berth_compile_options(<target>): what all of berth is compiled with. Comes after the target's sources.
function(berth_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
                         $<$<BOOL:${BERTH_WARNINGS_AS_ERRORS}>:-Werror>)
  if(BERTH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${BERTH_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${BERTH_SANITIZE})
  endif()
  berth_join_sources(${target})
endfunction()

# berth_cold_code(<target>): arguments, text and pages, which nobody waits for. Compiles in two thirds of the time.
function(berth_cold_code target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# berth_join_sources(<target>): with BERTH_JOIN_SOURCES its sources are compiled as one, which reads their headers once. Those
# that compile themselves once for each instruction set stay alone, unless there is one instruction set.
function(berth_join_sources target)
  if(NOT BERTH_JOIN_SOURCES)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  # Of what a source keeps to itself, as if its neighbours and a header's readers saw it.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} repeated REGEX "hwy/foreach_target.h" LIMIT_COUNT 1)
    if(repeated AND NOT BERTH_SCALAR)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# berth_library(<folder> SOURCES ... DEPENDS ... USES ... [COMPONENT opengl]): one target for each folder of src/berth.
# DEPENDS are libraries that its headers need, USES are those that only its sources need. COMPONENT: users get it only where
# they ask find_package for it.
function(berth_library folder)
  cmake_parse_arguments(ARG "" "COMPONENT" "SOURCES;DEPENDS;USES" ${ARGN})
  add_library(berth_${folder} ${ARG_SOURCES})
  add_library(berth::${folder} ALIAS berth_${folder})
  set_target_properties(berth_${folder} PROPERTIES EXPORT_NAME ${folder} VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_include_directories(berth_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(berth_${folder} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_USES})
  berth_compile_options(berth_${folder})
  if(BUILD_SHARED_LIBS)
    # By the linker, so that objects are the same for both kinds of library. Installed, the libraries lie in one folder.
    set(map ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map)
    target_link_options(berth_${folder} PRIVATE LINKER:--version-script=${map})
    set_target_properties(berth_${folder} PROPERTIES DEFINE_SYMBOL "" LINK_DEPENDS ${map} INSTALL_RPATH "$ORIGIN")
  endif()
  if(NOT ARG_COMPONENT)
    set(ARG_COMPONENT core)
  endif()
  set_property(GLOBAL APPEND PROPERTY BERTH_LIBRARIES_OF_${ARG_COMPONENT} berth_${folder})
endfunction()

# berth_program(<name> SOURCES ... DEPENDS ...)
function(berth_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS})
  berth_compile_options(${name})
endfunction()

# berth_test(<name> SOURCES ... DEPENDS ... SANITIZE ...): a GoogleTest program, each of its tests one line of ctest.
# SANITIZE: the presets (asan, tsan, scalar) whose thinned run has it: the target asan_thinned and so on, the label in ctest.
function(berth_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;SANITIZE" ${ARGN})
  berth_program(${name} SOURCES ${ARG_SOURCES} DEPENDS ${ARG_DEPENDS} GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  foreach(preset ${ARG_SANITIZE})
    if(NOT TARGET ${preset}_thinned)
      add_custom_target(${preset}_thinned)
    endif()
    add_dependencies(${preset}_thinned ${name})
  endforeach()
  list(JOIN ARG_SANITIZE _ label)  # one word, because gtest_discover_tests takes no list
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS "${label}")
endfunction()

# berth_vector_code(<folder>): its sources compile parts of themselves once for each instruction set (Highway). Without
# contraction of a * b + c all of them compute the same bits. Vectors without a fixed size (SVE, RVV) cannot be members of
# a struct; such machines use NEON. Processors with SSSE3 and without SSE4 (2006, 2007) use one lane: a tenth of the time to compile.
function(berth_vector_code folder)
  target_link_libraries(berth_${folder} PRIVATE berth::vector)
  target_compile_options(berth_${folder} PRIVATE -ffp-contract=off)
  target_compile_definitions(berth_${folder} PRIVATE
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV|HWY_SSSE3)"
    $<$<BOOL:${BERTH_SCALAR}>:HWY_COMPILE_ONLY_SCALAR>)
endfunction()
