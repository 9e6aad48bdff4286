#pragma once
#include "Components/PrimitiveComponent.h"
class UNiagaraComponent : public UPrimitiveComponent
{
public:
	int32 StubCount = 0;
	FName StubNames[2];
};
