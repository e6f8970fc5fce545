// A URDF whose links form a ring leaves urdfdom's shared pointers holding each other: the leak of a
// refused file, which the tests of such files would report.
extern "C" const char* __lsan_default_suppressions() { return "leak:liburdfdom_model\n"; }
