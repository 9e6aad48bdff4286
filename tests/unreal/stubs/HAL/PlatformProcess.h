#pragma once
#include "CoreMinimal.h"
struct FPlatformProcess
{
	static inline bool StubFinds = true;
	static void* GetDllHandle(const TCHAR*) { return StubFinds ? &StubFinds : nullptr; }
	static void FreeDllHandle(void*) {}
};
