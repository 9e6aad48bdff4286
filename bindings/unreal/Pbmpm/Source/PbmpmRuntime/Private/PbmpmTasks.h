// The library's parallel work on Unreal's task system.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmConversion.h"

/** Hooks for a world's definition. They have no state, so they serve any number of worlds. */
pbmpm::task_hooks PbmpmTaskHooks();
