#include "apps/berth/command_line.hpp"

int main(int argc, char** argv) { return berth::app::run_command_line(argc, argv); }
