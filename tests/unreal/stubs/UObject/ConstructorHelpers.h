#pragma once
#include "CoreMinimal.h"
struct ConstructorHelpers
{
	template <class Type> struct FObjectFinder
	{
		explicit FObjectFinder(const TCHAR*) {}
		Type* Object = nullptr;
	};
};
