# What nobody waits for is compiled in two thirds of the time: arguments, text, pages, tests.
set(BERTH_COLD $<$<CONFIG:Release>:-O1>)
# Sources that name Highway, or a header that does, compile parts of themselves once for each instruction set. Without contraction of
# a * b + c all of these compute the same bits.
set(BERTH_VECTOR -ffp-contract=off)
# Vectors without a fixed size (SVE, RVV) cannot be members of a struct; such machines use NEON. Processors with SSSE3 and without
# SSE4 (2006, 2007) use one lane: a tenth of the time to compile.
set(BERTH_VECTOR_DEFINITIONS "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV|HWY_SSSE3)")
if(BERTH_SCALAR)
  list(APPEND BERTH_VECTOR_DEFINITIONS HWY_COMPILE_ONLY_SCALAR)
endif()
# Nor does GCC in other code where each processor has an instruction for a * b + c, so that ARM64 is as near to x86-64 as can be. (Eigen does.)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  add_compile_options(-ffp-contract=off)
  # Highway 1.0 compiles its NEON with AES, and GCC refuses the constructors of our structs of vectors, which it takes for code without.
  list(APPEND BERTH_VECTOR -march=armv8-a+crypto)
endif()

# berth_sanitize(<target>)
function(berth_sanitize target)
  if(BERTH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${BERTH_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${BERTH_SANITIZE})
  endif()
endfunction()

# berth_precompiled_headers(<name> <options> <header>...): what many sources include, read once for all of them, with what nearly
# all include. GCC 12 takes -O1 or -O3 from these headers, and not from the source's command: each kind of code has its own. Sources
# that name Highway have none: there GCC 12 took a * b + c for one operation, and ended a search in a crash. No source needs them:
# the preset `dev` compiles without.
function(berth_precompiled_headers name options)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_compile_options(${name} PRIVATE ${options})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt)
  berth_sanitize(${name})
  target_precompile_headers(${name} PRIVATE
    <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <optional> <span> <stdexcept> <string> <string_view> <utility> <vector> ${ARGN})
endfunction()
berth_precompiled_headers(berth_precompiled_hot "")
# For those who open scenes and tell of them.
berth_precompiled_headers(berth_precompiled_cold "${BERTH_COLD}" <berth/scene/scene_run.hpp>)

# berth_compile_options(<target> [HOT | COLD | TEST | OWN]): what all of berth is compiled with. HOT: what a loop waits for. COLD: what
# nobody waits for. TEST: COLD, with GoogleTest. OWN: COLD, with precompiled headers of the target's own.
function(berth_compile_options target)
  set(kind HOT ${ARGN})
  list(GET kind -1 kind)
  string(TOLOWER ${kind} precompiled)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
                         $<$<BOOL:${BERTH_WARNINGS_AS_ERRORS}>:-Werror>)
  berth_sanitize(${target})
  if(NOT kind STREQUAL "HOT")
    # GCC 12 takes a moved std::string for one that is too short, where std's headers are precompiled.
    target_compile_options(${target} PRIVATE ${BERTH_COLD}
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow -Wno-restrict>)
  endif()
  if(kind STREQUAL "OWN")
    return()
  endif()
  berth_vector_sources(${target})
  target_precompile_headers(${target} REUSE_FROM berth_precompiled_${precompiled})
  # As their owner has it: the definitions, and code for any address, in a program as well. -fpch-preprocess is for ccache.
  target_compile_options(${target} PRIVATE -fPIC $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()

# berth_vector_sources(<target>): part of berth_compile_options.
function(berth_vector_sources target)
  get_target_property(sources ${target} SOURCES)
  set(vector_sources)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} vectors REGEX "hwy/|-inl.hpp" LIMIT_COUNT 1)
    if(vectors)
      list(APPEND vector_sources ${source})
    endif()
  endforeach()
  if(vector_sources)
    set_source_files_properties(${vector_sources} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
                                COMPILE_OPTIONS "${BERTH_VECTOR}" COMPILE_DEFINITIONS "${BERTH_VECTOR_DEFINITIONS}")
    target_link_libraries(${target} PRIVATE berth::vector)
  endif()
endfunction()

# berth_library(<folder> SOURCES ... DEPENDS ... USES ... [COMPONENT opengl] [COLD]): one target for each folder of src/berth.
# DEPENDS are libraries that its headers need, USES are those that only its sources need. COMPONENT: users get it only where
# they ask find_package for it.
function(berth_library folder)
  cmake_parse_arguments(ARG "COLD" "COMPONENT" "SOURCES;DEPENDS;USES" ${ARGN})
  add_library(berth_${folder} ${ARG_SOURCES})
  add_library(berth::${folder} ALIAS berth_${folder})
  set_target_properties(berth_${folder} PROPERTIES EXPORT_NAME ${folder} VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_include_directories(berth_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(berth_${folder} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_USES})
  if(ARG_COLD)
    berth_compile_options(berth_${folder} COLD)
  else()
    berth_compile_options(berth_${folder})
  endif()
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

# berth_program(<name> SOURCES ... DEPENDS ...): arguments and reports around the work of libraries.
function(berth_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS})
  berth_compile_options(${name} COLD)
endfunction()

# berth_test(<name> SOURCES ... DEPENDS ... [ASAN] [TSAN <filter>] [TIMING] [COST ...]): a GoogleTest program, each of its tests one
# line of ctest. ASAN: the thinned run under AddressSanitizer has it. TSAN: the thinned run under ThreadSanitizer has those of
# its tests in which threads meet, which this filter names. TIMING: its tests hold the clock against a limit, and run apart, with
# the label `timing`. COST: about how many seconds its longest test takes, where that is many; ctest begins with these.
function(berth_test name)
  cmake_parse_arguments(ARG "ASAN;TIMING" "COST;TSAN" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main)
  berth_compile_options(${name} TEST)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  set(labels)
  if(ARG_ASAN)
    add_dependencies(asan_thinned ${name})
    list(APPEND labels asan)
  endif()
  if(ARG_TIMING)
    list(APPEND labels timing)
  endif()
  if(NOT ARG_COST)
    set(ARG_COST 0)
  endif()
  if(NOT ARG_TSAN)
    berth_discover_tests(${name} "*" ${labels})
    return()
  endif()
  add_dependencies(tsan_thinned ${name})
  berth_discover_tests(${name} "${ARG_TSAN}" tsan ${labels})
  if(NOT ARG_TSAN STREQUAL "*")
    berth_discover_tests(${name} "-${ARG_TSAN}" ${labels})
  endif()
endfunction()

# How many times as long a test may take. An emulator takes 50 to 150 times as long, and no test needs the time that it has.
set(BERTH_TEST_PATIENCE 1)
if(CMAKE_CROSSCOMPILING)
  set(BERTH_TEST_PATIENCE 20)
endif()

# berth_discover_tests(<name> <filter> <label>...): of one program; part of berth_test.
function(berth_discover_tests name filter)
  set(label ${ARGN})
  list(JOIN label _ label)  # one word, because gtest_discover_tests takes no list
  math(EXPR timeout_s "300 * ${BERTH_TEST_PATIENCE}")
  gtest_discover_tests(${name} TEST_FILTER "${filter}" DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${timeout_s} COST ${ARG_COST} LABELS "${label}")
endfunction()
