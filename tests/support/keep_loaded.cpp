// Drivers and layers stay loaded until the program ends: LeakSanitizer looks then, and tells what a library
// left behind by the library's name (leaks.supp) only while that is there.
extern "C" int dlclose(void*) { return 0; }
