// The version of the program, set by the build.
#pragma once

#ifndef HYALITE_VERSION
#error "HYALITE_VERSION comes from project(VERSION) in CMakeLists.txt"
#endif
