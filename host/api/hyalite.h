// All of the library.
#pragma once

#include "hyalite/checks.h"
#include "hyalite/error.h"
#include "hyalite/image.h"
#include "hyalite/renderer.h"
#include "hyalite/scene.h"
#include "hyalite/settings.h"
#include "hyalite/version.h"
