#pragma once
#include "NiagaraComponent.h"
struct UNiagaraDataInterfaceArrayFunctionLibrary
{
	static void SetNiagaraArrayPosition(UNiagaraComponent* System, FName Name, const TArray<FVector>& Data)
	{
		System->StubCount = Data.Num();
		System->StubNames[0] = Name;
	}
	static void SetNiagaraArrayVector(UNiagaraComponent* System, FName Name, const TArray<FVector>& Data)
	{
		System->StubCount += Data.Num();
		System->StubNames[1] = Name;
	}
};
