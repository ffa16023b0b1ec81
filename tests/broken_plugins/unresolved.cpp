// Calls a function that no library has.
extern "C" int function_that_nobody_wrote();
extern "C" __attribute__((visibility("default"))) int answer();
int answer() { return function_that_nobody_wrote(); }
