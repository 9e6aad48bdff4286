#pragma once
#include "CoreMinimal.h"
template <class Type> class TStrongObjectPtr
{
public:
	explicit TStrongObjectPtr(Type* Pointer = nullptr) : It(Pointer) {}
	Type* Get() const { return It; }

private:
	Type* It;
};
