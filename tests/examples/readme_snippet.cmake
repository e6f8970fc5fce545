# The README's C++ as a program: its includes, then the rest inside main(). It has whatever joints the robot has.
file(READ ${PROJECT_SOURCE_DIR}/README.md readme)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/README.md)
if(NOT readme MATCHES "\n```cpp\n(([^`]|`[^`])*)\n```\n")
  message(FATAL_ERROR "README.md has no block of C++")
endif()
set(snippet "${CMAKE_MATCH_1}\n")
string(REGEX MATCHALL "#include [^\n]*\n" includes "${snippet}")
string(REGEX REPLACE "#include [^\n]*\n" "" body "${snippet}")
string(JOIN "" includes ${includes})
file(CONFIGURE OUTPUT readme_snippet.cpp @ONLY CONTENT "// Made from README.md.
@includes@
int main() {
@body@}
")
berth_program(readme_snippet SOURCES ${CMAKE_CURRENT_BINARY_DIR}/readme_snippet.cpp DEPENDS berth::berth)
# It has to say itself what it includes.
set_target_properties(readme_snippet PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
# It loads robot.urdf; package://berth_arm/ is a folder of that name beside it.
file(COPY ${PROJECT_SOURCE_DIR}/data/bundled/arm/ DESTINATION ${CMAKE_CURRENT_BINARY_DIR}/snippet/berth_arm)
file(COPY_FILE ${PROJECT_SOURCE_DIR}/data/bundled/arm/arm.urdf ${CMAKE_CURRENT_BINARY_DIR}/snippet/robot.urdf ONLY_IF_DIFFERENT)
add_test(NAME Readme.SnippetRuns COMMAND readme_snippet WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/snippet)
set_tests_properties(Readme.SnippetRuns PROPERTIES PASS_REGULAR_EXPRESSION "[0-9]\\.[0-9][0-9][0-9] m" TIMEOUT 60)
