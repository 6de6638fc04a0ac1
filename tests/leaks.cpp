// Part of every program that is built with the sanitizers: which leaks are not ours.

/// Libraries stay loaded, so that what a driver leaves allocated has its name when the leak sanitizer looks.
extern "C" int dlclose(void *) noexcept { return 0; }

/// Memory that its owners do not free. The validation layer forgets what it noted of calls that then fail beneath it,
/// as those of tests/faults do.
extern "C" const char *__lsan_default_suppressions() { // NOLINT: the sanitizer's name
    return "leak:libvulkan_lvp\n"
           "leak:libLLVM\n"
           "leak:libVkLayer_khronos_validation\n";
}

extern "C" const char *__lsan_default_options() { return "print_suppressions=0"; } // NOLINT: likewise
