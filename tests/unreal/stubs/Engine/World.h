#pragma once
#include "CoreMinimal.h"
namespace EWorldType
{
enum Type { None, Game, Editor, PIE };
}
class UWorld : public UObject
{
public:
	template <class Type> Type* GetSubsystem() const { return dynamic_cast<Type*>(StubSubsystem); }
	UObject* StubSubsystem = nullptr;
};
