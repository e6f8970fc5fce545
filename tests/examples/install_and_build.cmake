function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "exit status ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
set(flags)
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${WORK}/examples -G ${GENERATOR} ${flags}
    -DCMAKE_PREFIX_PATH=${WORK}/installed)
run(${CMAKE_COMMAND} --build ${WORK}/examples)
# package://berth_arm/ is a folder of that name above the URDF.
file(COPY ${SOURCE}/data/bundled/arm/ DESTINATION ${WORK}/berth_arm)
foreach(example one_frame running_robot two_clocks)
  # On a busy machine, or slowed by a sanitizer, answers may come too late to have a distance.
  foreach(attempt RANGE 1 5)
    run(${WORK}/examples/${example} ${WORK}/berth_arm/arm.urdf)
    if(SANITIZE OR output MATCHES "[0-9]\\.[0-9][0-9][0-9] m")
      break()
    elseif(attempt EQUAL 5)
      message(FATAL_ERROR "${example} printed no distance")
    endif()
  endforeach()
endforeach()
# The installed program finds the installed scene.
run(${WORK}/installed/bin/berth demo --picture ${WORK}/pictures)

# Each installed header compiles by itself, as the first line of a user's source.
file(GLOB_RECURSE headers RELATIVE ${WORK}/installed/include ${WORK}/installed/include/berth/*.hpp)
# Those of -inl.hpp are parts of others.
list(FILTER headers EXCLUDE REGEX "-inl\\.hpp$")
set(sources)
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  file(WRITE ${WORK}/headers/${name}.cpp "#include \"${header}\"\n")
  list(APPEND sources ${name}.cpp)
endforeach()
list(JOIN sources " " sources)
file(WRITE ${WORK}/headers/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)
project(berth_headers LANGUAGES CXX)
find_package(berth REQUIRED COMPONENTS opengl scene)
add_library(headers OBJECT ${sources})
target_link_libraries(headers PRIVATE berth::berth berth::files berth::opengl berth::scene)
target_compile_options(headers PRIVATE -Wall -Wextra -Werror)
")
run(${CMAKE_COMMAND} -S ${WORK}/headers -B ${WORK}/headers/build -G ${GENERATOR} ${flags}
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_PREFIX_PATH=${WORK}/installed)
run(${CMAKE_COMMAND} --build ${WORK}/headers/build)

# A component that there is not is refused, and said so.
file(WRITE ${WORK}/component/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)
project(berth_component LANGUAGES CXX)
find_package(berth REQUIRED COMPONENTS vulkan)
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/component -B ${WORK}/component/build -G ${GENERATOR}
                        -DCMAKE_PREFIX_PATH=${WORK}/installed
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0 OR NOT output MATCHES "berth has no component vulkan")
  message(FATAL_ERROR "a component that there is not: exit status ${result}\n${output}")
endif()
