#include "PbmpmModule.h"

#include "PbmpmConversion.h"

#include "HAL/PlatformProcess.h"
#include "Interfaces/IPluginManager.h"
#include "Misc/Paths.h"

DEFINE_LOG_CATEGORY(LogPbmpm);
IMPLEMENT_MODULE(FPbmpmModule, PbmpmRuntime)

static bool bPbmpmIsLoaded = false;

static FString LibraryPath()
{
#if PLATFORM_WINDOWS
	const TCHAR* File = TEXT("Win64/pbmpm.dll");
#else
	const TCHAR* File = TEXT("Linux/libpbmpm.so.1");
#endif
	const TSharedPtr<IPlugin> Plugin = IPluginManager::Get().FindPlugin(TEXT("Pbmpm"));
	if (!Plugin.IsValid())
	{
		return File;
	}
	return FPaths::Combine(Plugin->GetBaseDir(), TEXT("Binaries/ThirdParty/PbmpmLibrary"), File);
}

void FPbmpmModule::StartupModule()
{
	const FString Path = LibraryPath();
	Library = FPlatformProcess::GetDllHandle(*Path);
	if (!Library)
	{
		UE_LOG(LogPbmpm, Error, TEXT("The library is missing, or needs something that is: %s. Build the plugin's package anew by packaging/unreal.sh."), *Path);
		return;
	}
	if (pbmpm::abi_version() != PBMPM_ABI_VERSION)
	{
		UE_LOG(LogPbmpm, Error, TEXT("%s has the binary interface %u, and the plugin was built for %u."), *Path, pbmpm::abi_version(), uint32(PBMPM_ABI_VERSION));
		return;
	}
	if (pbmpm::active_isa() == PBMPM_ISA_NONE)
	{
		UE_LOG(LogPbmpm, Error, TEXT("This CPU has no SSE4.2, which pbmpm needs."));
		return;
	}
	bPbmpmIsLoaded = true;
}

void FPbmpmModule::ShutdownModule()
{
	if (bPbmpmIsLoaded)
	{
		static_cast<void>(pbmpm::shutdown()); // what it refuses is another call under way, and none is
	}
	bPbmpmIsLoaded = false;
	if (Library)
	{
		FPlatformProcess::FreeDllHandle(Library);
	}
	Library = nullptr;
}

bool FPbmpmModule::IsLoaded()
{
	return bPbmpmIsLoaded;
}
