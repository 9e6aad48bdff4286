#pragma once
#include "CoreMinimal.h"
class IPlugin
{
public:
	FString GetBaseDir() const { return TEXT("Plugins/Pbmpm"); }
};
class IPluginManager
{
public:
	static IPluginManager& Get()
	{
		static IPluginManager It;
		return It;
	}
	TSharedPtr<IPlugin> FindPlugin(const FString&) { return TSharedPtr<IPlugin>(new IPlugin); }
};
