#pragma once
#include "CoreMinimal.h"
class AActor : public UObject
{
public:
	template <class Type> Type* FindComponentByClass() const { return nullptr; }
};
