#pragma once

#include "apps/berth/arguments.hpp"

namespace berth::app {

/// Each runs one command. Throws std::exception where it cannot be done, with the message for the
/// user, and Interrupted where the user stopped it.
void run_command(const RunArguments& arguments);
void record_command(const RecordArguments& arguments);
void replay_command(const ReplayArguments& arguments);
void filter_command(const FilterArguments& arguments);
void calibrate_command(const CalibrateArguments& arguments);
void evaluate_command(const EvaluateArguments& arguments);
void view_command(const ViewArguments& arguments);
void demo_command(const DemoArguments& arguments);
void init_command(const InitArguments& arguments);
void doctor_command(const DoctorArguments& arguments);
void schema_command(const SchemaArguments& arguments);

}  // namespace berth::app
