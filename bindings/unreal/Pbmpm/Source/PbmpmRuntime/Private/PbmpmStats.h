// What the console command `stat pbmpm` shows.
#pragma once

#include "CoreMinimal.h"
#include "Stats/Stats.h"

DECLARE_STATS_GROUP(TEXT("pbmpm"), STATGROUP_Pbmpm, STATCAT_Advanced);

DECLARE_CYCLE_STAT_EXTERN(TEXT("Frame (game thread)"), STAT_PbmpmFrame, STATGROUP_Pbmpm, );
DECLARE_CYCLE_STAT_EXTERN(TEXT("Copy particles"), STAT_PbmpmCopy, STATGROUP_Pbmpm, );
DECLARE_CYCLE_STAT_EXTERN(TEXT("Update renderers"), STAT_PbmpmDraw, STATGROUP_Pbmpm, );
DECLARE_DWORD_COUNTER_STAT_EXTERN(TEXT("Particles"), STAT_PbmpmParticles, STATGROUP_Pbmpm, );
DECLARE_FLOAT_COUNTER_STAT_EXTERN(TEXT("Step [ms]"), STAT_PbmpmStep, STATGROUP_Pbmpm, );
DECLARE_FLOAT_COUNTER_STAT_EXTERN(TEXT("Predicted error [cells]"), STAT_PbmpmError, STATGROUP_Pbmpm, );
DECLARE_FLOAT_COUNTER_STAT_EXTERN(TEXT("Time given up [s]"), STAT_PbmpmLost, STATGROUP_Pbmpm, );
