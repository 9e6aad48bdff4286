#pragma once
#include "CoreMinimal.h"
#define DECLARE_STATS_GROUP(Text, Group, Category) struct Group {}
#define DECLARE_CYCLE_STAT_EXTERN(Text, Name, Group, Api) extern Api Group Name
#define DECLARE_DWORD_COUNTER_STAT_EXTERN(Text, Name, Group, Api) extern Api Group Name
#define DECLARE_FLOAT_COUNTER_STAT_EXTERN(Text, Name, Group, Api) extern Api Group Name
#define DEFINE_STAT(Name) STATGROUP_Pbmpm Name
#define SCOPE_CYCLE_COUNTER(Name) static_cast<void>(Name)
#define SET_DWORD_STAT(Name, Value) (static_cast<void>(Name), static_cast<void>(uint32(Value)))
#define SET_FLOAT_STAT(Name, Value) (static_cast<void>(Name), static_cast<void>(float(Value)))
#define RETURN_QUICK_DECLARE_CYCLE_STAT(Class, Group) return TStatId()
