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
foreach(example one_frame two_clocks)
  run(${WORK}/examples/${example} ${WORK}/berth_arm/arm.urdf)
  # Slowed by a sanitizer, an answer may come too late to have a distance.
  if(NOT SANITIZE AND NOT output MATCHES "[0-9]\\.[0-9][0-9][0-9] m")
    message(FATAL_ERROR "${example} printed no distance")
  endif()
endforeach()
# The installed program finds the installed scene.
run(${WORK}/installed/bin/berth demo --picture ${WORK}/pictures)
