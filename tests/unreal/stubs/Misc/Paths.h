#pragma once
#include "CoreMinimal.h"
struct FPaths
{
	static FString Combine(const FString& A, const FString& B, const FString& C) { return FString::Printf(TEXT("%s/%s/%s"), *A, *B, *C); }
};
