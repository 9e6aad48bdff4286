// The module: loads the library, and says why it cannot.
#pragma once

#include "CoreMinimal.h"
#include "Modules/ModuleManager.h"

DECLARE_LOG_CATEGORY_EXTERN(LogPbmpm, Log, All);

class PBMPMRUNTIME_API FPbmpmModule : public IModuleInterface
{
public:
	virtual void StartupModule() override;
	virtual void ShutdownModule() override;

	/** Whether the library was loaded and is of the version that the plugin was built for. Game thread. */
	static bool IsLoaded();

private:
	void* Library = nullptr;
};
