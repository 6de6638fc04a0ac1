// Part of every program that is built with the sanitizers: libraries stay loaded, so that what a driver leaves allocated
// has its name when the leak sanitizer looks, for tests/leaks.txt to leave it out.

extern "C" int dlclose(void *) noexcept { return 0; }
